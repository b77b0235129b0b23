/* tests/lib/test_precision.c: float against double, and every draw against the density and the value
 * of what it drew. The bounds are the ones stated at the foot of the kernels, with some room. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "cases.h"

#include <stdio.h>

#define DRAWS 40000

static const double alphas[][2] = {{0.01, 0.01}, {0.05, 0.4}, {0.3, 0.3}, {0.2, 0.8},
                                   {1, 1},       {1, 0.1},    {2, 0.5}};
static const double degrees[] = {0, 0.5, 30, 60, 85, 89.5, 95, 140, 175};

static double distance(lobe_vec3_f64 a, lobe_vec3_f32 b) {
    return fabs(a.x - b.x) + fabs(a.y - b.y) + fabs(a.z - b.z);
}

typedef struct worst_case {
    double direction;
    double density;
} worst_case;

/* One method at one configuration: the 99.9 % quantile would hide outliers, so the largest. */
static void compare_precisions(lobe_model row, const double *alpha, double angle,
                               worst_case *worst) {
    lobe_vec3_f32 wf = case_to_f32(case_direction(angle, 27));
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = row;
    lobe_reflection_f32 single =
        lobe_reflection_prepare_f32(options, wf, (float)alpha[0], (float)alpha[1]);
    lobe_reflection_f64 twice =
        lobe_reflection_prepare_f64(options, case_to_f64(wf), (float)alpha[0], (float)alpha[1]);
    for (int k = 0; k < DRAWS / 40; ++k) {
        double u1, u2;
        case_random((uint64_t)row.method, (uint64_t)k, &u1, &u2);
        /* away from the tail of the lobe, where the half vector itself is lost to rounding */
        float f1 = (float)u1, f2 = (float)(0.98 * u2);
        lobe_reflection_draw_f32 a = lobe_reflection_sample_f32(&single, f1, f2, 0.3f);
        lobe_reflection_draw_f64 b = lobe_reflection_sample_f64(&twice, f1, f2, 0.3f);
        if (a.pdf == 0 || b.pdf == 0) continue;
        worst->direction = fmax(worst->direction, distance(b.wo, a.wo));
        /* the density of the float draw, against double at the very normal that was drawn */
        double exact = lobe_reflection_eval_m_f64(&twice, case_to_f64(a.m)).pdf;
        if (exact > 0) worst->density = fmax(worst->density, fabs(a.pdf / exact - 1));
    }
}

/* Far below the horizon a normal in float does not tell visible slopes of Beckmann apart. */
static int is_beyond_float(lobe_ndf ndf, const double *alpha, double angle) {
    return ndf == LOBE_NDF_BECKMANN &&
           1 / tan(angle * CASES_PI / 180) < -10 * fmin(alpha[0], alpha[1]);
}

/* All normals have a density over i.m, which loses its digits where it is small, and roots and error
 * functions as printed cancel by nature. */
static worst_case bounds_of(lobe_model row) {
    worst_case bounds = {3e-4, row.method == LOBE_METHOD_NDF ? 2e-3 : 5e-4};
    if (row.method == LOBE_METHOD_SLOPE_PUBLISHED || row.method == LOBE_METHOD_NEWTON_PUBLISHED)
        bounds.direction = INFINITY;
    return bounds;
}

static void float_follows_double(void **state) {
    (void)state;
    for (int m = 0; m < lobe_model_count(); ++m) {
        const lobe_model row = lobe_model_at(m);
        worst_case worst = {0, 0}, bounds = bounds_of(row);
        for (size_t a = 0; a < sizeof alphas / sizeof *alphas; ++a)
            for (size_t d = 0; d < sizeof degrees / sizeof *degrees; ++d)
                if (!is_beyond_float(row.ndf, alphas[a], degrees[d]))
                    compare_precisions(row, alphas[a], degrees[d], &worst);
        printf("%-8s %-7s %-16s direction %.2g density %.2g\n", lobe_ndf_name(row.ndf),
               lobe_masking_name(row.masking), lobe_method_name(row.method), worst.direction,
               worst.density);
        assert_true(worst.density < bounds.density);
        assert_true(worst.direction < bounds.direction);
    }
}

/* pdf and weight of a draw are those of the direction it returns. */
static void draw_agrees_with_density_and_value(lobe_model row, const double *alpha, double angle) {
    lobe_reflection_f64 m = case_model(row, case_direction(angle, 27), alpha[0], alpha[1]);
    for (int k = 0; k < DRAWS / 40; ++k) {
        double u1, u2;
        case_random(100 + (uint64_t)row.method, (uint64_t)k, &u1, &u2);
        lobe_reflection_draw_f64 s = lobe_reflection_sample_f64(&m, u1, u2, 0);
        assert_true((s.pdf > 0) == (s.weight > 0));
        if (!(s.pdf > 0)) continue;
        lobe_reflection_eval_f64 e = lobe_reflection_eval_wo_f64(&m, s.wo);
        /* what rounding of wo does to the half vector: relative to wi . m */
        double room = 1e-12 + 1e-13 / (s.cos_im * s.cos_im * alpha[0] * alpha[0]);
        if (!(fabs(e.pdf / s.pdf - 1) < room) || !(fabs(e.f_cos / (s.pdf * s.weight) - 1) < room))
            fail_msg("%s alpha %g %g angle %g: pdf %.17g against %.17g, f cos %.17g, weight %.17g",
                     lobe_method_name(row.method), alpha[0], alpha[1], angle, e.pdf, s.pdf, e.f_cos,
                     s.weight);
        assert_true(e.pdf == lobe_reflection_pdf_f64(&m, s.wo));
        assert_true(fabs(s.wo.x * s.wo.x + s.wo.y * s.wo.y + s.wo.z * s.wo.z - 1) < 1e-13);
        assert_true(fabs(s.pdf_m / (4 * s.cos_im * s.pdf) - 1) < 1e-12);
    }
}

static void draws_agree_with_density_and_value(void **state) {
    (void)state;
    for (int m = 0; m < lobe_model_count(); ++m)
        for (size_t a = 0; a < sizeof alphas / sizeof *alphas; ++a)
            for (size_t d = 0; d < sizeof degrees / sizeof *degrees; ++d)
                draw_agrees_with_density_and_value(lobe_model_at(m), alphas[a], degrees[d]);
}

/* Plain visible normals and the smaller caps never weigh more than they promise. */
static void weights_are_bounded(void **state) {
    (void)state;
    const lobe_method methods[] = {LOBE_METHOD_SLOPE, LOBE_METHOD_ELLIPSOID, LOBE_METHOD_CAPS,
                                   LOBE_METHOD_BOUNDED, LOBE_METHOD_OPTIMAL};
    for (size_t m = 0; m < sizeof methods / sizeof *methods; ++m) {
        for (size_t d = 0; d < sizeof degrees / sizeof *degrees; ++d) {
            lobe_reflection_f64 model =
                case_model(smith_ggx(methods[m]), case_direction(degrees[d], 80), 0.2, 0.8);
            for (uint64_t k = 0; k < 2000; ++k) {
                double u1, u2;
                case_random(7, k, &u1, &u2);
                assert_true(lobe_reflection_sample_f64(&model, u1, u2, 0).weight <= 1 + 1e-12);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(float_follows_double),
                                       cmocka_unit_test(draws_agree_with_density_and_value),
                                       cmocka_unit_test(weights_are_bounded)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
