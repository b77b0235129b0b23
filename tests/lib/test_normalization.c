/* tests/lib/test_normalization.c: what the densities of visible normals integrate to, by formula and by
 * quadrature, on both sides of the surface and with both normalisations. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "cases.h"

/* The normals that face i and lie above the surface, seen in the space where the roughness is 1: a lune
 * between two half planes. Its axis lies in the surface, across i; t is the latitude about it and psi
 * the angle around it, from the surface's normal toward i. */
typedef struct lune {
    double cos_azimuth, sin_azimuth, first_psi;
} lune;

static lune lune_of(lobe_vec3_f64 wi, double ax, double ay) {
    const double x = ax * wi.x, y = ay * wi.y, across = hypot(x, y);
    const lune l = {x / across, y / across, atan2(across, wi.z) - CASES_PI / 2};
    return l;
}

/* The normal at (t, psi), and the solid angle that a unit square of (t, psi) has there. */
static lobe_vec3_f64 lune_normal(lune l, double ax, double ay, double t, double psi,
                                 double *solid_angle) {
    const double toward = cos(t) * sin(psi), side = sin(t), up = cos(t) * cos(psi);
    lobe_vec3_f64 m = {ax * (l.cos_azimuth * toward - l.sin_azimuth * side),
                       ay * (l.sin_azimuth * toward + l.cos_azimuth * side), up};
    const double length = sqrt(m.x * m.x + m.y * m.y + m.z * m.z);
    *solid_angle = cos(t) * ax * ay / (length * length * length);
    m.x /= length;
    m.y /= length;
    m.z /= length;
    return m;
}

/* The midpoint rule: second order where the density is smooth, first order over its jumps. */
static double integral_of_pdf_m(const lobe_reflection_f64 *model, int n) {
    const double ax = model->alpha_x, ay = model->alpha_y;
    const lune l = lune_of(model->wi, ax, ay);
    const double dt = CASES_PI / n, dpsi = (CASES_PI / 2 - l.first_psi) / n;
    double sum = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            double solid_angle;
            const lobe_vec3_f64 m = lune_normal(l, ax, ay, (i + 0.5) * dt - CASES_PI / 2,
                                                l.first_psi + (j + 0.5) * dpsi, &solid_angle);
            sum += lobe_reflection_eval_m_f64(model, m).pdf_m * solid_angle;
        }
    return sum * dt * dpsi;
}

static lobe_reflection_f64 prepared(lobe_model row, double theta, double ax, double ay,
                                    lobe_normalization normalization) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = row;
    options.normalization = normalization;
    return lobe_reflection_prepare_f64(options, case_direction(theta, 25), ax, ay);
}

/* Methods whose density of normals has no jumps: it is that of all visible normals of Smith's model. */
static int is_smooth(lobe_model row) {
    const char *name = lobe_method_name(row.method);
    return row.masking == LOBE_MASKING_SMITH &&
           (strcmp(name, "caps") == 0 || strcmp(name, "ellipsoid") == 0 ||
            strcmp(name, "slope") == 0 || strcmp(name, "newton") == 0);
}

static void formula_agrees_with_quadrature(void **state) {
    (void)state;
    const double roughness[3][2] = {{0.3, 0.3}, {0.25, 0.8}, {1, 1}};
    const double thetas[5] = {40, 85, 93, 101, 118};
    for (int r = 0; r < lobe_model_count(); ++r) {
        const lobe_model row = lobe_model_at(r);
        if (row.method == LOBE_METHOD_NDF) continue;
        /* a Gaussian falls off faster than the rule is fine */
        const double smooth = row.ndf == LOBE_NDF_GGX ? 2e-5 : 2e-4;
        const double tolerance = is_smooth(row) ? smooth : 1e-2;
        for (int a = 0; a < 3; ++a)
            for (int k = 0; k < 5; ++k)
                for (int p = 0; p < 2; ++p) {
                    const lobe_reflection_f64 m = prepared(row, thetas[k], roughness[a][0],
                                                           roughness[a][1], (lobe_normalization)p);
                    const double formula = lobe_reflection_vndf_integral_f64(&m);
                    const double sum = integral_of_pdf_m(&m, is_smooth(row) ? 250 : 150);
                    if (!(fabs(sum - formula) <= tolerance * formula))
                        fail_msg("%s %s %s, alpha %g,%g, theta %g, %s: %.7g is not %.7g",
                                 lobe_ndf_name(row.ndf), lobe_masking_name(row.masking),
                                 lobe_method_name(row.method), roughness[a][0], roughness[a][1],
                                 thetas[k], p ? "previous" : "unbiased", sum, formula);
                }
    }
}

/* The unbiased one is a density everywhere; the previous one is not from behind, and says less the
 * farther i lies behind. */
static void previous_normalization_falls_behind_the_surface(void **state) {
    (void)state;
    for (int r = 0; r < lobe_model_count(); ++r) {
        double last = 1;
        for (double theta = 80; theta < 130; theta += 5) {
            const lobe_reflection_f64 right =
                prepared(lobe_model_at(r), theta, 0.4, 0.7, LOBE_NORMALIZATION_UNBIASED);
            const lobe_reflection_f64 previous =
                prepared(lobe_model_at(r), theta, 0.4, 0.7, LOBE_NORMALIZATION_PREVIOUS);
            const double integral = lobe_reflection_vndf_integral_f64(&previous);
            assert_true(lobe_reflection_vndf_integral_f64(&right) == 1);
            assert_true(theta > 90 ? integral > 0 && integral < last : integral == 1);
            last = integral;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formula_agrees_with_quadrature),
        cmocka_unit_test(previous_normalization_falls_behind_the_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
