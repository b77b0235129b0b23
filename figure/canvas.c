#include "canvas.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include "svg.h"

picture_format lobe_picture_format_of(const char *path) {
    static const struct {
        const char *ending;
        picture_format format;
    } known[] = {{".svg", PICTURE_SVG}, {".pdf", PICTURE_PDF}, {".png", PICTURE_PNG}};
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (length > 4 && strcasecmp(path + length - 4, known[i].ending) == 0)
            return known[i].format;
    return PICTURE_NONE;
}

static cairo_status_t take_bytes(void *user, const unsigned char *data, unsigned int size) {
    bytes *b = user;
    lobe_bytes_add(b, data, size);
    return b->failed ? CAIRO_STATUS_NO_MEMORY : CAIRO_STATUS_SUCCESS;
}

/* Without a picture the figure is drawn for its numbers alone, on one that keeps nothing. */
static cairo_surface_t *surface_of(canvas *c) {
    switch (c->format) {
    case PICTURE_SVG:
        return cairo_svg_surface_create_for_stream(take_bytes, &c->file, c->width, c->height);
    case PICTURE_PDF:
        return cairo_pdf_surface_create_for_stream(take_bytes, &c->file, c->width, c->height);
    case PICTURE_PNG:
        return cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)ceil(c->width * c->dpi / 72),
                                          (int)ceil(c->height * c->dpi / 72));
    case PICTURE_NONE:
        break;
    }
    return cairo_svg_surface_create_for_stream(NULL, NULL, c->width, c->height);
}

void lobe_canvas_begin(canvas *c, double width, double height) {
    c->width = width;
    c->height = height;
    cairo_surface_t *surface = surface_of(c);
    c->cr = cairo_create(surface);
    cairo_surface_destroy(surface); /* cr holds it */
    if (c->format == PICTURE_PNG) cairo_scale(c->cr, c->dpi / 72, c->dpi / 72);
    lobe_set_colour(c, c->theme->paper, 1);
    cairo_paint(c->cr);
    cairo_set_line_join(c->cr, CAIRO_LINE_JOIN_ROUND);
    cairo_select_font_face(c->cr, "Liberation Sans", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    /* outlines as designed, not moved to a grid of pixels */
    cairo_font_options_t *font = cairo_font_options_create();
    cairo_font_options_set_hint_style(font, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(font, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(c->cr, font);
    cairo_font_options_destroy(font);
}

int lobe_canvas_end(canvas *c) {
    if (!c->cr) return 1;
    cairo_surface_t *surface = cairo_surface_reference(cairo_get_target(c->cr));
    cairo_status_t status = cairo_status(c->cr);
    cairo_destroy(c->cr);
    c->cr = NULL;
    if (!status && c->format == PICTURE_PNG)
        status = cairo_surface_write_to_png_stream(surface, take_bytes, &c->file);
    cairo_surface_finish(surface);
    if (!status) status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    if (c->format == PICTURE_SVG) lobe_svg_shorten(&c->file);
    return status == CAIRO_STATUS_SUCCESS && !c->file.failed;
}

pen lobe_pen(const canvas *c, hue h, dash d) {
    return (pen){c->theme->hues[h], d, 1.2};
}

void lobe_set_colour(canvas *c, colour k, double opacity) {
    cairo_set_source_rgba(c->cr, k.r, k.g, k.b, opacity);
}

void lobe_stroke(canvas *c, pen p) {
    static const double dashes[][4] = {{0}, {4, 2.5, 4, 2.5}, {1, 1.8, 1, 1.8}, {5, 2, 1, 2}};
    cairo_set_dash(c->cr, dashes[p.dash], p.dash == DASH_SOLID ? 0 : 4, 0);
    cairo_set_line_width(c->cr, p.width);
    lobe_set_colour(c, p.colour, 1);
    cairo_stroke(c->cr);
    cairo_set_dash(c->cr, NULL, 0, 0);
}

void lobe_stroke_line(canvas *c, pen p, double x0, double y0, double x1, double y1) {
    cairo_move_to(c->cr, x0, y0);
    cairo_line_to(c->cr, x1, y1);
    lobe_stroke(c, p);
}

void lobe_arrow(canvas *c, pen p, double x0, double y0, double x1, double y1) {
    const double length = hypot(x1 - x0, y1 - y0);
    if (!(length > 0)) return;
    const double head = 4 + p.width, dx = (x1 - x0) / length, dy = (y1 - y0) / length;
    const double bx = x1 - head * dx, by = y1 - head * dy;
    lobe_stroke_line(c, p, x0, y0, bx, by);
    cairo_move_to(c->cr, x1, y1);
    cairo_line_to(c->cr, bx - 0.38 * head * dy, by + 0.38 * head * dx);
    cairo_line_to(c->cr, bx + 0.38 * head * dy, by - 0.38 * head * dx);
    cairo_close_path(c->cr);
    lobe_set_colour(c, p.colour, 1);
    cairo_fill(c->cr);
}

/* A line without length has a round end, and nothing else. */
void lobe_add_dot(canvas *c, double x, double y) {
    cairo_move_to(c->cr, x, y);
    cairo_line_to(c->cr, x, y);
}

void lobe_stroke_dots(canvas *c, colour k, double radius) {
    cairo_set_line_cap(c->cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(c->cr, 2 * radius);
    lobe_set_colour(c, k, 1);
    cairo_stroke(c->cr);
    cairo_set_line_cap(c->cr, CAIRO_LINE_CAP_BUTT);
}
