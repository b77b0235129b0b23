/* What the horizon samplers' densities integrate to, whether draws follow them, and the variance that is
 * left. */
#include "kernel/bind/c_f64.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "horizon_methods.h"
#include "kernel/ggx_caps.h"
#include "lobe/random.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static v3 at_degrees(double theta, double phi) {
    double s = sin(theta * pi / 180);
    return v3_of(s * cos(phi * pi / 180), s * sin(phi * pi / 180), cos(theta * pi / 180));
}

static const double alphas[][2] = {{0.2, 0.8}, {0.1, 1}, {0.5, 1}, {0.05, 0.3},
                                   {0.3, 0.3}, {1, 1},   {3, 2},   {1.5, 0.1}};
static const double thetas[] = {5, 40, 80, 93, 120};
enum { ALPHAS = sizeof alphas / sizeof *alphas, THETAS = sizeof thetas / sizeof *thetas };

/* The integral of a density over the hemisphere. The grid is the one of `caps`, which knows nothing of
 * ellipses: wo(u1, u2) of the visible normals and its density; half a cell off in u1 at every second row. */
static double integral(const horizon_any *s, ggx_base g) {
    enum { N = 700 };
    ggx_caps caps = ggx_caps_prepare(g);
    double sum = 0;
    for (int j = 0; j < N; ++j)
        for (int k = 0; k < N; ++k) {
            double u1 = (k + 0.25 + 0.5 * (j % 2)) / N, u2 = (j + 0.5) / N;
            facet_draw d = ggx_caps_draw(caps, u1, u2, 0);
            if (d.pdf > 0) sum += any_pdf(s, ggx_pair_of_wo(g, d.wo)) / d.pdf;
        }
    return sum / ((double)N * N);
}

static void densities_integrate_to_one(void **state) {
    (void)state;
    double worst = 0;
    for (int k = 0; k < ALPHAS * THETAS; ++k) {
        const double *alpha = alphas[k % ALPHAS];
        v3 wi = at_degrees(thetas[k / ALPHAS], 30 + 100 * k);
        ggx_base g = base_with_floor(wi, alpha[0], alpha[1], k % 3 * 0.25);
        horizon_any s = any_prepare((horizon_method)(k % METHOD_COUNT), g);
        double error = fabs(integral(&s, g) - 1);
        if (!(error < 2e-3))
            fail_msg("%s alpha %g %g theta %g: integral off by %.2g", method_name[s.method],
                     alpha[0], alpha[1], thetas[k / ALPHAS], error);
        worst = fmax(worst, error);
    }
    print_message("%d integrals within %.2g of 1\n", ALPHAS * THETAS, worst);
}

/* Upper tail of chi^2 by Wilson and Hilferty's cube root. */
static double chi2_tail(double x, double dof) {
    double t = 2 / (9 * dof);
    return 0.5 * erfc((cbrt(x / dof) - (1 - t)) / sqrt(2 * t));
}

enum { RINGS = 16, SECTORS = 24, FINE = 24, DRAWS = 200000 };

static int bin_of(v3 o) {
    double turn = atan2(o.y, o.x) / (2 * pi);
    int ring = (int)(o.z * RINGS), sector = (int)((turn < 0 ? turn + 1 : turn) * SECTORS);
    return (ring < RINGS ? ring : RINGS - 1) * SECTORS + (sector < SECTORS ? sector : 0);
}

/* The mass of each bin of (cos theta, phi) by midpoints. */
static void expected_of(const horizon_any *s, ggx_base g, double *expected) {
    double cell = 2 * pi / ((double)RINGS * SECTORS * FINE * FINE);
    for (int j = 0; j < RINGS * FINE; ++j)
        for (int k = 0; k < SECTORS * FINE; ++k) {
            double z = (j + 0.5) / (RINGS * FINE), phi = 2 * pi * (k + 0.5) / (SECTORS * FINE);
            double r = sqrt(1 - z * z);
            v3 o = v3_of(r * cos(phi), r * sin(phi), z);
            expected[j / FINE * SECTORS + k / FINE] += any_pdf(s, ggx_pair_of_wo(g, o)) * cell;
        }
}

static double chi2_p(const horizon_any *s, ggx_base g, uint64_t seed) {
    double expected[RINGS * SECTORS] = {0}, found[RINGS * SECTORS] = {0};
    expected_of(s, g, expected);
    for (uint64_t k = 0; k < DRAWS; ++k) {
        lobe_random4 r = lobe_random(seed, 7, k);
        facet_draw d = any_draw(s, lobe_random_unit_f32(r.word[0]), lobe_random_unit_f32(r.word[1]),
                                lobe_random_unit_f32(r.word[2]));
        found[bin_of(d.wo)] += 1;
    }
    double statistic = 0, dof = -1, thin_expected = 0, thin_found = 0;
    for (int k = 0; k < RINGS * SECTORS; ++k) {
        double e = expected[k] * DRAWS;
        if (e < 10) {
            thin_expected += e;
            thin_found += found[k];
        } else {
            statistic += (found[k] - e) * (found[k] - e) / e;
            dof += 1;
        }
    }
    if (thin_expected > 10) {
        statistic += (thin_found - thin_expected) * (thin_found - thin_expected) / thin_expected;
        dof += 1;
    }
    return chi2_tail(statistic, dof);
}

/* Each alone at 0.01/20: one in a hundred runs with other seeds would fail. */
static void draws_follow_their_density(void **state) {
    (void)state;
    static const struct {
        double alpha[2], theta;
    } cases[] = {
        {{0.3, 0.9}, 35}, {{0.5, 0.5}, 65}, {{0.4, 0.4}, 0}, {{1, 0.4}, 80}, {{0.6, 1.2}, 97}};
    double smallest = 1;
    for (int k = 0; k < 5 * METHOD_COUNT; ++k) {
        int c = k % 5;
        ggx_base g = base_with_floor(at_degrees(cases[c].theta, 25 + 70 * c), cases[c].alpha[0],
                                     cases[c].alpha[1], 0.1);
        horizon_any s = any_prepare((horizon_method)(k / 5), g);
        double p = chi2_p(&s, g, (uint64_t)(100 + k));
        if (!(p > 0.01 / 20))
            fail_msg("%s alpha %g %g theta %g: p = %.2g", method_name[s.method], cases[c].alpha[0],
                     cases[c].alpha[1], cases[c].theta, p);
        smallest = fmin(smallest, p);
    }
    print_message("%d chi^2 tests, smallest p = %.2g\n", 5 * METHOD_COUNT, smallest);
}

/* Relative variance of the weight in a white furnace, by a grid over u that is denser toward the horizon,
 * u2 = 1 - (1 - t)^3: there the weight falls off. */
static double furnace_variance(const horizon_any *s) {
    enum { N = 100 };
    double sum = 0, squares = 0;
    for (int j = 0; j < N; ++j)
        for (int k = 0; k < N; ++k) {
            /* the third number, where it is used: a lattice point of its own */
            double u3 = fmod(0.5 + 0.61803398874989485 * (j * N + k), 1), out = 1 - (j + 0.5) / N;
            double w = any_draw(s, (k + 0.25 + 0.5 * (j % 2)) / N, 1 - out * out * out, u3).weight;
            double share = 3 * out * out / ((double)N * N);
            sum += share * w;
            squares += share * w * w;
        }
    return squares / (sum * sum) - 1;
}

static double mean_variance(horizon_method method, double floor_share) {
    static const double pairs[][2] = {{0.2, 0.8}, {0.1, 1},   {0.5, 1}, {0.05, 0.3},
                                      {0.3, 0.3}, {0.7, 0.7}, {1, 1}};
    double sum = 0;
    int count = 0;
    for (int k = 0; k < 63; ++k) {
        const double *alpha = pairs[k / 9];
        if (alpha[0] == alpha[1] && k % 3 != 0) continue; /* its azimuth changes nothing */
        static const double angles[] = {5, 40, 87};
        v3 wi = at_degrees(angles[k / 3 % 3], 45 * (k % 3));
        horizon_any s = any_prepare(method, base_with_floor(wi, alpha[0], alpha[1], floor_share));
        sum += furnace_variance(&s);
        ++count;
    }
    assert_int_equal(count, 45);
    return sum / count;
}

/* The 45 cases of the method's description. */
static void variance_of_the_furnace(void **state) {
    (void)state;
    static const struct {
        horizon_method method;
        double floor_share, variance, tolerance;
    } rows[] = {{MIRROR, 1, 0.0725, 0.0003},      {EXACT, 1, 0.0725, 0.0003},
                {UNIFORM, 1, 0.073, 0.0003},      {SHADOWED, 1, 0.073, 0.0003},
                {SHADOWED, 0.25, 0.0138, 0.0001}, {SHADOWED, 0.1, 0.0047, 0.0001},
                {SHADOWED, 0, 0.0016, 0.0001}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        double v = mean_variance(rows[k].method, rows[k].floor_share);
        print_message("furnace, 45 cases: %s, floor %g: %.5f\n", method_name[rows[k].method],
                      rows[k].floor_share, v);
        assert_true(fabs(v - rows[k].variance) < rows[k].tolerance);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(densities_integrate_to_one),
                                       cmocka_unit_test(draws_follow_their_density),
                                       cmocka_unit_test(variance_of_the_furnace)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
