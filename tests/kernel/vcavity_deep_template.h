/* tests/kernel/vcavity_deep_template.h: Beckmann V-cavities from far below the horizon, where D and H are
 * too small for numbers and only their ratio is left. Before including: a binding, SCALED_CLOSE
 * (relative error of H exp(a^2)) and DENSITY_CLOSE. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/beckmann_vcavity.h"
#include "kernel/beckmann_vcavity_valid.h"
#include "lobe/random.h"

#include <math.h>
#include <stdlib.h>

/* exp(a^2) times the integral of min(x - a, 2a) exp(-x^2)/sqrt(pi) from x = a to a + depth: by Simpson's
 * rule on either side of 2a, every term positive. */
static double seen_within(double a, double depth) {
    enum { CELLS = 5000 };
    const double ends[3] = {0, fmin(2 * a, depth), depth};
    double sum = 0;
    for (int part = 0; part < 2; ++part) {
        double h = (ends[part + 1] - ends[part]) / (2 * CELLS);
        for (int k = 0; k <= 2 * CELLS; ++k) {
            double t = ends[part] + h * k;
            double weight = k == 0 || k == 2 * CELLS ? 1 : k % 2 ? 4 : 2;
            sum += weight * h / 3 * fmin(t, 2 * a) * exp(-t * (t + 2 * a));
        }
    }
    return sum / sqrt(3.14159265358979323846);
}

/* A depth that holds all but exp(-40) */
static double bottom(double a) {
    return 40 / (a + sqrt(a * a + 40));
}

static void hit_probability(void **state) {
    (void)state;
    for (double a = 1e-6; a < 1e4; a *= 1.3) {
        double scaled = (double)beckmann_vcavity_hit_of((real)a).scaled;
        double given = (double)(real)a, exact = seen_within(given, bottom(given)) / given;
        if (!(fabs(scaled / exact - 1) < SCALED_CLOSE))
            fail_msg("a = %g: %.15g is not %.15g", given, scaled, exact);
    }
}

/* The direction whose a is the given one. */
static beckmann_vcavity_base base_at(double a, double alpha) {
    double tangent = 1 / (a * alpha), z = -1 / sqrt(1 + tangent * tangent);
    v3 wi = v3_of((real)(-tangent * z * 0.6), (real)(-tangent * z * 0.8), (real)z);
    return beckmann_vcavity_base_of(wi, (real)alpha, (real)alpha, facet_options_of(false, false));
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

enum { DRAWS = 20000, CASES = 7 };

static const double depths[CASES] = {0.003, 0.1, 0.5, 1.5, 3, 10, 30};

/* Kolmogorov-Smirnov: sqrt(n) times the largest difference stays below 2.4 with a probability of
 * 1 - 2 10^-5 each. All draws leave with weight 1. */
static void draws_have_their_depths(void **state) {
    (void)state;
    static double t[DRAWS];
    for (int k = 0; k < CASES; ++k) {
        beckmann_vcavity_base g = base_at(depths[k], 0.1);
        double a = (double)g.a, whole = seen_within(a, bottom(a)), worst = 0;
        beckmann_vcavity s = beckmann_vcavity_prepare(g);
        for (uint64_t n = 0; n < DRAWS; ++n) {
            lobe_random4 r = lobe_random(13, (uint64_t)k, n);
            facet_draw d = beckmann_vcavity_draw(s, (real)lobe_random_unit_f32(r.word[0]),
                                                 (real)lobe_random_unit_f32(r.word[1]),
                                                 (real)lobe_random_unit_f32(r.word[2]));
            double along = (0.6 * (double)d.m.x + 0.8 * (double)d.m.y) / (0.1 * (double)d.m.z);
            t[n] = fmax(along - a, 0);
            assert_true(d.weight > R(0.999) && d.weight < R(1.001));
        }
        qsort(t, DRAWS, sizeof t[0], by_value);
        for (int n = 50; n < DRAWS; n += 100) {
            double share = seen_within(a, t[n]) / whole;
            worst = fmax(worst, fabs(share - (n + 0.5) / DRAWS));
        }
        if (!(worst * sqrt(DRAWS) < 2.4)) fail_msg("a = %g: off by %g", a, worst);
    }
}

/* The density at a normal against the one of its slopes, t(m) and y(m) in double. */
static void densities_are_of_their_slopes(void **state) {
    (void)state;
    for (int k = 0; k < CASES; ++k) {
        double alpha = 0.1;
        beckmann_vcavity_base g = base_at(depths[k], alpha);
        beckmann_vcavity s = beckmann_vcavity_prepare(g);
        double a = (double)g.a, whole = seen_within(a, bottom(a));
        for (int n = 1; n < 200; ++n) {
            double depth = bottom(a) * 0.4 * n / 200, y = 0.01 * (n % 37) - 0.2;
            double sx = alpha * (0.6 * (a + depth) - 0.8 * y);
            double sy = alpha * (0.8 * (a + depth) + 0.6 * y), z = 1 / sqrt(1 + sx * sx + sy * sy);
            v3 m = v3_of((real)(sx * z), (real)(sy * z), (real)z);
            double pdf = (double)beckmann_vcavity_pdf_m(s, beckmann_vcavity_pair_of_m(g, m));
            double slopes = fmin(depth, 2 * a) * exp(-depth * (depth + 2 * a) - y * y);
            double exact = slopes / (3.14159265358979323846 * whole * alpha * alpha * z * z * z);
            if (!(fabs(pdf / exact - 1) < DENSITY_CLOSE * (1 + a * a) * (1 + 0.1 / depth)))
                fail_msg("a = %g, depth %g: density %g is not %g", a, depth, pdf, exact);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(hit_probability),
                                       cmocka_unit_test(draws_have_their_depths),
                                       cmocka_unit_test(densities_are_of_their_slopes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
