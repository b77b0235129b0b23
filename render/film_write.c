/* A film to a file: the choice of format, and the simple formats. */
#include <math.h>
#include <stdlib.h>

#include <stb/stb_image_write.h>

#include "film.h"
#include "image.h"
#include "lobe/random.h"
#include "message.h"
#include "output.h"

lobe_film_write_options lobe_film_default_write_options(void) {
    return (lobe_film_write_options){.compression = LOBE_FILM_COMPRESSION_ZIP};
}

int lobe_film_can_write(const char *path) {
    static const char *const endings[] = {".exr", ".png", ".hdr", ".pfm"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (lobe_path_ends(path, endings[i])) return 1;
    return 0;
}

static lobe_render_result write_format(const lobe_film *film, output *out,
                                       lobe_film_write_options options) {
    float scale = exp2f(options.exposure);
    if (lobe_path_ends(out->path, ".exr")) return lobe_film_write_exr(film, out, scale, options);
    if (lobe_path_ends(out->path, ".png")) return lobe_film_write_png(film, out, scale);
    if (lobe_path_ends(out->path, ".hdr")) return lobe_film_write_hdr(film, out, scale);
    return lobe_film_write_pfm(film, out, scale);
}

lobe_render_result lobe_film_write(const lobe_film *film, const char *path,
                                   lobe_film_write_options options) {
    if (!lobe_film_can_write(path))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: unknown picture format; end the name with .exr, .png, .hdr or .pfm",
                         path);
    if (!(fabsf(options.exposure) <= 100.0f))
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "exposure: %g is out of range; use -100 to 100",
                         (double)options.exposure);
    if ((unsigned)options.compression > LOBE_FILM_COMPRESSION_PIZ)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "compression: out of range; take one of lobe_film_compression");
    if (lobe_path_ends(path, ".png") &&
        (int64_t)film->width * film->height > LOBE_FILM_PNG_PIXELS_MAX)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: too large for .png; end the name with .exr, .hdr or .pfm", path);
    output out;
    lobe_render_result result =
        options.durable ? lobe_output_open_durable(&out, path) : lobe_output_open(&out, path);
    if (result == LOBE_RENDER_OK) result = write_format(film, &out, options);
    return lobe_output_close(&out, result);
}

static void write_callback(void *user, void *data, int size) {
    lobe_output_write(user, data, (size_t)size);
}

/* Round to 8 bits with triangular noise of one step, so that slow gradients do not band. */
static unsigned char dither(float linear, uint32_t word) {
    float noise = (float)(word & 0xffff) / 65536.0f - (float)(word >> 16) / 65536.0f;
    float code = lobe_linear_to_srgb(clampf(linear, 0.0f, 1.0f)) * 255.0f;
    /* Black and white stay what they are. */
    if (code <= 0.0f || code >= 255.0f) noise = 0.0f;
    return (unsigned char)clampf(floorf(code + 0.5f + noise), 0.0f, 255.0f);
}

lobe_render_result lobe_film_write_png(const lobe_film *film, output *out, float scale) {
    size_t count = (size_t)film->width * (size_t)film->height;
    unsigned char *bytes = malloc(count * 3);
    if (!bytes) return lobe_fail_memory(out->path);
    for (size_t i = 0; i < count; i++) {
        vec3 c = v3_scale(lobe_film_mean(film, i), scale);
        lobe_random4 random = lobe_random(0, 0, i);
        bytes[3 * i + 0] = dither(c.x, random.word[0]);
        bytes[3 * i + 1] = dither(c.y, random.word[1]);
        bytes[3 * i + 2] = dither(c.z, random.word[2]);
    }
    int ok = stbi_write_png_to_func(write_callback, out, film->width, film->height, 3, bytes,
                                    film->width * 3);
    free(bytes);
    return ok ? LOBE_RENDER_OK : lobe_fail_memory(out->path);
}

/* All means times `scale`; NULL: no memory. */
static float *scaled_copy(const lobe_film *film, float scale) {
    size_t count = (size_t)film->width * (size_t)film->height * 3;
    float *rgb = malloc(count * sizeof *rgb);
    if (rgb) {
        lobe_film_copy_rgb(film, rgb);
        for (size_t i = 0; i < count; i++) rgb[i] *= scale;
    }
    return rgb;
}

lobe_render_result lobe_film_write_hdr(const lobe_film *film, output *out, float scale) {
    float *rgb = scaled_copy(film, scale);
    if (!rgb) return lobe_fail_memory(out->path);
    int ok = stbi_write_hdr_to_func(write_callback, out, film->width, film->height, 3, rgb);
    free(rgb);
    return ok ? LOBE_RENDER_OK : lobe_fail_memory(out->path);
}

lobe_render_result lobe_film_write_pfm(const lobe_film *film, output *out, float scale) {
    float *rgb = scaled_copy(film, scale);
    if (!rgb) return lobe_fail_memory(out->path);
    char header[64];
    const uint16_t one = 1;
    int is_little = *(const unsigned char *)&one;
    int length = snprintf(header, sizeof header, "PF\n%d %d\n%s\n", film->width, film->height,
                          is_little ? "-1.0" : "1.0");
    lobe_output_write(out, header, (size_t)length);
    size_t row = (size_t)film->width * 3;
    for (int y = film->height - 1; y >= 0; y--)
        lobe_output_write(out, rgb + (size_t)y * row, row * sizeof *rgb);
    free(rgb);
    return LOBE_RENDER_OK;
}
