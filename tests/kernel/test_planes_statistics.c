/* Two planes: what the densities integrate to, whether draws follow them, the means and the variance of
 * what they give. The oracle is `caps`, which knows nothing of ellipses. */
#include "kernel/bind/c_f64.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/ggx_caps.h"
#include "lobe/random.h"
#include "tools/numerics/plane_cases.h"

static const double pi = 3.14159265358979323846;

static const struct {
    double alpha[2], theta, phi, tilt, turn, floor_share;
} cases[] = {{{0.5, 0.5}, 40, 0, 20, 90, 0.25},     {{0.1, 1}, 70, 60, 35, 60, 0.1},
             {{1, 1}, 10, 0, 35, 180, 0},           {{0.3, 0.8}, 60, 30, 25, 200, 1},
             {{0.3, 0.8}, 93, 30, 25, 40, 0.25},    {{0.6, 0.6}, 105, 0, 40, 10, 0.1},
             {{2, 0.4}, 50, 10, 60, 300, 0.25},     {{0.2, 0.2}, 80, 0, 60, 80, 0.25},
             {{0.05, 0.3}, 55, 100, 30, 140, 0.25}, {{0.4, 1.5}, 100, 250, 60, 240, 0.25}};
enum { CASES = sizeof cases / sizeof *cases };

static ggx_base base_of(int k) {
    return plane_base(plane_direction(cases[k].theta, cases[k].phi),
                      plane_direction(cases[k].tilt, cases[k].turn), cases[k].alpha[0],
                      cases[k].alpha[1], cases[k].floor_share);
}

/* What a grid over the draws of `caps` gives. */
typedef struct plane_integrals {
    double table, ellipse, value;
} plane_integrals;

static plane_integrals integrate(ggx_base g, const ggx_horizon_plane_table *t,
                                 const ggx_horizon_plane_ellipse *e) {
    enum { N = 900 };
    ggx_caps caps = ggx_caps_prepare(g);
    plane_integrals sum = {0, 0, 0};
    for (int j = 0; j < N; ++j)
        for (int k = 0; k < N; ++k) {
            double u1 = (k + 0.25 + 0.5 * (j % 2)) / N, u2 = (j + 0.5) / N;
            facet_draw d = ggx_caps_draw(caps, u1, u2, 0);
            if (d.pdf <= 0) continue;
            facet_pair pair = ggx_pair_of_wo(g, d.wo);
            sum.table += ggx_horizon_plane_table_pdf(*t, pair) / d.pdf;
            sum.ellipse += ggx_horizon_plane_ellipse_pdf(*e, pair) / d.pdf;
            sum.value += d.weight;
        }
    double cell = 1 / ((double)N * N);
    return (plane_integrals){cell * sum.table, cell * sum.ellipse, cell * sum.value};
}

enum { DRAWS = 200000 };

typedef struct plane_mean {
    double mean, error, accepted;
} plane_mean;

static facet_draw draw_of(const ggx_horizon_plane_table *t, const ggx_horizon_plane_ellipse *e,
                          uint64_t seed, uint64_t k) {
    lobe_random4 r = lobe_random(seed, 11, k);
    double u1 = lobe_random_unit_f64(r.word[0], r.word[1]);
    double u2 = (double)lobe_random_unit_f32(r.word[2]),
           u3 = (double)lobe_random_unit_f32(r.word[3]);
    return t ? ggx_horizon_plane_table_draw(*t, u1, u2, u3)
             : ggx_horizon_plane_ellipse_draw(*e, u1, u2, u3);
}

static plane_mean mean_of(const ggx_horizon_plane_table *t, const ggx_horizon_plane_ellipse *e,
                          uint64_t seed) {
    double sum = 0, squares = 0;
    int accepted = 0;
    for (uint64_t k = 0; k < DRAWS; ++k) {
        facet_draw d = draw_of(t, e, seed, k);
        sum += d.weight;
        squares += d.weight * d.weight;
        accepted += d.pdf > 0;
    }
    double mean = sum / DRAWS;
    return (plane_mean){mean, sqrt((squares / DRAWS - mean * mean) / DRAWS),
                        accepted / (double)DRAWS};
}

/* The table's density to one, the ellipse's to the share of its draws that leave; both give the mean
 * weight of quadrature. Five standard errors in thirty comparisons. */
static void integrals_and_means(void **state) {
    (void)state;
    for (int k = 0; k < CASES; ++k) {
        ggx_base g = base_of(k);
        ggx_horizon_plane_table t = ggx_horizon_plane_table_prepare(g);
        ggx_horizon_plane_ellipse e = ggx_horizon_plane_ellipse_prepare(g);
        plane_integrals exact = integrate(g, &t, &e);
        plane_mean a = mean_of(&t, NULL, (uint64_t)k), b = mean_of(NULL, &e, (uint64_t)k);
        double share_error = sqrt(b.accepted * (1 - b.accepted) / DRAWS);
        print_message("case %d: integral %.5f, accepted %.4f of %.4f, mean %.5f %.5f of %.5f\n", k,
                      exact.table, b.accepted, exact.ellipse, a.mean, b.mean, exact.value);
        assert_true(a.accepted == 1);
        assert_true(fabs(exact.table - 1) < 2e-3);
        assert_true(fabs(b.accepted - exact.ellipse) < 5 * share_error + 1e-3);
        assert_true(fabs(a.mean - exact.value) < 5 * a.error + 2e-4);
        assert_true(fabs(b.mean - exact.value) < 5 * b.error + 2e-4);
    }
}

/* --- chi^2 ---------------------------------------------------------------------------------------- */

/* Upper tail of chi^2 by Wilson and Hilferty's cube root. */
static double chi2_tail(double x, double dof) {
    double t = 2 / (9 * dof);
    return 0.5 * erfc((cbrt(x / dof) - (1 - t)) / sqrt(2 * t));
}

enum { RINGS = 16, SECTORS = 24, FINE = 40 };

static int bin_of(v3 o) {
    double turn = atan2(o.y, o.x) / (2 * pi);
    int ring = (int)(o.z * RINGS), sector = (int)((turn < 0 ? turn + 1 : turn) * SECTORS);
    return (ring < RINGS ? ring : RINGS - 1) * SECTORS + (sector < SECTORS ? sector : 0);
}

static double pdf_of(const ggx_horizon_plane_table *t, const ggx_horizon_plane_ellipse *e,
                     ggx_base g, v3 o) {
    facet_pair pair = ggx_pair_of_wo(g, o);
    if (!pair.leaves) return 0;
    return t ? ggx_horizon_plane_table_pdf(*t, pair) : ggx_horizon_plane_ellipse_pdf(*e, pair);
}

/* p of DRAWS draws of (drawn, e) against the density of (t, e) over bins of (cos theta, phi). Of the
 * ellipse the accepted draws count. */
static double chi2_p(const ggx_horizon_plane_table *drawn, const ggx_horizon_plane_table *t,
                     const ggx_horizon_plane_ellipse *e, ggx_base g, uint64_t seed) {
    double expected[RINGS * SECTORS] = {0}, found[RINGS * SECTORS] = {0};
    double cell = DRAWS * 2 * pi / ((double)RINGS * SECTORS * FINE * FINE);
    for (int j = 0; j < RINGS * FINE; ++j)
        for (int k = 0; k < SECTORS * FINE; ++k) {
            double z = (j + 0.5) / (RINGS * FINE), phi = 2 * pi * (k + 0.5) / (SECTORS * FINE);
            double r = sqrt(1 - z * z);
            double pdf = pdf_of(t, e, g, v3_of(r * cos(phi), r * sin(phi), z));
            expected[j / FINE * SECTORS + k / FINE] += pdf * cell;
        }
    for (uint64_t k = 0; k < DRAWS; ++k) {
        facet_draw d = draw_of(drawn, e, seed, k);
        if (d.pdf > 0) found[bin_of(d.wo)] += 1;
    }
    double statistic = 0, dof = -1;
    for (int k = 0; k < RINGS * SECTORS; ++k) {
        if (expected[k] < 20) continue;
        statistic += (found[k] - expected[k]) * (found[k] - expected[k]) / expected[k];
        dof += 1;
    }
    return chi2_tail(statistic, dof);
}

/* The cases that a grid of directions resolves; each alone at 0.01/14. */
static const int smooth_cases[] = {0, 2, 3, 4, 5, 6, 9};
enum { SMOOTH = sizeof smooth_cases / sizeof *smooth_cases };

static void draws_follow_their_density(void **state) {
    (void)state;
    double smallest = 1;
    for (int k = 0; k < 2 * SMOOTH; ++k) {
        ggx_base g = base_of(smooth_cases[k / 2]);
        ggx_horizon_plane_table t = ggx_horizon_plane_table_prepare(g);
        ggx_horizon_plane_ellipse e = ggx_horizon_plane_ellipse_prepare(g);
        const ggx_horizon_plane_table *table = k % 2 ? NULL : &t;
        double p = chi2_p(table, table, &e, g, (uint64_t)(300 + k));
        if (!(p > 0.01 / (2 * SMOOTH)))
            fail_msg("case %d %s: p = %.2g", smooth_cases[k / 2], k % 2 ? "ellipse" : "table", p);
        smallest = fmin(smallest, p);
    }
    print_message("%d chi^2 tests, smallest p = %.2g\n", 2 * SMOOTH, smallest);
}

/* The same test catches a density whose axes are exchanged. */
static void exchanged_axes_are_caught(void **state) {
    (void)state;
    for (int k = 0; k < SMOOTH; ++k) {
        ggx_base g = base_of(smooth_cases[k]);
        ggx_horizon_plane_table t = ggx_horizon_plane_table_prepare(g), wrong = t;
        wrong.disk.d1 = t.disk.d2;
        wrong.disk.d2 = t.disk.d1;
        assert_true(chi2_p(&t, &wrong, NULL, g, (uint64_t)(300 + 2 * k)) < 1e-9);
    }
}

/* --- what was measured ----------------------------------------------------------------------------- */

/* Relative variance of the weight in a white furnace, on a grid over u that is denser toward
 * the end of the ray. */
static double furnace_variance(ggx_base g) {
    enum { N = 100 };
    ggx_horizon_plane_table t = ggx_horizon_plane_table_prepare(g);
    double sum = 0, squares = 0;
    for (int j = 0; j < N; ++j)
        for (int k = 0; k < N; ++k) {
            double out = 1 - (j + 0.5) / N, share = 3 * out * out / ((double)N * N);
            double u2 = 1 - out * out * out;
            double w = ggx_horizon_plane_table_draw(t, (k + 0.5) / N, u2, 0).weight;
            sum += share * w;
            squares += share * w * w;
        }
    return squares / (sum * sum) - 1;
}

static void variance_of_the_furnace(void **state) {
    (void)state;
    static const double rows[][2] = {{1, 0.0638}, {0.25, 0.0148}, {0.1, 0.0077}, {0, 0.0049}};
    for (int k = 0; k < 4; ++k) {
        double sum = 0;
        for (int c = 0; c < PLANE_CASES; ++c) sum += furnace_variance(plane_case(c, rows[k][0]));
        double variance = sum / PLANE_CASES;
        print_message("floor %g: variance %.5f\n", rows[k][0], variance);
        assert_true(fabs(variance - rows[k][1]) < 0.0004);
    }
}

static void share_of_the_smaller_ellipse(void **state) {
    (void)state;
    double sum = 0, least = 1;
    for (int c = 0; c < PLANE_CASES; ++c) {
        ggx_base g = plane_case(c, 1);
        ggx_horizon_plane_ellipse e = ggx_horizon_plane_ellipse_prepare(g);
        int accepted = 0, draws = 20000;
        for (int k = 0; k < draws; ++k)
            accepted += draw_of(NULL, &e, (uint64_t)c, (uint64_t)k).pdf > 0;
        sum += accepted / (double)draws;
        least = fmin(least, accepted / (double)draws);
    }
    print_message("accepted: mean %.4f, least %.4f\n", sum / PLANE_CASES, least);
    assert_true(fabs(sum / PLANE_CASES - 0.9334) < 0.001 && fabs(least - 0.80) < 0.02);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integrals_and_means), cmocka_unit_test(draws_follow_their_density),
        cmocka_unit_test(exchanged_axes_are_caught), cmocka_unit_test(variance_of_the_furnace),
        cmocka_unit_test(share_of_the_smaller_ellipse)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
