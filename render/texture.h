/* Textures of 8 bits a channel, and how a material looks at them. */
#ifndef LOBE_RENDER_TEXTURE_H
#define LOBE_RENDER_TEXTURE_H

#include <stddef.h>

#include "vector.h"

enum { NO_TEXTURE = -1 };

/* A copy of half the size. */
typedef struct texture_level {
    const unsigned char *texels;
    int width, height;
} texture_level;

typedef struct texture {
    int width, height;
    int channels; /* 3, or 4 where the picture has alpha */
    int is_srgb;
    unsigned char *texels; /* rows from the top; freed by lobe_texture_free */
    texture_level *levels; /* from half the size on, and their texels; NULL: none */
    int level_count;
} texture;

/* What lies beyond the edge. */
typedef enum texture_wrap { WRAP_REPEAT, WRAP_MIRROR, WRAP_CLAMP } texture_wrap;

/* Which copies are looked at where texels are smaller than what is averaged over. */
typedef enum texture_levels { LEVELS_BLENDED, LEVELS_NEAREST, LEVELS_NONE } texture_levels;

/* Which texture a material uses, and how. */
typedef struct texture_map {
    int texture; /* index in the scene, or NO_TEXTURE */
    int uv_set;  /* of the vertex: 0 or 1 */
    texture_wrap wrap_u, wrap_v;
    int is_nearest;       /* not bilinear where texels are large; */
    int is_nearest_small; /* where they are small */
    texture_levels levels;
    float u[3], v[3]; /* rows of the transform of (u, v, 1) */
} texture_map;

/* Repeating, bilinear, levels blended, the first set of coordinates as it is. */
texture_map lobe_texture_map(int texture);

/* Anything of 8 or 16 bits that stb_image reads. 0: unusable, `t` is left empty. */
int lobe_texture_read_file(texture *t, const char *path, int is_srgb);
int lobe_texture_read_memory(texture *t, const void *data, size_t size, int is_srgb);

/* A one-texel texture; values of the format, [0, 1]. 0: no memory. */
int lobe_texture_solid(texture *t, vec3 color, int is_srgb);

/* Gives a picture without alpha, or with one that is opaque everywhere, an alpha of its green. 0: no memory, nothing changed. */
int lobe_texture_make_opacity(texture *t);
void lobe_texture_free(texture *t);

/* Make the smaller copies, down to one texel: means of the linear values, rounded to 8 bits. A third more memory; of a
 * texture of one row, as much again. 0: no memory. */
int lobe_texture_add_levels(texture *t);

/* Of all texels, those of the levels too. */
size_t lobe_texture_bytes(const texture *t);

/* Linear colour (is_srgb) or raw value at (u, v), v from the top. `footprint`: what to average over, as the side of a square in
 * the plane of (u, v); up to a texel, or without levels: 0. */
vec3 lobe_texture_at(const texture *t, const texture_map *map, float u, float v, float footprint);

/* Without levels; 1 where there is no alpha. */
float lobe_texture_alpha_at(const texture *t, const texture_map *map, float u, float v);

#endif
