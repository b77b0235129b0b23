/* tests/kernel/planes_template.h: draws above two planes, one by one. Before including: a binding, and
 *   SAME_PDF     largest relative difference between a draw's density and that of its own (m, wo, wi.m)
 *   SAME_WEIGHT  between its weight and f cos/pdf there
 *   UNIT         | |wo| - 1 | */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "lobe/random.h"
#include "tools/numerics/plane_cases.h"

#include <inttypes.h>

static double unit(uint64_t k, int stream, int word) {
    return (double)lobe_random_unit_f32(lobe_random(77, (uint64_t)stream, k).word[word]);
}

static v3 at(double z, double turn) {
    double s = sqrt(1 - z * z), phi = 2 * 3.14159265358979323846 * turn;
    return v3_of((real)(s * cos(phi)), (real)(s * sin(phi)), (real)z);
}

/* Roughness 0.05 to 2, wi from above and from behind the shading plane, tilts to 60 degrees; in a third
 * wi within 0.01 of the geometric plane. wi is on its front: where it is not, the plane is turned over to
 * the other side of z. */
static ggx_base configuration(uint64_t k) {
    double ax = 0.05 * pow(40, unit(k, 0, 0));
    double ay = k % 4 == 0 ? ax : 0.05 * pow(40, unit(k, 0, 1));
    double tilt = 0.02 + 1.02 * unit(k, 0, 2), turn = unit(k, 0, 3);
    v3 plane = at(cos(tilt), turn);
    double z = k % 2 ? 0.01 + 0.98 * unit(k, 1, 0) : -0.5 * unit(k, 1, 0);
    v3 wi = at(z, unit(k, 1, 1));
    if (k % 3 == 0) {
        double height = 0.01 * unit(k, 1, 2) + 1e-4;
        v3 across = v3_normalize(v3_sub(wi, v3_scale(plane, v3_dot(wi, plane))));
        wi = v3_add(v3_scale(across, (real)sqrt(1 - height * height)),
                    v3_scale(plane, (real)height));
    }
    if (v3_dot(wi, plane) < R(0.0)) plane = v3_of(-plane.x, -plane.y, plane.z);
    return plane_base(wi, plane, ax, ay, 0.125 * (double)(k % 9));
}

static void describe(ggx_base g) {
    print_message("alpha %a %a wi %a %a %a plane %a %a %a\n", (double)g.ax, (double)g.ay,
                  (double)g.wi.x, (double)g.wi.y, (double)g.wi.z, (double)g.plane.x,
                  (double)g.plane.y, (double)g.plane.z);
}

static real drawn_unit(uint64_t k, uint64_t j, int word) {
    return (real)lobe_random_unit_f32(lobe_random(k, 3, j).word[word]);
}

enum { POINTS = 1200, DRAWS = 1000 };

static void nothing_below_either_plane(void **state) {
    (void)state;
    int cut = 0, points = 0;
    for (uint64_t k = 0; k < POINTS; ++k) {
        ggx_base g = configuration(k);
        if (!k_is(g.valid)) continue;
        ++points;
        ggx_horizon_plane_table s = ggx_horizon_plane_table_prepare(g);
        cut += k_is(s.disk.cuts);
        assert_true(ggx_horizon_plane_table_acceptance(s) ==
                    k_select(k_is(s.disk.cuts), R(1.0), R(-1.0)));
        for (uint64_t j = 0; j < DRAWS; ++j) {
            facet_draw d =
                ggx_horizon_plane_table_draw(s, drawn_unit(k, j, 0), drawn_unit(k, j, 1), R(0.0));
            bool leaves = facet_leaves(d.wo, g.plane);
            if (d.pdf > R(0.0) ? !leaves : k_is(s.disk.cuts)) {
                describe(g);
                fail_msg("%" PRIu64 ".%" PRIu64 ": pdf %g wo.z %g wo.plane %g", k, j, (double)d.pdf,
                         (double)d.wo.z, (double)v3_dot(d.wo, g.plane));
            }
        }
    }
    print_message("%d of %d points draw without rejection\n", cut, points);
    assert_true(points > POINTS * 3 / 4);
    assert_true(cut >= points * 99 / 100);
}

static void densities_agree(void **state) {
    (void)state;
    double worst_pdf = 0, worst_weight = 0, worst_unit = 0;
    for (uint64_t k = 0; k < POINTS; ++k) {
        ggx_base g = configuration(k);
        if (!k_is(g.valid)) continue;
        ggx_horizon_plane_table s = ggx_horizon_plane_table_prepare(g);
        for (uint64_t j = 0; j < 100; ++j) {
            facet_draw d =
                ggx_horizon_plane_table_draw(s, drawn_unit(k, j, 0), drawn_unit(k, j, 1), R(0.0));
            if (!(d.pdf > R(0.0))) continue;
            facet_pair pair = ggx_pair_of_m(g, d.m);
            pair.wo = d.wo;
            pair.cos_im = d.cos_im;
            pair.leaves = true;
            double pdf = fabs((double)ggx_horizon_plane_table_pdf(s, pair) / (double)d.pdf - 1);
            double weight =
                fabs((double)(ggx_f_cos(g, pair) / d.pdf) / (double)k_max(d.weight, K_TINY) - 1);
            double length = fabs(sqrt((double)v3_dot(d.wo, d.wo)) - 1);
            if (!(pdf < SAME_PDF) || !(weight < SAME_WEIGHT) || !(length < UNIT)) {
                describe(g);
                fail_msg("%" PRIu64 ".%" PRIu64 ": pdf %g weight %g length %g", k, j, pdf, weight,
                         length);
            }
            worst_pdf = fmax(worst_pdf, pdf);
            worst_weight = fmax(worst_weight, weight);
            worst_unit = fmax(worst_unit, length);
        }
    }
    print_message("density %.2g, weight %.2g, |wo| %.2g\n", worst_pdf, worst_weight, worst_unit);
}

/* The density is continuous where the plane becomes the shading plane. */
static void tilt_to_nothing(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 200; ++k) {
        double ax = 0.1 * pow(15, unit(k, 0, 0)), ay = 0.1 * pow(15, unit(k, 0, 1));
        v3 wi = at(k % 2 ? 0.2 + 0.75 * unit(k, 1, 0) : -0.2 - 0.4 * unit(k, 1, 0), unit(k, 1, 1));
        v3 z = v3_of(R(0.0), R(0.0), R(1.0));
        /* from behind there is no such limit: wi would lie behind the plane */
        if (wi.z < R(0.0)) continue;
        double tilt = 1e-4, turn = unit(k, 0, 2);
        ggx_horizon_plane_table flat =
            ggx_horizon_plane_table_prepare(plane_base(wi, z, ax, ay, 0.25));
        ggx_base g = plane_base(wi, at(cos(tilt), turn), ax, ay, 0.25);
        ggx_horizon_plane_table tilted = ggx_horizon_plane_table_prepare(g);
        for (uint64_t j = 0; j < 20; ++j) {
            facet_draw d = ggx_horizon_plane_table_draw(flat, drawn_unit(k, j, 0),
                                                        R(0.95) * drawn_unit(k, j, 1), R(0.0));
            facet_pair pair = ggx_pair_of_wo(g, d.wo);
            double a = (double)ggx_horizon_plane_table_pdf(flat, pair);
            double b = (double)ggx_horizon_plane_table_pdf(tilted, pair);
            if (!(fabs(b / a - 1) < 0.02)) {
                describe(g);
                fail_msg("%" PRIu64 ".%" PRIu64 ": %g and %g", k, j, a, b);
            }
        }
    }
}

/* Whatever goes in, what comes out is finite; straight back, from behind, mirrors, sheets. */
static void extremes_stay_finite(void **state) {
    (void)state;
    static const double alphas[] = {0, 1e-4, 1e-2, 1, 100, 1e4};
    static const double us[] = {0, 1e-7, 0.25, 0.5, 0.9999999, 1 - 1e-16};
    for (int k = 0; k < 6 * 6 * 7 * 6; ++k) {
        v3 wi = plane_direction(30 * (k / 36 % 7) - (k % 5 ? 1e-4 : 0), 40 * k);
        v3 plane = plane_direction(18 * (k / 252 % 6), 15 * k);
        ggx_base g = plane_base(wi, plane, alphas[k % 6], alphas[k / 6 % 6], 0.1);
        ggx_horizon_plane_table s = ggx_horizon_plane_table_prepare(g);
        ggx_horizon_plane_ellipse e = ggx_horizon_plane_ellipse_prepare(g);
        for (int j = 0; j < 36; ++j) {
            real u1 = k_min((real)us[j % 6], K_BELOW_ONE), u2 = k_min((real)us[j / 6], K_BELOW_ONE);
            facet_draw d[2] = {ggx_horizon_plane_table_draw(s, u1, u2, R(0.5)),
                               ggx_horizon_plane_ellipse_draw(e, u1, u2, R(0.5))};
            for (int m = 0; m < 2; ++m) {
                bool usable = d[m].pdf >= R(0.0) && k_is_finite(d[m].pdf) &&
                              d[m].weight >= R(0.0) && k_is_finite(d[m].weight) &&
                              d[m].pdf_m >= R(0.0) && k_is_finite(d[m].pdf_m) &&
                              (d[m].pdf == R(0.0) || facet_leaves(d[m].wo, g.plane));
                if (!usable || (!k_is(g.valid) && d[m].pdf != R(0.0))) {
                    describe(g);
                    fail_msg("%d.%d: pdf %g weight %g", k, j, (double)d[m].pdf,
                             (double)d[m].weight);
                }
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_below_either_plane), cmocka_unit_test(densities_agree),
        cmocka_unit_test(tilt_to_nothing), cmocka_unit_test(extremes_stay_finite)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
