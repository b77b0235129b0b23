/* tests/lib/test_oracles.c: exact values that do not come from the library's own formulas. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "cases.h"

static void assert_near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.17g is not %.17g +- %g", value, expected, tolerance);
}

/* What is rejected of the visible normals: a^2/(1 + a^2) at normal incidence, mu/(1 + mu) at
 * roughness 1. */
static void rejected_share_of_visible_normals(void **state) {
    (void)state;
    for (double a = 0.01; a < 3; a *= 1.7) {
        lobe_reflection_f64 m = case_model(smith_ggx(LOBE_METHOD_CAPS), case_direction(0, 0), a, a);
        assert_near(lobe_reflection_acceptance_f64(&m), 1 / (1 + a * a), 1e-14);
    }
    for (double t = 0; t < 90; t += 7) {
        lobe_reflection_f64 m =
            case_model(smith_ggx(LOBE_METHOD_ELLIPSOID), case_direction(t, 33), 1, 1);
        double mu = cos(t * CASES_PI / 180);
        assert_near(lobe_reflection_acceptance_f64(&m), 1 / (1 + mu), 1e-14);
    }
}

/* Bounded caps reject nothing at normal incidence (isotropic) and nothing at roughness 1, where
 * their density is that of the uniform hemisphere. */
static void bounded_caps_where_they_are_exact(void **state) {
    (void)state;
    for (double a = 0.01; a <= 1; a *= 1.5) {
        lobe_reflection_f64 m =
            case_model(smith_ggx(LOBE_METHOD_BOUNDED), case_direction(0, 0), a, a);
        assert_near(lobe_reflection_acceptance_f64(&m), 1, 1e-13);
    }
    for (double t = 0; t < 90; t += 7) {
        lobe_reflection_f64 m =
            case_model(smith_ggx(LOBE_METHOD_BOUNDED), case_direction(t, 71), 1, 1);
        assert_near(lobe_reflection_acceptance_f64(&m), 1, 1e-14);
        assert_near(lobe_reflection_pdf_f64(&m, case_direction(61, 200)), 0.5 / CASES_PI, 1e-14);
    }
}

/* Five rows of docs/optimal-caps.md, to its three digits. */
static void accepted_share_of_the_three_caps(void **state) {
    (void)state;
    const double rows[5][7] = {
        {0.7, 0.7, 40, 0, 0.707, 0.942, 0.970},  {0.2, 0.8, 40, 45, 0.784, 0.802, 0.916},
        {0.2, 0.8, 60, 90, 0.847, 0.860, 0.965}, {0.1, 1.0, 60, 45, 0.780, 0.784, 0.956},
        {0.5, 1.0, 75, 0, 0.788, 0.858, 0.975},
    };
    const lobe_method methods[3] = {LOBE_METHOD_CAPS, LOBE_METHOD_BOUNDED, LOBE_METHOD_OPTIMAL};
    for (int r = 0; r < 5; ++r) {
        for (int k = 0; k < 3; ++k) {
            lobe_vec3_f64 wi = case_direction(rows[r][2], rows[r][3]);
            lobe_reflection_f64 m = case_model(smith_ggx(methods[k]), wi, rows[r][0], rows[r][1]);
            assert_near(lobe_reflection_acceptance_f64(&m), rows[r][4 + k], 0.0006);
        }
    }
}

/* Directional albedo at roughness 1: 1 - mu ln(1 + 1/mu), and 2 (1 - ln 2)/(1 + mu) if separable; by
 * the midpoint rule over the bounded caps' square, where the integrand is smooth. */
static void albedo_at_roughness_one(void **state) {
    (void)state;
    const int n = 512;
    for (int separable = 0; separable < 2; ++separable) {
        for (double mu = 0.1; mu < 1; mu += 0.2) {
            lobe_reflection_options options = lobe_reflection_default_options();
            options.model.method = LOBE_METHOD_BOUNDED;
            options.g2 = separable ? LOBE_G2_SEPARABLE : LOBE_G2_CORRELATED;
            lobe_vec3_f64 wi = {sqrt(1 - mu * mu), 0, mu};
            lobe_reflection_f64 m = lobe_reflection_prepare_f64(options, wi, 1, 1);
            double sum = 0;
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                    sum += lobe_reflection_sample_f64(&m, (i + 0.5) / n, (j + 0.5) / n, 0).weight;
            double exact = separable ? 2 * (1 - log(2)) / (1 + mu) : 1 - mu * log(1 + 1 / mu);
            assert_near(sum / ((double)n * n), exact, 2e-5);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rejected_share_of_visible_normals),
        cmocka_unit_test(bounded_caps_where_they_are_exact),
        cmocka_unit_test(accepted_share_of_the_three_caps),
        cmocka_unit_test(albedo_at_roughness_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
