/* Smaller copies of a texture, each the box-filtered half of the one before. They are made of linear values in float, and
 * rounded once. */
#include <stdlib.h>

#include "image.h"
#include "texture.h"

static int half_of(int size) {
    return size > 1 ? size / 2 : 1;
}

static int count_levels(const texture *t) {
    int count = 0;
    for (int w = t->width, h = t->height; w > 1 || h > 1; w = half_of(w), h = half_of(h)) count++;
    return count;
}

static size_t bytes_of(const texture *t, int width, int height) {
    return (size_t)t->channels * (size_t)width * (size_t)height;
}

size_t lobe_texture_bytes(const texture *t) {
    size_t sum = bytes_of(t, t->width, t->height);
    for (int i = 0; i < t->level_count; i++)
        sum += bytes_of(t, t->levels[i].width, t->levels[i].height);
    return sum;
}

/* What texel `i` of `count` covers of `size` texels: from the first on, up to three, with shares. */
typedef struct cover {
    int first, count;
    float shares[3];
} cover;

static cover cover_of(int i, int count, int size) {
    const double ratio = (double)size / count, low = i * ratio, high = (i + 1) * ratio;
    cover c = {.first = (int)low};
    for (int k = c.first; k < size && k < high - 1e-6 && c.count < 3; k++) {
        const double from = k > low ? k : low, to = k + 1 < high ? k + 1 : high;
        c.shares[c.count++] = (float)((to - from) / ratio);
    }
    return c;
}

static void halve(const float *from, int width, int height, int channels, float *to) {
    const int small_width = half_of(width), small_height = half_of(height);
    for (int y = 0; y < small_height; y++)
        for (int x = 0; x < small_width; x++, to += channels) {
            const cover across = cover_of(x, small_width, width);
            const cover down = cover_of(y, small_height, height);
            for (int c = 0; c < channels; c++) to[c] = 0.0f;
            for (int i = 0; i < down.count; i++)
                for (int k = 0; k < across.count; k++) {
                    const size_t row = (size_t)(down.first + i) * (size_t)width;
                    const float *texel =
                        from + ((size_t)(across.first + k) + row) * (size_t)channels;
                    for (int c = 0; c < channels; c++)
                        to[c] += down.shares[i] * across.shares[k] * texel[c];
                }
        }
}

/* Alpha is never coded. */
static int is_coded(const texture *t, size_t i) {
    return t->is_srgb && i % (size_t)t->channels < 3;
}

static void decode(const texture *t, float *values) {
    float codes[256];
    for (int i = 0; i < 256; i++) codes[i] = lobe_srgb_to_linear((float)i / 255.0f);
    for (size_t i = 0; i < bytes_of(t, t->width, t->height); i++)
        values[i] = is_coded(t, i) ? codes[t->texels[i]] : (float)t->texels[i] / 255.0f;
}

static void encode(const texture *t, const float *values, size_t count, unsigned char *bytes) {
    for (size_t i = 0; i < count; i++) {
        const float value = is_coded(t, i) ? lobe_linear_to_srgb(values[i]) : values[i];
        bytes[i] = (unsigned char)clampf(255.0f * value + 0.5f, 0.0f, 255.0f);
    }
}

static void fill_levels(texture *t, unsigned char *bytes, float *values, float *smaller) {
    int width = t->width, height = t->height;
    decode(t, values);
    for (int i = 0; i < t->level_count; i++) {
        halve(values, width, height, t->channels, smaller);
        width = half_of(width);
        height = half_of(height);
        const size_t count = bytes_of(t, width, height);
        encode(t, smaller, count, bytes);
        t->levels[i] = (texture_level){bytes, width, height};
        bytes += count;
        float *other = values;
        values = smaller;
        smaller = other;
    }
}

int lobe_texture_add_levels(texture *t) {
    const int count = count_levels(t);
    if (t->levels || count == 0) return 1;
    const size_t whole = bytes_of(t, t->width, t->height);
    size_t bytes = 0;
    for (int i = 0, w = t->width, h = t->height; i < count; i++) {
        w = half_of(w);
        h = half_of(h);
        bytes += bytes_of(t, w, h);
    }
    /* two halves of a strip of one row are as large as it is */
    float *values = malloc(whole * sizeof *values), *smaller = malloc(whole * sizeof *smaller);
    t->levels = malloc((size_t)count * sizeof *t->levels + bytes);
    if (values && smaller && t->levels) {
        t->level_count = count;
        fill_levels(t, (unsigned char *)(t->levels + count), values, smaller);
    }
    free(values);
    free(smaller);
    return t->level_count > 0;
}
