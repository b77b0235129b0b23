/* lobe/ssr_picture.h: pictures of named channels as files, for G-buffers and results.
 *
 * A file appears whole or not at all. */
#ifndef LOBE_SSR_PICTURE_H
#define LOBE_SSR_PICTURE_H

#include "ssr.h"

LOBE_BEGIN_C

/* One channel: `values` points to the first pixel's, the next is `stride` floats on. */
typedef struct lobe_ssr_channel {
    const char *name; /* "R", "truth.G", …; at most 63 characters */
    const float *values;
    int stride;
} lobe_ssr_channel;

/* OpenEXR, 32-bit floats. `key`: one line that says how the picture was made, or NULL. */
LOBE_API lobe_ssr_result lobe_ssr_write_exr(const char *path, int width, int height,
                                            const lobe_ssr_channel *channels, int count,
                                            const char *key);

/* The same channels back, into `values` (one plane a name, width * height each). 0: there is no such picture of
 * this size, with these channels and this key. */
LOBE_API int lobe_ssr_read_exr(const char *path, int width, int height, const char *const *names,
                               int count, const char *key, float *const *values);

/* 8-bit sRGB of linear r, g, b, stride floats from pixel to pixel. */
LOBE_API lobe_ssr_result lobe_ssr_write_png(const char *path, int width, int height,
                                            const float *rgb, int stride);

/* The same in motion: an animated PNG of pictures that each stay for `milliseconds` (1 to 65535), again and
 * again. */
typedef struct lobe_ssr_animation lobe_ssr_animation;

/* *animation is to be finished after LOBE_SSR_OK; otherwise it is NULL. */
LOBE_API lobe_ssr_result lobe_ssr_animation_begin(const char *path, int width, int height,
                                                  int milliseconds, lobe_ssr_animation **animation);
LOBE_API lobe_ssr_result lobe_ssr_animation_add(lobe_ssr_animation *animation, const float *rgb,
                                                int stride);
/* Gives the file its name if all went well, and frees the handle (NULL is fine). */
LOBE_API lobe_ssr_result lobe_ssr_animation_finish(lobe_ssr_animation *animation);

LOBE_END_C

#endif
