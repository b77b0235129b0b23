#include "pixels.h"

#include <math.h>
#include <stdint.h>

static uint32_t byte_of(double channel) {
    return (uint32_t)(255 * fmin(fmax(channel, 0), 1) + 0.5);
}

static cairo_surface_t *image_of(int columns, int rows, pixel_function *colour_of,
                                 const void *user) {
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows);
    unsigned char *data = cairo_image_surface_get_data(image);
    if (!data) return image;
    const size_t stride = (size_t)cairo_image_surface_get_stride(image);
    for (int row = 0; row < rows; row++) {
        uint32_t *line = (uint32_t *)(void *)(data + stride * (size_t)row);
        for (int column = 0; column < columns; column++) {
            const colour k = colour_of(user, column, row);
            line[column] = byte_of(k.r) << 16 | byte_of(k.g) << 8 | byte_of(k.b);
        }
    }
    cairo_surface_mark_dirty(image);
    return image;
}

void lobe_paint_pixels(canvas *c, box b, int columns, int rows, pixel_function *colour_of,
                       const void *user) {
    cairo_surface_t *image = image_of(columns, rows, colour_of, user);
    cairo_save(c->cr);
    cairo_rectangle(c->cr, b.x, b.y, b.width, b.height);
    cairo_clip(c->cr);
    cairo_translate(c->cr, b.x, b.y);
    cairo_scale(c->cr, b.width / columns, b.height / rows);
    cairo_set_source_surface(c->cr, image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(c->cr), CAIRO_FILTER_NEAREST);
    cairo_paint(c->cr);
    cairo_restore(c->cr);
    cairo_surface_destroy(image);
}
