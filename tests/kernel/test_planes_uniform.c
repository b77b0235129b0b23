/* Uniform draws in the smaller ellipse of two planes: what the density integrates to, whether draws follow it,
 * their mean, their own density, extreme inputs. The oracle is `caps`, which knows nothing of ellipses. */
#include "kernel/bind/c_f64.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/ggx_caps.h"
#include "lobe/random.h"
#include "tools/numerics/plane_cases.h"

static const struct {
    double alpha[2], theta, phi, tilt, turn;
} cases[] = {{{0.5, 0.5}, 40, 0, 20, 90},  {{0.3, 0.8}, 70, 60, 35, 60},
             {{1, 1}, 10, 0, 35, 180},     {{0.3, 0.8}, 60, 30, 25, 0},
             {{0.3, 0.8}, 93, 30, 25, 40}, {{0.6, 0.6}, 105, 0, 40, 10},
             {{2, 0.4}, 50, 10, 50, 300},  {{0.4, 1.5}, 100, 250, 60, 240}};
enum { CASES = sizeof cases / sizeof *cases, DRAWS = 200000 };

static ggx_base base_of(int k) {
    return plane_base(plane_direction(cases[k].theta, cases[k].phi),
                      plane_direction(cases[k].tilt, cases[k].turn), cases[k].alpha[0],
                      cases[k].alpha[1], 1);
}

static facet_draw draw_of(const ggx_horizon_plane_uniform *s, int c, uint64_t k) {
    lobe_random4 r = lobe_random((uint64_t)c, 13, k);
    return ggx_horizon_plane_uniform_draw(*s, lobe_random_unit_f64(r.word[0], r.word[1]),
                                          (double)lobe_random_unit_f32(r.word[2]), 0);
}

static int bin_of(v3 o) {
    enum { RINGS = 12, SECTORS = 16 };
    int ring = (int)(o.z * RINGS), sector = (int)((atan2(o.y, o.x) * 0.15915494 + 0.5) * SECTORS);
    return (ring < RINGS ? ring : RINGS - 1) * SECTORS + (sector < SECTORS ? sector : 0);
}
enum { BINS = 12 * 16 };

/* Over a grid of the draws of caps: by bins the density, and all of the value. */
static double integrate(const ggx_horizon_plane_uniform *s, ggx_base g, double *mass) {
    enum { N = 1200 };
    ggx_caps caps = ggx_caps_prepare(g);
    double value = 0;
    for (int j = 0; j < N; ++j)
        for (int k = 0; k < N; ++k) {
            double u1 = (k + 0.25 + 0.5 * (j % 2)) / N, u2 = (j + 0.5) / N;
            facet_draw d = ggx_caps_draw(caps, u1, u2, 0);
            if (d.pdf <= 0) continue;
            facet_pair pair = ggx_pair_of_wo(g, d.wo);
            mass[bin_of(d.wo)] += ggx_horizon_plane_uniform_pdf(*s, pair) / d.pdf / ((double)N * N);
            value += d.weight / ((double)N * N);
        }
    return value;
}

/* Five standard errors of every mean; chi^2 over the bins within six of its expectation. */
static void draws_follow_their_density(void **state) {
    (void)state;
    for (int c = 0; c < CASES; ++c) {
        ggx_base g = base_of(c);
        ggx_horizon_plane_uniform s = ggx_horizon_plane_uniform_prepare(g);
        double mass[BINS] = {0}, found[BINS] = {0}, sum = 0, squares = 0, share = 0;
        double value = integrate(&s, g, mass);
        int accepted = 0;
        for (uint64_t k = 0; k < DRAWS; ++k) {
            facet_draw d = draw_of(&s, c, k);
            sum += d.weight;
            squares += d.weight * d.weight;
            if (!(d.pdf > 0)) continue;
            assert_true(facet_leaves(d.wo, g.plane));
            found[bin_of(d.wo)] += 1;
            ++accepted;
        }
        double chi2 = 0, dof = 0;
        for (int b = 0; b < BINS; ++b) {
            share += mass[b];
            if (mass[b] * DRAWS < 20) continue;
            double off = found[b] - mass[b] * DRAWS;
            chi2 += off * off / (mass[b] * DRAWS);
            dof += 1;
        }
        double drawn = accepted / (double)DRAWS, mean = sum / DRAWS;
        double share_error = sqrt(drawn * (1 - drawn) / DRAWS);
        double mean_error = sqrt((squares / DRAWS - mean * mean) / DRAWS);
        print_message("case %d: accepted %.4f of %.4f, mean %.5f of %.5f, chi^2 %.0f of %.0f\n", c,
                      drawn, share, mean, value, chi2, dof);
        assert_true(fabs(drawn - share) < 5 * share_error + 5e-4);
        assert_true(fabs(mean - value) < 5 * mean_error + 3e-4);
        assert_true(fabs(chi2 - dof) < 6 * sqrt(2 * dof));
    }
}

/* A draw's own pair gives its density back; its weight is f cos/pdf. */
static void densities_agree(void **state) {
    (void)state;
    double worst_pdf = 0, worst_weight = 0;
    for (int c = 0; c < CASES; ++c) {
        ggx_base g = base_of(c);
        ggx_horizon_plane_uniform s = ggx_horizon_plane_uniform_prepare(g);
        for (uint64_t k = 0; k < 20000; ++k) {
            facet_draw d = draw_of(&s, c, k);
            if (!(d.pdf > 0)) continue;
            facet_pair pair = ggx_pair_of_wo(g, d.wo);
            worst_pdf = fmax(worst_pdf, fabs(ggx_horizon_plane_uniform_pdf(s, pair) / d.pdf - 1));
            worst_weight = fmax(worst_weight, fabs(ggx_f_cos(g, pair) / d.pdf / d.weight - 1));
        }
    }
    print_message("density within %.2g, weight within %.2g\n", worst_pdf, worst_weight);
    assert_true(worst_pdf < 1e-8);
    assert_true(worst_weight < 1e-8);
}

static void extremes_stay_finite(void **state) {
    (void)state;
    static const double alphas[] = {0, 1e-4, 1e-2, 1, 100, 1e4};
    static const double us[] = {0, 1e-7, 0.25, 0.5, 0.9999999, 1 - 1e-16};
    for (int k = 0; k < 6 * 6 * 7 * 6; ++k) {
        v3 wi = plane_direction(30 * (k / 36 % 7) - (k % 5 ? 1e-4 : 0), 40 * k);
        ggx_base g = plane_base(wi, plane_direction(18 * (k / 252 % 6), 15 * k), alphas[k % 6],
                                alphas[k / 6 % 6], 0.1);
        ggx_horizon_plane_uniform s = ggx_horizon_plane_uniform_prepare(g);
        for (int j = 0; j < 36; ++j) {
            facet_draw d = ggx_horizon_plane_uniform_draw(s, us[j % 6], us[j / 6], 0.5);
            assert_true(d.pdf >= 0 && k_is_finite(d.pdf) && d.weight >= 0 && k_is_finite(d.weight));
            assert_true(d.pdf_m >= 0 && k_is_finite(d.pdf_m));
            assert_true(d.pdf == 0 || (k_is(g.valid) && facet_leaves(d.wo, g.plane)));
        }
    }
}

/* The 110 cases of the method's description. */
static void share_and_variance(void **state) {
    (void)state;
    double share = 0, least = 1, variance = 0;
    for (int c = 0; c < PLANE_CASES; ++c) {
        ggx_horizon_plane_uniform s = ggx_horizon_plane_uniform_prepare(plane_case(c, 1));
        double sum = 0, squares = 0, accepted = 0;
        enum { N = 128 };
        for (int k = 0; k < N * N; ++k) {
            facet_draw d =
                ggx_horizon_plane_uniform_draw(s, (k % N + 0.5) / N, (k / N + 0.5) / N, 0);
            sum += d.weight / (N * N);
            squares += d.weight * d.weight / (N * N);
            accepted += (d.pdf > 0) / (double)(N * N);
        }
        share += accepted / PLANE_CASES;
        variance += (squares / (sum * sum) - 1) / PLANE_CASES;
        least = fmin(least, accepted);
    }
    print_message("accepted %.4f, least %.3f; variance %.4f\n", share, least, variance);
    assert_true(fabs(share - 0.933) < 0.002 && fabs(least - 0.80) < 0.02);
    assert_true(fabs(variance - 0.1435) < 0.002);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_follow_their_density), cmocka_unit_test(densities_agree),
        cmocka_unit_test(extremes_stay_finite), cmocka_unit_test(share_and_variance)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
