/* tools/numerics/horizon_rejects.c: how many of 10^8 draws in float each horizon sampler rejects, or sends
 * below the surface.
 *
 *     cc -O2 -Iinclude tools/numerics/horizon_rejects.c build/liblobe.a -lm -o horizon_rejects
 *
 * Roughness 0.01 to 2, every fourth isotropic; any direction down to 162 degrees from the normal; the
 * floor 0 to 1; a new one of each every 20,000 draws. */
#include <lobe/lobe.h>

#include <math.h>
#include <stdio.h>

enum { POINTS = 5000, DRAWS = 20000 };

static float unit(lobe_random4 r, int word) {
    return lobe_random_unit_f32(r.word[word]);
}

static lobe_reflection_f32 point_at(lobe_method method, uint64_t k) {
    lobe_random4 a = lobe_random(21, 0, k), b = lobe_random(21, 1, k);
    float z = 1.0f - 1.95f * unit(a, 0), turn = 6.2831853f * unit(a, 1), s = sqrtf(1.0f - z * z);
    lobe_vec3_f32 wi = {s * cosf(turn), s * sinf(turn), z};
    float alpha_x = 0.01f * powf(200.0f, unit(a, 2));
    float alpha_y = k % 4 == 0 ? alpha_x : 0.01f * powf(200.0f, unit(a, 3));
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = method;
    options.floor = 0.25 * (int)(5.0f * unit(b, 0));
    return lobe_reflection_prepare_f32(options, wi, alpha_x, alpha_y);
}

int main(void) {
    static const lobe_method methods[] = {LOBE_METHOD_HORIZON_MIRROR, LOBE_METHOD_HORIZON_EXACT,
                                          LOBE_METHOD_HORIZON_UNIFORM, LOBE_METHOD_HORIZON,
                                          LOBE_METHOD_BOUNDED};
    static float z[DRAWS], pdf[DRAWS];
    for (int m = 0; m < 5; ++m) {
        long rejected = 0, below = 0, draws = 0;
        for (uint64_t k = 0; k < POINTS; ++k) {
            lobe_reflection_f32 model = point_at(methods[m], k);
            lobe_sample_batch_f32 batch = {.count = DRAWS, .prepared = &model, .seed = k};
            batch.wo[2] = (lobe_out_f32){z, 1};
            batch.pdf = (lobe_out_f32){pdf, 1};
            lobe_reflection_sample_batch_f32(&batch);
            for (int i = 0; i < DRAWS; ++i) {
                rejected += !(pdf[i] > 0.0f);
                below += pdf[i] > 0.0f && !(z[i] > 0.0f);
            }
            draws += DRAWS;
        }
        printf("%-16s %ld draws: %ld rejected, %ld below the surface\n",
               lobe_method_name(methods[m]), draws, rejected, below);
    }
    return 0;
}
