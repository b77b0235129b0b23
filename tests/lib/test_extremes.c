/* tests/lib/test_extremes.c: every combination of special numbers gives finite results; a density is
 * never negative and never NaN. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "cases.h"

#include <float.h>

static const float specials[] = {0.0f,     -0.0f,    1e-45f,    1e-38f, FLT_EPSILON, 1e-4f,
                                 0.5f,     1.0f,     -1.0f,     2.0f,   1e10f,       FLT_MAX,
                                 -FLT_MAX, INFINITY, -INFINITY, NAN,    -1e-30f,     0.99999994f};
#define SPECIALS (sizeof specials / sizeof *specials)

static int is_density(float x) {
    return isfinite(x) && x >= 0;
}

static void assert_sane_draw(lobe_reflection_draw_f32 s) {
    assert_true(is_density(s.pdf) && is_density(s.weight) && is_density(s.pdf_m));
    assert_true((s.pdf > 0) == (s.weight > 0) || s.weight == 0);
    assert_true(isfinite(s.wo.x) && isfinite(s.wo.y) && isfinite(s.wo.z));
    assert_true(isfinite(s.m.x) && isfinite(s.m.y) && isfinite(s.m.z));
    assert_true(s.pdf == 0 || s.wo.z > 0);
}

static void assert_sane_eval(lobe_reflection_eval_f32 e) {
    assert_true(is_density(e.d) && is_density(e.g1_i) && is_density(e.g1_o) && is_density(e.g2));
    assert_true(is_density(e.pdf_m) && is_density(e.pdf) && is_density(e.f_cos));
}

static lobe_reflection_f32 prepare(int method, lobe_vec3_f32 wi, float ax, float ay) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = lobe_model_at(method);
    return lobe_reflection_prepare_f32(options, wi, ax, ay);
}

static void special_roughness_and_random_numbers(void **state) {
    (void)state;
    const double angles[] = {0, 1e-5, 45, 89.9999, 90, 90.0001, 135, 179.9999, 180};
    for (int m = 0; m < lobe_model_count(); ++m)
        for (size_t d = 0; d < sizeof angles / sizeof *angles; ++d)
            for (size_t a = 0; a < SPECIALS * SPECIALS; ++a) {
                lobe_reflection_f32 model = prepare(m, case_to_f32(case_direction(angles[d], 30)),
                                                    specials[a / SPECIALS], specials[a % SPECIALS]);
                for (size_t u = 0; u < SPECIALS * SPECIALS; u += 1 + a % 3)
                    assert_sane_draw(lobe_reflection_sample_f32(&model, specials[u / SPECIALS],
                                                                specials[u % SPECIALS], 0));
            }
}

static void special_directions(void **state) {
    (void)state;
    const float alpha[][2] = {{0.3f, 0.3f}, {1e-4f, 1}, {0, 0}, {1, 1}};
    for (int m = 0; m < lobe_model_count(); ++m)
        for (size_t a = 0; a < sizeof alpha / sizeof *alpha; ++a)
            for (size_t v = 0; v < SPECIALS * SPECIALS * SPECIALS; ++v) {
                lobe_vec3_f32 d = {specials[v % SPECIALS], specials[v / SPECIALS % SPECIALS],
                                   specials[v / SPECIALS / SPECIALS]};
                lobe_reflection_f32 by_wi = prepare(m, d, alpha[a][0], alpha[a][1]);
                assert_sane_draw(lobe_reflection_sample_f32(&by_wi, 0.3f, 0.7f, 0));
                lobe_vec3_f32 up = {0.6f, 0, 0.8f};
                lobe_reflection_f32 model = prepare(m, up, alpha[a][0], alpha[a][1]);
                assert_sane_eval(lobe_reflection_eval_wo_f32(&model, d));
                assert_true(is_density(lobe_reflection_pdf_f32(&model, d)));
            }
}

/* Straight back along wi there is no half vector: density and value are defined, and 0 if below. */
static void opposite_direction(void **state) {
    (void)state;
    for (int m = 0; m < lobe_model_count(); ++m) {
        lobe_vec3_f32 wi = {0.6f, 0, 0.8f}, back = {-0.6f, 0, -0.8f};
        lobe_reflection_f32 model = prepare(m, wi, 0.5f, 0.5f);
        assert_true(lobe_reflection_pdf_f32(&model, back) == 0);
    }
}

static void smooth_surfaces_are_mirrors(void **state) {
    (void)state;
    for (int m = 0; m < lobe_model_count(); ++m) {
        lobe_vec3_f32 wi = {0.6f, 0, 0.8f};
        lobe_reflection_f32 model = prepare(m, wi, 0, 5e-5f);
        assert_true(model.is_mirror);
        lobe_reflection_draw_f32 s = lobe_reflection_sample_f32(&model, 0.1f, 0.9f, 0);
        assert_true(s.pdf == 1 && s.weight == 1 && s.wo.x == -0.6f && s.wo.z == 0.8f);
        assert_true(lobe_reflection_pdf_f32(&model, s.wo) == 0);
        assert_false(prepare(m, wi, 0, 0.5f).is_mirror);
        assert_false(prepare(m, wi, -1, 0.5f).is_valid);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(special_roughness_and_random_numbers),
                                       cmocka_unit_test(special_directions),
                                       cmocka_unit_test(opposite_direction),
                                       cmocka_unit_test(smooth_surfaces_are_mirrors)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
