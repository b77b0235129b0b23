/* tests/house/dropin.c: the drop-in files against the library: the same bits. */
#include <stdio.h>
#include <string.h>

#include <lobe_ggx.h>
#include <lobe/lobe.h>

enum { DRAWS = 10000 };

static int differ(lobe_facet_draw a, lobe_reflection_draw_f32 b) {
    float x[6] = {a.wo.x, a.wo.y, a.wo.z, a.cos_im, a.pdf, a.weight};
    float y[6] = {b.wo.x, b.wo.y, b.wo.z, b.cos_im, b.pdf, b.weight};
    return memcmp(x, y, sizeof x) != 0;
}

int main(void) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = LOBE_METHOD_OPTIMAL;
    int differences = 0, rejected = 0;
    for (int k = 0; k < DRAWS; ++k) {
        lobe_random4 r = lobe_random(4, 0, (uint64_t)k), q = lobe_random(4, 1, (uint64_t)k);
        float z = 2.0f * lobe_random_unit_f32(r.word[0]) - 1.0f;
        float x = lobe_k_sqrt(1.0f - z * z), ax = 0.01f + lobe_random_unit_f32(r.word[1]);
        float ay = 0.01f + lobe_random_unit_f32(r.word[2]);
        float u1 = lobe_random_unit_f32(q.word[0]), u2 = lobe_random_unit_f32(q.word[1]);
        lobe_ggx_base g =
            lobe_ggx_base_of(lobe_v3_of(x, 0.0f, z), ax, ay, lobe_facet_options_of(false, false));
        lobe_facet_draw mine = lobe_ggx_optimal_draw(lobe_ggx_optimal_prepare(g), u1, u2, 0.0f);
        lobe_reflection_f32 model =
            lobe_reflection_prepare_f32(options, (lobe_vec3_f32){x, 0.0f, z}, ax, ay);
        lobe_reflection_draw_f32 theirs = lobe_reflection_sample_f32(&model, u1, u2, 0.0f);
        differences += differ(mine, theirs);
        rejected += !(mine.pdf > 0.0f);
    }
    printf("dropin: %d draws, %d rejected, %d differ\n", DRAWS, rejected, differences);
    return differences != 0 || rejected == 0 || rejected == DRAWS;
}
