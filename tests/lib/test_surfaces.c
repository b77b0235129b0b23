/* tests/lib/test_surfaces.c: Beckmann and V-cavities against what is known of them in closed form, from
 * textbook formulas in long double. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "cases.h"

static const double alphas[][2] = {{0.2, 0.2}, {0.5, 0.5}, {0.3, 0.9}, {1, 1}, {1.6, 0.4}};
enum { ALPHAS = sizeof alphas / sizeof *alphas, SIDE = 256 };

static void assert_near(double value, double expected, double tolerance, lobe_model row) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%s %s %s: %.17g is not %.17g +- %g", lobe_ndf_name(row.ndf),
                 lobe_masking_name(row.masking), lobe_method_name(row.method), value, expected,
                 tolerance);
}

static lobe_reflection_draw_f64 draw(const lobe_reflection_f64 *model, int index) {
    double u1 = (index % SIDE + 0.5) / SIDE, u2 = (index / SIDE + 0.5) / SIDE;
    double u3 = index * 0.6180339887498949;
    return lobe_reflection_sample_f64(model, u1, u2, u3 - floor(u3));
}

/* Methods that draw the visible normals, whatever becomes of them; at normal incidence those are all
 * normals. */
static int draws_what_is_visible(lobe_method method) {
    return method == LOBE_METHOD_NDF || method == LOBE_METHOD_SLOPE ||
           method == LOBE_METHOD_NEWTON || method == LOBE_METHOD_NEWTON_PUBLISHED ||
           method == LOBE_METHOD_VCAVITY;
}

/* A normal of slope above 1 reflects what comes straight from above into the surface: of GGX a share of
 * alpha^2/(1 + alpha^2), of Beckmann exp(-1/alpha^2). */
static void rejected_at_normal_incidence(void **state) {
    (void)state;
    for (int m = 0; m < lobe_model_count(); ++m) {
        const lobe_model row = lobe_model_at(m);
        if (!draws_what_is_visible(row.method)) continue;
        for (double a = 0.4; a < 2; a *= 1.5) {
            lobe_reflection_f64 model = case_model(row, case_direction(0, 0), a, a);
            int rejected = 0;
            for (int k = 0; k < SIDE * SIDE; ++k) rejected += draw(&model, k).pdf == 0;
            double share = row.ndf == LOBE_NDF_GGX ? a * a / (1 + a * a) : exp(-1 / (a * a));
            assert_near((double)rejected / (SIDE * SIDE), share, 0.004, row);
        }
    }
}

/* The slopes whose reflection leaves fill the disk |S + i_xy/i_z| <= 1/i_z, whatever their distribution. */
static void useful_slopes_fill_a_disk(void **state) {
    (void)state;
    for (int m = 0; m < lobe_model_count(); ++m)
        for (int a = 0; a < ALPHAS; ++a)
            for (double angle = 10; angle < 90; angle += 25) {
                lobe_vec3_f64 i = case_direction(angle, 50);
                lobe_reflection_f64 model =
                    case_model(lobe_model_at(m), i, alphas[a][0], alphas[a][1]);
                for (int k = 0; k < SIDE * SIDE; k += 61) {
                    lobe_reflection_draw_f64 d = draw(&model, k);
                    double x = i.x / i.z - d.m.x / d.m.z, y = i.y / i.z - d.m.y / d.m.z;
                    double room = 1 / i.z - sqrt(x * x + y * y);
                    if (fabs(room) > 1e-6) assert_true((d.pdf > 0) == (room > 0 && d.cos_im > 0));
                }
            }
}

/* Beckmann's `horizon` rejects nothing; from behind nobody but `ndf` does. */
static void what_is_never_rejected(void **state) {
    (void)state;
    for (int m = 0; m < lobe_model_count(); ++m) {
        const lobe_model row = lobe_model_at(m);
        for (int a = 0; a < ALPHAS; ++a)
            for (double angle = 5; angle < 160; angle += 31) {
                int all =
                    angle > 90 ? row.method != LOBE_METHOD_NDF : row.method == LOBE_METHOD_HORIZON;
                if (!all) continue;
                lobe_reflection_f64 model =
                    case_model(row, case_direction(angle, 20), alphas[a][0], alphas[a][1]);
                assert_near(lobe_reflection_acceptance_f64(&model), 1, 1e-12, row);
                for (int k = 0; k < SIDE * SIDE; k += 61) assert_true(draw(&model, k).pdf > 0);
            }
    }
}

/* 2 |i_z|/V(i), V = i_z erfc(-c) + b exp(-c^2)/sqrt(pi), c = i_z/b (Tokuyoshi 2021) */
static long double beckmann_normaliser(lobe_vec3_f64 i, const double *alpha) {
    long double x = alpha[0] * i.x, y = alpha[1] * i.y, b = sqrtl(x * x + y * y), c = i.z / b;
    long double v = i.z * erfcl(-c) + b * expl(-c * c) / sqrtl(acosl(-1));
    return 2 * fabsl(i.z) / v;
}

static void smith_beckmann_normaliser(void **state) {
    (void)state;
    const lobe_model row = {LOBE_NDF_BECKMANN, LOBE_MASKING_SMITH, LOBE_METHOD_NEWTON};
    for (int a = 0; a < ALPHAS; ++a)
        for (double angle = 3; angle < 115; angle += 7) {
            lobe_vec3_f64 i = case_direction(angle, 33);
            lobe_reflection_f64 model = case_model(row, i, alphas[a][0], alphas[a][1]);
            double g1 = lobe_reflection_eval_wo_f64(&model, case_direction(20, 10)).g1_i;
            long double exact = beckmann_normaliser(i, alphas[a]);
            assert_near(g1 / (double)exact, 1, 1e-11, row);
        }
}

/* The hit probability as it is printed: for GGX 1 + (sqrt(r2 + 9 z2) - sqrt(r2 + z2))/(2 z), for Beckmann
 * the mean of erfc over [a, 3a], here by its antiderivative. */
static long double hit_probability(lobe_ndf ndf, lobe_vec3_f64 i, const double *alpha) {
    long double x = alpha[0] * i.x, y = alpha[1] * i.y, r2 = x * x + y * y, z = i.z;
    if (z >= 0) return 1;
    if (ndf == LOBE_NDF_GGX) return 1 + (sqrtl(r2 + 9 * z * z) - sqrtl(r2 + z * z)) / (2 * z);
    long double a = -z / sqrtl(r2), root_pi = sqrtl(acosl(-1));
    long double to = 3 * a * erfcl(3 * a) - expl(-9 * a * a) / root_pi;
    return (to - a * erfcl(a) + expl(-a * a) / root_pi) / (2 * a);
}

static void vcavity_normaliser(void **state) {
    (void)state;
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ++ndf) {
        const lobe_model row = {(lobe_ndf)ndf, LOBE_MASKING_VCAVITY, LOBE_METHOD_VCAVITY};
        for (int a = 0; a < ALPHAS; ++a)
            for (double angle = 8; angle < 115; angle += 7) {
                lobe_vec3_f64 i = case_direction(angle, 33);
                lobe_reflection_f64 model = case_model(row, i, alphas[a][0], alphas[a][1]);
                lobe_reflection_eval_f64 e =
                    lobe_reflection_eval_wo_f64(&model, case_direction(20, 10));
                lobe_vec3_f64 o = case_direction(20, 10);
                double m_z = (i.z + o.z) / (2 * e.cos_im);
                double g1 = fmin(1, 2 * m_z * fabs(i.z) / e.cos_im);
                if (!(e.cos_im > 0 && m_z > 0)) continue;
                long double exact = hit_probability((lobe_ndf)ndf, i, alphas[a]);
                assert_near(g1 / e.g1_i / (double)exact, 1, 1e-11, row);
            }
    }
}

/* Grazing incidence from above: a V-cavity seen at 89.9 degrees still gives each side its share. The mean
 * weight is the albedo by quadrature. */
static void grazing_albedo(void **state) {
    (void)state;
    for (int m = 0; m < lobe_model_count(); ++m) {
        const lobe_model row = lobe_model_at(m);
        if (row.method == LOBE_METHOD_NDF || row.method == LOBE_METHOD_SLOPE_PUBLISHED) continue;
        lobe_vec3_f64 i = case_direction(89.9, 30);
        lobe_microsurface s = {row.ndf, row.masking, LOBE_G2_CORRELATED, 0.4, 0.4};
        double exact = lobe_albedo(s, lobe_reflectance_one(), i, LOBE_EFFORT_FINE);
        lobe_reflection_f64 model = case_model(row, i, 0.4, 0.4);
        double sum = 0;
        for (int k = 0; k < SIDE * SIDE; ++k) sum += draw(&model, k).weight;
        assert_near(sum / (SIDE * SIDE), exact, 0.002, row);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rejected_at_normal_incidence), cmocka_unit_test(useful_slopes_fill_a_disk),
        cmocka_unit_test(what_is_never_rejected),       cmocka_unit_test(smith_beckmann_normaliser),
        cmocka_unit_test(vcavity_normaliser),           cmocka_unit_test(grazing_albedo),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
