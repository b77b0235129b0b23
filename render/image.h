/* Pictures in linear float RGB, rows from the top. */
#ifndef LOBE_RENDER_IMAGE_H
#define LOBE_RENDER_IMAGE_H

#include <stddef.h>

#include "lobe/render.h"
#include "vector.h"

typedef struct image {
    int width, height;
    vec3 *pixels; /* width * height; freed by lobe_image_free */
} image;

/* 0 if memory is short. */
int lobe_image_create(image *picture, int width, int height);
void lobe_image_free(image *picture);

/* Read .exr, .hdr, .pfm or what stb_image reads (8 bit: sRGB), as the file has it. */
lobe_render_result lobe_image_decode(const char *path, image *picture);

/* The same, to light or to paint with: values that are not finite or negative become 0; *repaired counts
 * them (may be NULL). */
lobe_render_result lobe_image_read(const char *path, image *picture, size_t *repaired);

/* One file format each. */
lobe_render_result lobe_image_read_exr(const char *path, image *picture);
lobe_render_result lobe_image_read_pfm(const char *path, image *picture);

/* Largest number of pixels that is read: guards against headers that lie. */
#define LOBE_IMAGE_PIXELS_MAX ((size_t)1 << 28)

/* Linear from sRGB, both in [0, 1], and back. */
float lobe_srgb_to_linear(float c);
float lobe_linear_to_srgb(float c);

/* 1 if `path` ends with `ending` (".exr"), of any case. */
int lobe_path_ends(const char *path, const char *ending);

#endif
