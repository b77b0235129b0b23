/* The environment as rough surfaces reflect it, seen along the normal (Karis 2013): a mean over the lobe. */
#include <math.h>
#include <stdlib.h>

#include "frames.h"
#include "lobe/random.h"

enum { DRAWS = 32 };

static v3 texel_direction(int x, int y) {
    const float phi = (((float)x + 0.5f) / ENVIRONMENT_WIDTH - 0.5f) * 6.2831853f;
    const float theta = ((float)y + 0.5f) / ENVIRONMENT_HEIGHT * 3.1415927f;
    return v3_of(sinf(theta) * cosf(phi), cosf(theta), sinf(theta) * sinf(phi));
}

static v3 filtered(ssr_light *light, const void *source, v3 axis, float alpha, uint64_t texel) {
    if (alpha == 0.0f) return light(source, axis);
    const lobe_reflection_f32 model = lobe_reflection_prepare_f32(
        lobe_reflection_default_options(), (lobe_vec3_f32){0.0f, 0.0f, 1.0f}, alpha, alpha);
    const v3 x = ssr_across(axis), y = v3_cross(axis, x);
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    float weights = 0.0f;
    for (int i = 0; i < DRAWS; i++) {
        const lobe_random4 r = lobe_random(0, texel, (uint64_t)i);
        const float u = ((float)i + lobe_random_unit_f32(r.word[0])) / DRAWS;
        const lobe_reflection_draw_f32 d =
            lobe_reflection_sample_f32(&model, lobe_random_unit_f32(r.word[1]), u, 0.0f);
        if (!(d.weight > 0.0f)) continue;
        const v3 to = v3_combine(x, d.wo.x, y, d.wo.y, axis, d.wo.z);
        sum = v3_add(sum, v3_scale(light(source, to), d.weight));
        weights += d.weight;
    }
    return weights > 0.0f ? v3_scale(sum, 1.0f / weights) : sum;
}

float *lobe_ssr_prefilter(ssr_light *light, const void *source, int threads) {
    const int texels = ENVIRONMENT_WIDTH * ENVIRONMENT_HEIGHT;
    float *rgb = malloc(3 * sizeof *rgb * (size_t)texels * ENVIRONMENT_LEVELS);
    if (!rgb) return NULL;
#pragma omp parallel for schedule(dynamic, 64) num_threads(threads)
    for (int i = 0; i < texels * ENVIRONMENT_LEVELS; i++) {
        const int at = i % texels;
        const float r = (float)(i / texels) / (ENVIRONMENT_LEVELS - 1);
        const v3 axis = texel_direction(at % ENVIRONMENT_WIDTH, at / ENVIRONMENT_WIDTH);
        const v3 mean = filtered(light, source, axis, r * r, (uint64_t)i);
        rgb[3 * (size_t)i] = mean.x;
        rgb[3 * (size_t)i + 1] = mean.y;
        rgb[3 * (size_t)i + 2] = mean.z;
    }
    return rgb;
}
