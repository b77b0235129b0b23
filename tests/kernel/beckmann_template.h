/* tests/kernel/beckmann_template.h: Smith-Beckmann against quadrature, exact distributions and its own
 * limits. Before including: a binding and TOLERANCE (relative, of closed forms). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

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

/* V(i)/2 exp(shift) = int (c - x)+ b exp(shift - x^2)/sqrt(pi) dx by Simpson's rule in the depth. */
static double visible_by_quadrature(beckmann_base g) {
    const int cells = 4000;
    double c = g.c, s = fmax(-c, 0), top = fmax(-c, -8), bottom = 40 / (s + 6.5);
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

static const sampler *const samplers[] = {&ndf, &slope, &newton};
enum { SAMPLERS = sizeof samplers / sizeof *samplers };

/* The normal with the slope at depth t along i and y across. */
static v3 normal_at(beckmann_base g, double t, double y) {
    facet_azimuth a = facet_azimuth_of(g.i_std);
    real x = (real)-t - k_max(-g.c, R(0.0));
    return beckmann_normal_of_slopes(g, x * a.x - (real)y * a.y, x * a.y + (real)y * a.x);
}

/* int pdf_m over all visible normals, or over all for `ndf`, by the midpoint rule in slopes. */
static double integral_of_density(const sampler *s, beckmann_base g) {
    const int cells = 500;
    double depth = fmax(-(double)g.c, 0), bottom = 40 / (depth + 6.5), sum = 0;
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

static void densities_integrate_to_one(void **state) {
    (void)state;
    const double theta[] = {0, 0.02, 0.6, 1.2, 1.55, 1.7, 2.2, 2.8};
    for (int k = 0; k < SAMPLERS * 8; ++k) {
        beckmann_base g = base_at(theta[k / SAMPLERS], 0.7, 0.5, k / SAMPLERS % 2 == 0 ? 0.5 : 0.2);
        const sampler *s = samplers[k % SAMPLERS];
        double sum = integral_of_density(s, g);
        if (!(fabs(sum - 1) < 1e-3))
            fail_msg("%s at theta %g: %.7g", s->name, theta[k / SAMPLERS], sum);
    }
}

/* chi^2 over its degrees of freedom of draws of normals against the visible normals, in cells of equal
 * probability: the share of slopes below the one along i, and below the one across. */
enum { ALONG = 40, ACROSS = 25, DRAWS = 400000 };

static double chi2_per_cell(const sampler *s, beckmann_base g) {
    static int count[ALONG][ACROSS];
    memset(count, 0, sizeof count);
    facet_azimuth a = facet_azimuth_of(g.i_std);
    for (uint64_t k = 0; k < DRAWS; ++k) {
        lobe_random4 r = lobe_random(77, 0, k);
        v3 m = s->draw(g, lobe_random_unit_f32(r.word[0]), lobe_random_unit_f32(r.word[1])).m;
        double x = -m.x / (g.ax * m.z), y = -m.y / (g.ay * m.z);
        double along = x * a.x + y * a.y, across = y * a.x - x * a.y;
        double u = (double)exact_shares(g.c, -along - fmax(-(double)g.c, 0)).deep;
        double w = 0.5 * erfc(-across);
        count[(int)fmin(fmax(u, 0) * ALONG, ALONG - 1)][(int)fmin(w * ACROSS, ACROSS - 1)]++;
    }
    double expected = (double)DRAWS / (ALONG * ACROSS), sum = 0;
    for (int j = 0; j < ALONG; ++j)
        for (int k = 0; k < ACROSS; ++k)
            sum += (count[j][k] - expected) * (count[j][k] - expected) / expected;
    return sum / (ALONG * ACROSS - 1);
}

/* chi^2 per degree has the standard deviation sqrt(2/999) = 0.045: 1.25 is 5.6 of them, p = 1e-8. */
static void draws_follow_the_visible_normals(void **state) {
    (void)state;
    const double theta[] = {0, 0.3, 1.2, 1.5708, 1.658, 2.3};
    for (int k = 0; k < 6; ++k) {
        beckmann_base g = base_at(theta[k], 0.7, 0.5, k % 2 == 0 ? 0.5 : 0.2);
        double by_newton = chi2_per_cell(&newton, g), by_slope = chi2_per_cell(&slope, g);
        if (!(by_newton < 1.25)) fail_msg("newton at theta %g: %g", theta[k], by_newton);
        if (!(by_slope < 1.25)) fail_msg("slope at theta %g: %g", theta[k], by_slope);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normaliser),
        cmocka_unit_test(closed_forms),
        cmocka_unit_test(shadowing),
        cmocka_unit_test(densities_integrate_to_one),
        cmocka_unit_test(draws_follow_the_visible_normals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
