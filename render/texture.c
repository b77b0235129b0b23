#include "texture.h"

#include <limits.h>
#include <stdlib.h>

#include <stb/stb_image.h>

#include "image.h"

texture_map lobe_texture_map(int texture) {
    return (texture_map){.texture = texture, .u = {1.0f, 0.0f, 0.0f}, .v = {0.0f, 1.0f, 0.0f}};
}

/* stb_image allocates by malloc, and so does lobe_texture_solid: free fits both. */
static int adopt(texture *t, unsigned char *texels, int width, int height, int channels,
                 int is_srgb) {
    *t = (texture){width, height, channels, is_srgb, .texels = texels};
    return texels != NULL;
}

/* Grey with alpha has 2 channels, colour with alpha 4. */
static int channels_kept(int channels) {
    return channels == 2 || channels == 4 ? 4 : 3;
}

/* Radiance files are no textures: at the end of a truncated one stb_image (2.27) never returns. */
int lobe_texture_read_file(texture *t, const char *path, int is_srgb) {
    int width = 0, height = 0, channels = 0;
    unsigned char *texels = NULL;
    if (stbi_info(path, &width, &height, &channels) && !stbi_is_hdr(path))
        texels = stbi_load(path, &width, &height, &channels, channels_kept(channels));
    return adopt(t, texels, width, height, channels_kept(channels), is_srgb);
}

int lobe_texture_read_memory(texture *t, const void *data, size_t size, int is_srgb) {
    int width = 0, height = 0, channels = 0;
    unsigned char *texels = NULL;
    if (size > 0 && size <= INT_MAX &&
        stbi_info_from_memory(data, (int)size, &width, &height, &channels) &&
        !stbi_is_hdr_from_memory(data, (int)size))
        texels = stbi_load_from_memory(data, (int)size, &width, &height, &channels,
                                       channels_kept(channels));
    return adopt(t, texels, width, height, channels_kept(channels), is_srgb);
}

int lobe_texture_solid(texture *t, vec3 color, int is_srgb) {
    unsigned char *texels = malloc(3);
    if (texels) {
        texels[0] = (unsigned char)(color.x * 255.0f);
        texels[1] = (unsigned char)(color.y * 255.0f);
        texels[2] = (unsigned char)(color.z * 255.0f);
    }
    return adopt(t, texels, 1, 1, 3, is_srgb);
}

static int has_alpha(const texture *t) {
    const size_t size = (size_t)t->width * (size_t)t->height;
    for (size_t i = 0; t->channels == 4 && i < size; i++)
        if (t->texels[4 * i + 3] != 255) return 1;
    return 0;
}

int lobe_texture_make_opacity(texture *t) {
    if (has_alpha(t)) return 1;
    const size_t size = (size_t)t->width * (size_t)t->height, channels = (size_t)t->channels;
    unsigned char *texels = malloc(4 * size);
    if (!texels) return 0;
    for (size_t i = 0; i < size; i++) {
        for (size_t c = 0; c < 3; c++) texels[4 * i + c] = t->texels[channels * i + c];
        texels[4 * i + 3] = texels[4 * i + 1];
    }
    free(t->texels);
    t->texels = texels;
    t->channels = 4;
    return 1;
}

void lobe_texture_free(texture *t) {
    free(t->texels);
    free(t->levels);
    t->texels = NULL;
    t->levels = NULL;
    t->level_count = 0;
}

/* The place of (u, v) among the texels: the upper left of four, and the shares of the others. */
typedef struct texel_place {
    int x, y, next_x, next_y;
    float share_x, share_y;
} texel_place;

/* Into [0, 1], as the edge says. */
static float wrap(float u, texture_wrap how) {
    if (how == WRAP_CLAMP) return clampf(u, 0.0f, 1.0f);
    if (how == WRAP_REPEAT) return u - floorf(u);
    const float turn = u - 2.0f * floorf(0.5f * u);
    return turn > 1.0f ? 2.0f - turn : turn;
}

/* Position on one axis: the lower texel, the next one and the share of that. */
static int place_on(float u, int size, texture_wrap how, int is_nearest, int *next, float *share) {
    const float x = wrap(u, how) * (float)size - 0.5f;
    if (is_nearest) {
        const int i = (int)clampf(floorf(x + 0.5f), 0.0f, (float)(size - 1));
        *share = 0.0f;
        return *next = i;
    }
    const float low = floorf(x);
    *share = x - low;
    const int i = (int)low;
    *next = i + 1 < size ? i + 1 : how == WRAP_REPEAT ? 0 : size - 1;
    if (i < 0) return how == WRAP_REPEAT ? size - 1 : 0;
    return i < size ? i : size - 1;
}

static texel_place place_of(const texture_level *t, const texture_map *map, int is_nearest, float u,
                            float v) {
    const float mu = map->u[0] * u + map->u[1] * v + map->u[2];
    const float mv = map->v[0] * u + map->v[1] * v + map->v[2];
    texel_place p = {0};
    if (!isfinite(mu) || !isfinite(mv)) return p;
    p.x = place_on(mu, t->width, map->wrap_u, is_nearest, &p.next_x, &p.share_x);
    p.y = place_on(mv, t->height, map->wrap_v, is_nearest, &p.next_y, &p.share_y);
    return p;
}

static texture_level whole(const texture *t) {
    return (texture_level){t->texels, t->width, t->height};
}

static const unsigned char *texel_bytes(const texture_level *t, int channels, int x, int y) {
    return t->texels + (size_t)channels * ((size_t)y * (size_t)t->width + (size_t)x);
}

static vec3 texel(const texture *t, const texture_level *level, int x, int y) {
    const unsigned char *c = texel_bytes(level, t->channels, x, y);
    vec3 value = {c[0] / 255.0f, c[1] / 255.0f, c[2] / 255.0f};
    if (!t->is_srgb) return value;
    return v3(lobe_srgb_to_linear(value.x), lobe_srgb_to_linear(value.y),
              lobe_srgb_to_linear(value.z));
}

static vec3 level_at(const texture *t, texture_level l, const texture_map *map, int is_nearest,
                     float u, float v) {
    const texel_place p = place_of(&l, map, is_nearest, u, v);
    vec3 top = v3_lerp(texel(t, &l, p.x, p.y), texel(t, &l, p.next_x, p.y), p.share_x);
    vec3 bottom = v3_lerp(texel(t, &l, p.x, p.next_y), texel(t, &l, p.next_x, p.next_y), p.share_x);
    return v3_lerp(top, bottom, p.share_y);
}

/* Texels under the side of a square of (u, v). */
static float texels_across(const texture *t, const texture_map *map, float footprint) {
    const float area = fabsf(map->u[0] * map->v[1] - map->u[1] * map->v[0]);
    return footprint * sqrtf(area * (float)t->width * (float)t->height);
}

/* Level 0 is the texture itself. */
static vec3 small_at(const texture *t, const texture_map *map, float u, float v, int level) {
    if (level > t->level_count) level = t->level_count;
    return level_at(t, level > 0 ? t->levels[level - 1] : whole(t), map, map->is_nearest_small, u,
                    v);
}

vec3 lobe_texture_at(const texture *t, const texture_map *map, float u, float v, float footprint) {
    const float across = footprint > 0.0f ? texels_across(t, map, footprint) : 0.0f;
    if (!(across > 1.0f)) return level_at(t, whole(t), map, map->is_nearest, u, v);
    if (map->levels == LEVELS_NONE) return small_at(t, map, u, v, 0);
    const float level = minf(log2f(across), 31.0f), low = floorf(level);
    if (map->levels == LEVELS_NEAREST) return small_at(t, map, u, v, (int)(level + 0.5f));
    return v3_lerp(small_at(t, map, u, v, (int)low), small_at(t, map, u, v, (int)low + 1),
                   level - low);
}

static float alpha(const texture *t, const texture_level *level, int x, int y) {
    return texel_bytes(level, t->channels, x, y)[3] / 255.0f;
}

float lobe_texture_alpha_at(const texture *t, const texture_map *map, float u, float v) {
    if (t->channels < 4) return 1.0f;
    const texture_level l = whole(t);
    const texel_place p = place_of(&l, map, map->is_nearest, u, v);
    const float top =
        (1.0f - p.share_x) * alpha(t, &l, p.x, p.y) + p.share_x * alpha(t, &l, p.next_x, p.y);
    const float bottom = (1.0f - p.share_x) * alpha(t, &l, p.x, p.next_y) +
                         p.share_x * alpha(t, &l, p.next_x, p.next_y);
    return (1.0f - p.share_y) * top + p.share_y * bottom;
}
