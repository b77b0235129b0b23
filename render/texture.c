#include "texture.h"

#include <limits.h>
#include <stdlib.h>

#include <stb/stb_image.h>

#include "image.h"

/* stb_image allocates by malloc, and so does lobe_texture_solid: free fits both. */
static int adopt(texture *t, unsigned char *rgb, int width, int height, int is_srgb) {
    *t = (texture){width, height, is_srgb, rgb};
    return rgb != NULL;
}

int lobe_texture_read_file(texture *t, const char *path, int is_srgb) {
    int width = 0, height = 0, channels = 0;
    unsigned char *rgb = stbi_load(path, &width, &height, &channels, 3);
    return adopt(t, rgb, width, height, is_srgb);
}

int lobe_texture_read_memory(texture *t, const void *data, size_t size, int is_srgb) {
    int width = 0, height = 0, channels = 0;
    unsigned char *rgb = NULL;
    if (size <= INT_MAX)
        rgb = stbi_load_from_memory(data, (int)size, &width, &height, &channels, 3);
    return adopt(t, rgb, width, height, is_srgb);
}

int lobe_texture_solid(texture *t, vec3 color, int is_srgb) {
    unsigned char *rgb = malloc(3);
    if (rgb) {
        rgb[0] = (unsigned char)(color.x * 255.0f);
        rgb[1] = (unsigned char)(color.y * 255.0f);
        rgb[2] = (unsigned char)(color.z * 255.0f);
    }
    return adopt(t, rgb, 1, 1, is_srgb);
}

void lobe_texture_free(texture *t) {
    free(t->rgb);
    t->rgb = NULL;
}

static vec3 texel(const texture *t, int x, int y) {
    const unsigned char *c = t->rgb + 3 * ((size_t)y * (size_t)t->width + (size_t)x);
    vec3 value = {c[0] / 255.0f, c[1] / 255.0f, c[2] / 255.0f};
    if (!t->is_srgb) return value;
    return v3(lobe_srgb_to_linear(value.x), lobe_srgb_to_linear(value.y),
              lobe_srgb_to_linear(value.z));
}

/* Position on a repeating axis: the lower texel and the share of the next one. */
static int wrap(float u, int size, float *share) {
    float x = (u - floorf(u)) * (float)size - 0.5f;
    float low = floorf(x);
    *share = x - low;
    int i = (int)low;
    return i < 0 ? i + size : i >= size ? i - size : i;
}

vec3 lobe_texture_at(const texture *t, float u, float v) {
    if (!isfinite(u) || !isfinite(v)) return texel(t, 0, 0);
    float share_x, share_y;
    int x = wrap(u, t->width, &share_x), y = wrap(v, t->height, &share_y);
    int next_x = x + 1 == t->width ? 0 : x + 1, next_y = y + 1 == t->height ? 0 : y + 1;
    vec3 top = v3_lerp(texel(t, x, y), texel(t, next_x, y), share_x);
    vec3 bottom = v3_lerp(texel(t, x, next_y), texel(t, next_x, next_y), share_x);
    return v3_lerp(top, bottom, share_y);
}
