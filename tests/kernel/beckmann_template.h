/* tests/kernel/beckmann_template.h: Smith-Beckmann against quadrature, exact distributions and its own
 * limits. Before including: a binding and TOLERANCE (relative, of closed forms). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/beckmann_horizon.h"
#include "kernel/beckmann_ndf.h"
#include "kernel/beckmann_newton.h"
#include "kernel/beckmann_newton_published.h"
#include "kernel/beckmann_slope.h"
#include "beckmann_exact.h"

static const double pi = 3.14159265358979323846;

static v3 direction(double theta, double phi) {
    return v3_of((real)(sin(theta) * cos(phi)), (real)(sin(theta) * sin(phi)), (real)cos(theta));
}

static beckmann_base base_at(double theta, double phi, double ax, double ay) {
    return beckmann_base_of(direction(theta, phi), (real)ax, (real)ay,
                            facet_options_of(false, false));
}

/* The depth where exp(-t (t + 2s)) is exp(-36). */
static double bottom_of(double s) {
    return 36 / (s + sqrt(s * s + 36));
}

/* V(i)/2 exp(shift) = int (c - x)+ b exp(shift - x^2)/sqrt(pi) dx by Simpson's rule in the depth. */
static double visible_by_quadrature(beckmann_base g) {
    const int cells = 4000;
    double c = g.c, s = fmax(-c, 0), top = fmax(-c, -8), bottom = bottom_of(s);
    double low = c < 0 ? 0 : top, sum = 0;
    for (int k = 0; k <= cells; ++k) {
        double t = low + (bottom - low) * k / cells;
        double f = (fmax(c, 0) + t) * exp(-t * (t + 2 * s));
        sum += (k == 0 || k == cells ? 1 : k % 2 == 1 ? 4 : 2) * f;
    }
    return 2 * (double)g.b * sum * (bottom - low) / (3 * cells) / (double)root_pi;
}

static void normaliser(void **state) {
    (void)state;
    for (int k = 0; k < 4000; ++k) {
        double theta = (0.3 + 179.4 * k / 4000) * pi / 180;
        double ax = 0.03 * pow(60, uniform((uint64_t)k, 0));
        beckmann_base g = base_at(theta, 1.0, ax, k % 2 == 0 ? ax : 0.4);
        if (!(g.c > R(-200.0))) continue;
        double exact = visible_by_quadrature(g);
        if (!(fabs((double)g.visible / exact - 1) < TOLERANCE + 1e-8))
            fail_msg("theta %g, c = %g: %.9g, by quadrature %.9g", theta, (double)g.c,
                     (double)g.visible, exact);
    }
}

/* D, Lambda and both G1 from their definitions in long double. */
static void closed_forms(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 20000; ++k) {
        double ax = 0.01 * pow(200, uniform(k, 0)), ay = 0.01 * pow(200, uniform(k, 1));
        v3 v = direction(acos(fmax(uniform(k, 2), 1e-4)), 7 * uniform(k, 3));
        long double a = (real)ax, b = (real)ay, x = v.x, y = v.y, z = v.z;
        long double tan2 = ((x / a) * (x / a) + (y / b) * (y / b)) / (z * z);
        long double r2 = x * x + y * y + z * z;
        long double d = expl(-tan2) * r2 * r2 / (3.14159265358979323846L * a * b * z * z * z * z);
        real got = beckmann_d(v, (real)ax, (real)ay);
        assert_true(fabsl(got - d) <= TOLERANCE * (2 + tan2) * d + 1e-37L);
        long double c = z / sqrtl(a * a * x * x + b * b * y * y);
        long double lambda = expl(-c * c) * defect(c) / (2 * root_pi * c);
        long double tolerance = TOLERANCE * (2 + c * c);
        real l = beckmann_lambda(v, (real)ax, (real)ay);
        assert_true(fabsl(l - lambda) <= tolerance * lambda + 1e-37L);
        real g1 = beckmann_g1_out(v, (real)ax, (real)ay);
        assert_true(fabsl(g1 - 1 / (1 + lambda)) <= tolerance);
        beckmann_base g = beckmann_base_of(v, (real)ax, (real)ay, facet_options_of(false, false));
        assert_true(fabsl(beckmann_g1_in(g) - 1 / (1 + lambda)) <= tolerance);
    }
}

/* G2/G1 without a cosine against 1/(1 + Lambda_i + Lambda_o) and against G1 G1. */
static void shadowing(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 20000; ++k) {
        real ax = (real)(0.05 * pow(30, uniform(k, 0)));
        v3 i = direction(1.55 * uniform(k, 1), 7 * uniform(k, 2));
        v3 o = direction(1.55 * uniform(k, 3), 3 * uniform(k, 2));
        beckmann_base g = beckmann_base_of(i, ax, R(0.3), facet_options_of(k % 2 == 0, false));
        double li = (double)beckmann_lambda(i, ax, R(0.3)),
               lo = (double)beckmann_lambda(o, ax, R(0.3));
        double exact = k % 2 == 0 ? 1 / (1 + lo) : (1 + li) / (1 + li + lo);
        assert_true(fabs((double)beckmann_shadowing(g, o) - exact) < 10 * TOLERANCE);
    }
}

/* A sampler as the tests see it. */
typedef struct sampler {
    const char *name;
    facet_draw (*draw)(beckmann_base g, real u1, real u2);
    real (*pdf)(beckmann_base g, facet_pair pair);
    real (*pdf_m)(beckmann_base g, facet_pair pair);
} sampler;

#define SAMPLER(name)                                                                              \
    static facet_draw name##_test_draw(beckmann_base g, real u1, real u2) {                        \
        return beckmann_##name##_draw(beckmann_##name##_prepare(g), u1, u2, R(0.0));               \
    }                                                                                              \
    static real name##_test_pdf(beckmann_base g, facet_pair pair) {                                \
        return beckmann_##name##_pdf(beckmann_##name##_prepare(g), pair);                          \
    }                                                                                              \
    static real name##_test_pdf_m(beckmann_base g, facet_pair pair) {                              \
        return beckmann_##name##_pdf_m(beckmann_##name##_prepare(g), pair);                        \
    }                                                                                              \
    static const sampler name = {#name, name##_test_draw, name##_test_pdf, name##_test_pdf_m};

SAMPLER(ndf)
SAMPLER(slope)
SAMPLER(newton)
SAMPLER(newton_published)
SAMPLER(horizon)

static const sampler *const samplers[] = {&ndf, &slope, &newton, &newton_published, &horizon};
enum { SAMPLERS = sizeof samplers / sizeof *samplers };

/* The normal with the slope at depth t along i and y across. */
static v3 normal_at(beckmann_base g, double t, double y) {
    facet_azimuth a = facet_azimuth_of(g.i_std);
    real x = (real)-t - k_max(-g.c, R(0.0));
    return beckmann_normal_of_slopes(g, x * a.x - (real)y * a.y, x * a.y + (real)y * a.x);
}

/* int pdf_m over all visible normals, or over all for `ndf`, by the midpoint rule in slopes. */
static double integral_of_density(const sampler *s, beckmann_base g) {
    const int cells = 250;
    double depth = fmax(-(double)g.c, 0), bottom = bottom_of(depth), sum = 0;
    double top = s == &ndf ? -6 - depth : -fmin(fmax((double)g.c, 0), 6);
    if (s == &ndf) bottom = 6;
    for (int j = 0; j < cells; ++j)
        for (int k = 0; k < cells; ++k) {
            double t = top + (bottom - top) * (j + 0.5) / cells, y = -5 + 10 * (k + 0.5) / cells;
            v3 m = normal_at(g, t, y);
            sum += (double)s->pdf_m(g, beckmann_pair_of_m(g, m)) * pow((double)m.z, 3);
        }
    return sum * (double)(g.ax * g.ay) * (bottom - top) * 10 / ((double)cells * cells);
}

/* The same over the disk of useful slopes, in its own coordinates: no cell straddles the rim. */
static double integral_over_disk(beckmann_base g) {
    const int cells = 250;
    beckmann_horizon s = beckmann_horizon_prepare(g);
    double low = fmax(-(double)s.slopes.t_most, -6), high = -(double)s.slopes.t_least, sum = 0;
    for (int j = 0; j < cells; ++j) {
        double phi = pi * ((j + 0.5) / cells - 0.5);
        double x = 0.5 * (low + high + (high - low) * sin(phi));
        beckmann_chord chord = beckmann_horizon_chord(s, (real)x);
        double left = fmax((double)(chord.centre - chord.w), -5);
        double right = fmin((double)(chord.centre + chord.w), 5);
        for (int k = 0; k < cells && right > left; ++k) {
            v3 m = normal_at(g, -x, left + (right - left) * (k + 0.5) / cells);
            facet_pair pair = beckmann_pair_of_m(g, m);
            sum += 4 * (double)(pair.cos_im * beckmann_horizon_pdf(s, pair)) * pow((double)m.z, 3) *
                   (right - left) * cos(phi);
        }
    }
    return sum * (double)(g.ax * g.ay) * 0.5 * (high - low) * pi / ((double)cells * cells);
}

static void densities_integrate_to_one(void **state) {
    (void)state;
    const double theta[] = {0, 0.02, 0.6, 1.2, 1.55, 1.7, 2.2, 2.8};
    for (int k = 0; k < SAMPLERS * 8; ++k) {
        double angle = theta[k / SAMPLERS];
        beckmann_base g = base_at(angle, 0.7, 0.5, k / SAMPLERS % 2 == 0 ? 0.5 : 0.2);
        const sampler *s = samplers[k % SAMPLERS];
        bool on_disk = s == &horizon && angle < 1.57;
        double sum = on_disk ? integral_over_disk(g) : integral_of_density(s, g);
        if (!(fabs(sum - 1) < 1e-3)) fail_msg("%s at theta %g: %.7g", s->name, angle, sum);
    }
}

/* chi^2 over its degrees of freedom of draws of normals, in cells that visible normals would fill evenly:
 * by the share of slopes deeper than the one along i, and of those below the one across. */
enum { ALONG = 40, ACROSS = 25, DRAWS = 50000 };

typedef struct cells {
    double of[ALONG][ACROSS];
} cells;

/* How much of the draws each cell should hold: all the same but for `horizon`, whose density is taken at
 * 15 by 15 points of each. */
static cells expected_cells(const sampler *s, beckmann_base g) {
    enum { POINTS = 15 };
    cells e;
    beckmann_slopes all = beckmann_slopes_of(g.c);
    beckmann_horizon h = beckmann_horizon_prepare(g);
    for (int j = 0; j < ALONG; ++j)
        for (int k = 0; k < ACROSS; ++k) {
            double sum = 0;
            for (int n = 0; s == &horizon && n < POINTS * POINTS; ++n) {
                real u = (real)((j + (n / POINTS + 0.5) / POINTS) / ALONG);
                real w = (real)((k + (n % POINTS + 0.5) / POINTS) / ACROSS);
                real t = beckmann_slopes_inverse(all, u);
                v3 m = normal_at(g, (double)t, (double)beckmann_gaussian(w));
                facet_pair pair = beckmann_pair_of_m(g, m);
                sum += (double)(beckmann_horizon_pdf_m(h, pair) / beckmann_visible_pdf_m(g, pair));
            }
            e.of[j][k] = (s == &horizon ? sum / (POINTS * POINTS) : 1) / (ALONG * ACROSS);
        }
    return e;
}

static double chi2_per_degree(const sampler *s, beckmann_base g, uint32_t stream) {
    static int count[ALONG][ACROSS];
    memset(count, 0, sizeof count);
    facet_azimuth a = facet_azimuth_of(g.i_std);
    for (uint64_t k = 0; k < DRAWS; ++k) {
        lobe_random4 r = lobe_random(77, stream, k);
        v3 m = s->draw(g, lobe_random_unit_f32(r.word[0]), lobe_random_unit_f32(r.word[1])).m;
        double x = -(double)(m.x / (g.ax * m.z)), y = -(double)(m.y / (g.ay * m.z));
        double along = x * (double)a.x + y * (double)a.y,
               across = y * (double)a.x - x * (double)a.y;
        double u = (double)exact_shares(g.c, -along - fmax(-(double)g.c, 0)).deep;
        double w = 0.5 * erfc(-across);
        count[(int)fmin(fmax(u, 0) * ALONG, ALONG - 1)][(int)fmin(w * ACROSS, ACROSS - 1)]++;
    }
    cells e = expected_cells(s, g);
    double sum = 0;
    int degrees = -1;
    for (int j = 0; j < ALONG; ++j)
        for (int k = 0; k < ACROSS; ++k) {
            double expected = DRAWS * e.of[j][k];
            if (expected < 5) continue;
            sum += (count[j][k] - expected) * (count[j][k] - expected) / expected;
            ++degrees;
        }
    return sum / degrees;
}

/* chi^2 per degree has the standard deviation sqrt(2/999) = 0.045: 1.25 is 5.6 of them, p = 1e-8. */
static void draws_follow_the_density(void **state) {
    (void)state;
    const double theta[] = {0, 0.3, 1.2, 1.5708, 1.658, 2.3};
    for (int k = 0; k < 6; ++k) {
        beckmann_base g = base_at(theta[k], 0.7, 0.5, k % 2 == 0 ? 0.5 : 0.2);
        for (int n = 1; n < SAMPLERS; ++n) {
            double ratio = chi2_per_degree(samplers[n], g, (uint32_t)(8 * k + n));
            if (!(ratio < 1.25)) fail_msg("%s at theta %g: %g", samplers[n]->name, theta[k], ratio);
        }
    }
}

/* Slopes between 3c and c at theta = 95 degrees, alpha = 0.5: as a V-cavity is seen from below. chi^2 of 100
 * even cells: three Newton steps fail, the bracketed inverse does not (p = 1e-8 at 1.8). */
static double chi2_between_limits(bool published) {
    int count[100] = {0};
    real c = (real)(2 / tan(95 * pi / 180));
    beckmann_slopes r = beckmann_slopes_between(beckmann_slopes_of(c), R(0.0), R(-2.0) * c);
    shares end = exact_shares(c, -2 * (long double)c);
    for (uint64_t k = 0; k < 8 * DRAWS; ++k) {
        real u = lobe_random_unit_f32(lobe_random(78, 0, k).word[0]);
        real t = published ? c - beckmann_published_slope(c, R(3.0) * c, u)
                           : beckmann_slopes_inverse(r, u);
        double share = (double)((exact_shares(c, t).deep - end.deep) / end.shallow);
        count[(int)fmin(fmax(share * 100, 0), 99)]++;
    }
    double sum = 0;
    for (int k = 0; k < 100; ++k) sum += pow(count[k] - 0.08 * DRAWS, 2) / (0.08 * DRAWS);
    return sum / 99;
}

static void three_newton_steps_fail_between_limits(void **state) {
    (void)state;
    assert_true(chi2_between_limits(false) < 1.8);
    assert_true(chi2_between_limits(true) > 2.0);
}

/* Below the horizon to c = -12: the density at the normal that was drawn, from the logarithms of D and V in
 * long double. Rounding m costs c^2 of its last digits, whatever the formula. */
static void density_far_below(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 20000; ++k) {
        double theta = pi / 2 + 0.9 * uniform(k, 0);
        real alpha = (real)(tan(theta - pi / 2) / (0.2 + 11.8 * uniform(k, 1)) / 1);
        beckmann_base g = beckmann_base_of(direction(theta, 7 * uniform(k, 2)), alpha, alpha,
                                           facet_options_of(false, false));
        facet_draw d = newton.draw(g, (real)uniform(k, 2), (real)uniform(k, 3));
        if (!g.valid || alpha < R(1e-3)) continue;
        assert_true(d.pdf > R(0.0));
        long double a = g.ax, x = d.m.x, y = d.m.y, z = d.m.z, iz = g.wi.z;
        long double b = a * sqrtl((long double)g.wi.x * g.wi.x + (long double)g.wi.y * g.wi.y);
        long double r2 = (x * x + y * y) / (z * z), c = iz / b;
        long double log_pdf = -r2 / (a * a) + c * c + 2 * logl(1 + r2) -
                              logl(3.14159265358979323846L * a * a) -
                              logl(2 * b * defect(-c) / root_pi);
        double error = (double)fabsl(logl(d.pdf) - log_pdf);
        if (!(error < TOLERANCE * (3 + (double)(c * c))))
            fail_msg("theta %g alpha %g c %g: %g", theta, (double)alpha, (double)c, error);
    }
}

/* At normal incidence the map does not depend on the azimuth of i, and leaves it continuously. */
static void normal_incidence_has_no_seam(void **state) {
    (void)state;
    beckmann_base at = base_at(0, 0, 0.6, 0.3);
    for (uint64_t k = 0; k < 20000; ++k) {
        double theta = k % 2 == 0 ? 1e-6 : 1e-3;
        beckmann_base near = base_at(theta, 7 * uniform(k, 2), 0.6, 0.3);
        real u1 = (real)uniform(k, 0), u2 = (real)uniform(k, 1);
        v3 d = v3_sub(newton.draw(at, u1, u2).m, newton.draw(near, u1, u2).m);
        if (!(sqrt((double)v3_dot(d, d)) < 2 * theta + 60 * (double)K_EPS))
            fail_msg("theta %g, u %g %g: %g apart", theta, (double)u1, (double)u2,
                     sqrt((double)v3_dot(d, d)));
    }
}

/* Relative furnace variance over 24 cases, and the same mean from both within 5 of its standard errors. */
static void horizon_has_a_quarter_of_the_variance(void **state) {
    (void)state;
    const double alpha[6][2] = {{0.5, 0.5}, {1, 1}, {0.2, 0.8}, {0.1, 1}, {0.3, 0.3}, {0.5, 1}};
    const double theta[] = {0.09, 0.35, 0.7, 1.05};
    const int draws = 10000;
    double total[2] = {0, 0};
    for (int n = 0; n < 24; ++n) {
        beckmann_base g = base_at(theta[n % 4], 0.8, alpha[n / 4][0], alpha[n / 4][1]);
        double mean[2] = {0, 0}, square[2] = {0, 0};
        for (int k = 0; k < draws; ++k)
            for (int j = 0; j < 2; ++j) {
                uint64_t index = (uint64_t)(n * draws + k);
                double weight = (double)(j == 0 ? newton : horizon)
                                    .draw(g, (real)uniform(index, 0), (real)uniform(index, 1))
                                    .weight;
                mean[j] += weight / draws;
                square[j] += weight * weight / draws;
            }
        double spread = 0;
        for (int j = 0; j < 2; ++j) {
            total[j] += square[j] / (mean[j] * mean[j]) - 1;
            spread += (square[j] - mean[j] * mean[j]) / draws;
        }
        assert_true(fabs(mean[0] - mean[1]) < 5 * sqrt(spread));
    }
    if (!(total[1] < 0.33 * total[0]))
        fail_msg("variance %g, of all visible normals %g", total[1] / 24, total[0] / 24);
}

static bool usable(real x) {
    return x >= R(0.0) && k_is_finite(x);
}

/* Whatever goes in, no NaN, infinity or negative number comes out. */
static void special_numbers(void **state) {
    (void)state;
    const real odd[] = {R(0.0),   -R(0.0),     R(1e-38),       R(1e-7),        R(0.3),
                        R(1.0),   K_BELOW_ONE, R(-1.0),        R(50.0),        R(1e30),
                        R(-1e30), (real)NAN,   (real)INFINITY, -(real)INFINITY};
    const int n = sizeof odd / sizeof *odd;
    for (int k = 0; k < n * n * n; ++k) {
        real a = odd[k % n], b = odd[k / n % n], c = odd[k / n / n];
        v3 wi[] = {v3_of(a, b, c),
                   v3_of(R(0.6), R(0.0), R(0.8)),
                   v3_of(R(0.6), R(0.0), R(-0.8)),
                   v3_of(R(0.0), R(0.0), R(1.0)),
                   v3_of(R(0.0), R(0.0), R(-1.0)),
                   v3_of(R(1.0), R(0.0), R(0.0))};
        for (int j = 0; j < 6; ++j) {
            beckmann_base g = beckmann_base_of(wi[j], j == 0 ? R(0.3) : a, j == 0 ? R(0.2) : b,
                                               facet_options_of(k % 2 == 0, k % 3 == 0));
            facet_eval e = beckmann_eval(g, beckmann_pair_of_wo(g, v3_of(a, c, R(0.5))));
            assert_true(usable(e.d) && usable(e.g1_o) && usable(e.g2) && usable(e.f_cos));
            for (int i = 0; i < SAMPLERS; ++i) {
                facet_draw d = samplers[i]->draw(g, k_unit(c), k_unit(b));
                assert_true(usable(d.pdf) && usable(d.weight) && usable(d.pdf_m));
                if (!(v3_is_finite(d.wo) && v3_is_finite(d.m)))
                    fail_msg("%s: wi %g %g %g alpha %g %g", samplers[i]->name, (double)wi[j].x,
                             (double)wi[j].y, (double)wi[j].z, (double)a, (double)b);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normaliser),
        cmocka_unit_test(closed_forms),
        cmocka_unit_test(shadowing),
        cmocka_unit_test(densities_integrate_to_one),
        cmocka_unit_test(draws_follow_the_density),
        cmocka_unit_test(three_newton_steps_fail_between_limits),
        cmocka_unit_test(density_far_below),
        cmocka_unit_test(normal_incidence_has_no_seam),
        cmocka_unit_test(horizon_has_a_quarter_of_the_variance),
        cmocka_unit_test(special_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
