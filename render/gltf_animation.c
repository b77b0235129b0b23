#include "gltf_animation.h"

#include <math.h>
#include <stdlib.h>

#include "message.h"

/* A cubic key is a slope before, the value, a slope after. */
static size_t values_of_key(const gltf_channel *channel) {
    return channel->interpolation == GLTF_CUBIC ? 3 : 1;
}

static int channels_of(gltf_path path) {
    return path == GLTF_ROTATION ? 4 : path == GLTF_MORPH ? 1 : 3;
}

lobe_render_result lobe_gltf_keys_read(gltf_reader *r, const gltf_channel *channel,
                                       gltf_keys *keys) {
    const int channels = channels_of(channel->path);
    size_t elements = 0;
    *keys = (gltf_keys){0};
    lobe_render_result result =
        lobe_gltf_read_floats(r, channel->input, 1, &keys->times, &keys->count);
    if (result == LOBE_RENDER_OK)
        result = lobe_gltf_read_floats(r, channel->output, channels, &keys->values, &elements);
    if (result != LOBE_RENDER_OK) return result;
    const size_t wanted = keys->count * values_of_key(channel);
    /* a key of weights has one of each target */
    const size_t targets = channel->path == GLTF_MORPH && wanted > 0 ? elements / wanted : 1;
    keys->width = targets * (size_t)channels;
    if (targets * wanted == elements) return LOBE_RENDER_OK;
    return lobe_fail(
        LOBE_RENDER_BAD_INPUT,
        "%s: accessor %d has %zu elements for %zu keys of an animation; is it damaged?", r->path,
        channel->output, elements, keys->count);
}

void lobe_gltf_keys_free(gltf_keys *keys) {
    free(keys->times);
    free(keys->values);
    *keys = (gltf_keys){0};
}

/* The last key that is not after `time`, of those before the last one. */
static size_t key_before(const gltf_keys *k, double time) {
    size_t low = 0, high = k->count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if ((double)k->times[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Part 0, 1 or 2 of a key; the only part of one that is not cubic is 0. */
static const float *part_of(const gltf_keys *k, const gltf_channel *c, size_t key, size_t part) {
    return k->values + (key * values_of_key(c) + part) * k->width;
}

static void copy_value(const gltf_keys *k, const gltf_channel *c, size_t key, double *value) {
    const float *from = part_of(k, c, key, c->interpolation == GLTF_CUBIC);
    for (size_t i = 0; i < k->width; i++) value[i] = (double)from[i];
}

static void mix(const float *a, const float *b, double share_a, double share_b, size_t width,
                double *value) {
    for (size_t i = 0; i < width; i++) value[i] = share_a * (double)a[i] + share_b * (double)b[i];
}

/* Along the shorter arc (Shoemake 1985). */
static void turn(const float a[4], const float b[4], double share, double value[4]) {
    double cosine = 0.0;
    for (int i = 0; i < 4; i++) cosine += (double)a[i] * (double)b[i];
    const double side = cosine < 0.0 ? -1.0 : 1.0;
    const double angle = acos(fmin(fabs(cosine), 1.0)), sine = sin(angle);
    /* of a small angle the chord is the arc */
    const int is_small = !(sine > 1e-6);
    mix(a, b, is_small ? 1.0 - share : sin((1.0 - share) * angle) / sine,
        side * (is_small ? share : sin(share * angle) / sine), 4, value);
}

/* The cubic of appendix C of the specification. */
static void bend(const gltf_keys *k, const gltf_channel *c, size_t key, double t, double length,
                 double *value) {
    const double t2 = t * t, t3 = t2 * t;
    const float *from = part_of(k, c, key, 1), *leave = part_of(k, c, key, 2);
    const float *reach = part_of(k, c, key + 1, 0), *to = part_of(k, c, key + 1, 1);
    for (size_t i = 0; i < k->width; i++)
        value[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * (double)from[i] +
                   length * (t3 - 2.0 * t2 + t) * (double)leave[i] +
                   (3.0 * t2 - 2.0 * t3) * (double)to[i] + length * (t3 - t2) * (double)reach[i];
}

void lobe_gltf_keys_at(const gltf_keys *k, const gltf_channel *c, double time, double *value) {
    if (!(time > (double)k->times[0])) {
        copy_value(k, c, 0, value);
        return;
    }
    if (k->count == 1 || !(time < (double)k->times[k->count - 1])) {
        copy_value(k, c, k->count - 1, value);
        return;
    }
    const size_t key = key_before(k, time);
    const double start = (double)k->times[key], length = (double)k->times[key + 1] - start;
    const double share = length > 0.0 ? fmin(fmax((time - start) / length, 0.0), 1.0) : 0.0;
    const float *a = part_of(k, c, key, 0), *b = part_of(k, c, key + 1, 0);
    if (c->interpolation == GLTF_STEP)
        copy_value(k, c, key, value);
    else if (c->interpolation == GLTF_CUBIC)
        bend(k, c, key, share, length, value);
    else if (c->path == GLTF_ROTATION)
        turn(a, b, share, value);
    else
        mix(a, b, 1.0 - share, share, k->width, value);
}
