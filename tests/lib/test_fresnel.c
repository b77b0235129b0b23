/* tests/lib/test_fresnel.c: averages against quadrature, known values, float against double. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "cases.h"

/* 2 * integral of F(mu) mu dmu with mu = t^2, which removes the root at a grazing angle */
#define AVERAGE(result, call)                                                                      \
    do {                                                                                           \
        const int count_ = 400000;                                                                 \
        result = 0;                                                                                \
        for (int step_ = 0; step_ < count_; ++step_) {                                             \
            double t = (step_ + 0.5) / count_, mu = t * t;                                         \
            result += 4 * mu * t * (call) / count_;                                                \
        }                                                                                          \
    } while (0)

static void assert_near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.17g is not %.17g +- %g", value, expected, tolerance);
}

static void averages_are_the_integrals(void **state) {
    (void)state;
    double q;
    AVERAGE(q, lobe_fresnel_schlick_f64(0.3, mu));
    assert_near(lobe_fresnel_schlick_average_f64(0.3), q, 1e-9);
    AVERAGE(q, lobe_fresnel_f82_f64(0.6, 0.7, mu));
    assert_near(lobe_fresnel_f82_average_f64(0.6, 0.7), q, 1e-9);
    const double indices[] = {1.0, 1.0001, 1.01, 1.33, 1.4999, 1.5, 2, 2.9, 10, 0.9999, 0.75, 0.4};
    for (size_t k = 0; k < sizeof indices / sizeof *indices; ++k) {
        AVERAGE(q, lobe_fresnel_dielectric_f64(indices[k], mu));
        assert_near(lobe_fresnel_dielectric_average_f64(indices[k]), q, 1e-7);
        assert_near(lobe_fresnel_dielectric_average_f32((float)indices[k]), q, 2e-6);
    }
}

/* Where a dark tint is clamped, as far off as lobe/fresnel.h says, and never negative. */
static void clamped_averages_are_bounded(void **state) {
    (void)state;
    enum { STEPS = 1000 };
    for (double f0 = 0; f0 <= 1; f0 += 1.0 / 64)
        for (double tint = 0; tint <= 1; tint += 1.0 / 16) {
            double q = 0;
            for (int i = 0; i < STEPS; ++i) {
                const double mu = (i + 0.5) / STEPS;
                q += 2 * mu * lobe_fresnel_f82_f64(f0, tint, mu) / STEPS;
            }
            const double below = q - lobe_fresnel_f82_average_f64(f0, tint);
            const double most = tint > 0.52 ? 0 : f0 >= 0.4 ? 9e-4 : f0 >= 0.1 ? 8e-3 : 0.017;
            if (!(below > -2e-6 && below < most + 2e-6))
                fail_msg("f0 %g, tint %g: %g below", f0, tint, below);
            assert_true(lobe_fresnel_f82_average_f32((float)f0, (float)tint) >= 0.0f);
        }
}

/* The sum of twelve, where lobe/fresnel.h says so, against the quadrature; and once against the definition. Float
 * keeps its digits where n is small beside k. */
static void averages_of_conductors(void **state) {
    (void)state;
    for (double n = 1e-3; n < 1e3; n *= 1.6)
        for (double k = 1e-3; k < 1e3; k *= 1.6) {
            const double q =
                lobe_reflectance_average((lobe_reflectance){LOBE_REFLECTANCE_CONDUCTOR, n, k});
            const double room = k >= 0.5 || n >= 1.2 ? 1e-6 : 0.06;
            assert_near(lobe_fresnel_conductor_average_f64(n, k), q, room);
            assert_near(lobe_fresnel_conductor_average_f32((float)n, (float)k), q, room + 1e-6);
            for (double mu = 0; mu <= 1; mu += 1.0 / 32)
                assert_near(lobe_fresnel_conductor_f32((float)n, (float)k, (float)mu),
                            lobe_fresnel_conductor_f64((float)n, (float)k, mu), 1e-6);
        }
    double q;
    AVERAGE(q, lobe_fresnel_conductor_f64(0.2, 3.4, mu));
    assert_near(lobe_fresnel_conductor_average_f64(0.2, 3.4), q, 1e-7);
}

static void known_values(void **state) {
    (void)state;
    assert_near(lobe_fresnel_dielectric_f64(1.5, 1), 0.04, 1e-15);
    assert_near(lobe_fresnel_dielectric_f64(1.5, 0), 1, 1e-15);
    assert_near(lobe_fresnel_dielectric_f64(1 / 1.5, 0.5), 1, 0);
    double brewster = cos(atan(1.5)), r_s = (1.5 * 1.5 - 1) / (1.5 * 1.5 + 1);
    assert_near(lobe_fresnel_dielectric_f64(1.5, brewster), 0.5 * r_s * r_s, 1e-15);
    assert_near(lobe_fresnel_conductor_f64(1.5, 0, 0.3), lobe_fresnel_dielectric_f64(1.5, 0.3),
                1e-14);
    /* normal incidence: ((n - 1)^2 + k^2)/((n + 1)^2 + k^2) */
    assert_near(lobe_fresnel_conductor_f64(0.2, 3.9, 1), (0.64 + 15.21) / (1.44 + 15.21), 1e-14);
    assert_near(lobe_fresnel_f82_f64(0.8, 0.9, 1.0 / 7),
                0.9 * lobe_fresnel_schlick_f64(0.8, 1.0 / 7), 1e-14);
    assert_near(lobe_fresnel_dielectric_average_f64(1.5), 0.091777959342351212, 1e-13);
}

static void float_follows_double(void **state) {
    (void)state;
    for (double mu = 0; mu <= 1; mu += 1.0 / 512)
        for (double n = 0.3; n < 4; n *= 1.1) {
            float f = (float)n, c = (float)mu;
            double far_from_total = f < 1 ? fabs(f * (double)f - 1 + c * (double)c) : 1;
            double room = 4e-7 / sqrt(fmax(far_from_total, 1e-7));
            assert_near(lobe_fresnel_dielectric_f32(f, c), lobe_fresnel_dielectric_f64(f, c), room);
            assert_near(lobe_fresnel_conductor_f32(f, 2, c), lobe_fresnel_conductor_f64(f, 2, c),
                        1e-6);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(averages_are_the_integrals),
        cmocka_unit_test(clamped_averages_are_bounded), cmocka_unit_test(averages_of_conductors),
        cmocka_unit_test(known_values), cmocka_unit_test(float_follows_double)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
