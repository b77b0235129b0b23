/* Textures of 8 bits a channel, bilinear, repeating. */
#ifndef LOBE_RENDER_TEXTURE_H
#define LOBE_RENDER_TEXTURE_H

#include <stddef.h>

#include "vector.h"

typedef struct texture {
    int width, height;
    int is_srgb;
    unsigned char *rgb; /* rows from the top; freed by lobe_texture_free */
} texture;

/* Anything stb_image reads. 0: unusable, `t` is left empty. */
int lobe_texture_read_file(texture *t, const char *path, int is_srgb);
int lobe_texture_read_memory(texture *t, const void *data, size_t size, int is_srgb);

/* A one-texel texture; values of the format, [0, 1]. 0: no memory. */
int lobe_texture_solid(texture *t, vec3 color, int is_srgb);
void lobe_texture_free(texture *t);

/* Linear colour (is_srgb) or raw value at (u, v), v from the top. */
vec3 lobe_texture_at(const texture *t, float u, float v);

#endif
