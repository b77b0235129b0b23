/* tests/kernel/optimal_template.h: the optimal cap holds every reflection that leaves, and no cap is
 * smaller. Before including: a binding, SLACK (how far rounding may let the horizon stick out) and
 * ROOM (area over the smallest area). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/ggx_optimal.h"
#include "lobe/random.h"

#include <math.h>

static double uniform(uint64_t k, int word) {
    return lobe_random_unit_f32(lobe_random(5, 0, k).word[word]);
}

/* Roughness 0.01 to 2.5, any angle; isotropic, grazing and axis-aligned ones among them. */
static ggx_base configuration(uint64_t k) {
    double mu = k % 5 == 0 ? pow(10, -4 * uniform(k, 0)) : uniform(k, 0);
    double phi = k % 3 == 0 ? 0.5 * 3.141592653589793 * (double)(k % 4)
                            : 2 * 3.141592653589793 * uniform(k, 1);
    double ax = 0.01 * pow(250, uniform(k, 2));
    double ay = k % 4 == 1 ? ax : 0.01 * pow(250, uniform(k, 3));
    double s = sqrt(1 - mu * mu);
    v3 wi = v3_of((real)(s * cos(phi)), (real)(s * sin(phi)), (real)mu);
    return ggx_base_of(wi, (real)ax, (real)ay, facet_options_of(false, false));
}

/* How far the horizon direction at azimuth phi lies inside the cap, in double: the oracle. wi is made
 * unit again: at grazing incidence its own rounding is not small against wi.z^2. */
static double horizon_slack(ggx_base g, ggx_optimal s, double phi) {
    double z = g.wi.z;
    double unit = sqrt((1 - z * z) / ((double)g.wi.x * g.wi.x + (double)g.wi.y * g.wi.y + 1e-300));
    double x = g.wi.x * unit, y = g.wi.y * unit;
    double hx = (x + cos(phi)) / g.ax, hy = (y + sin(phi)) / g.ay, hz = z;
    double ix = g.ax * x, iy = g.ay * y, iz = z;
    double t = sqrt(ix * ix + iy * iy + iz * iz);
    double twice = 2 * (ix * hx + iy * hy + iz * hz) / (t * (hx * hx + hy * hy + hz * hz));
    double along = s.axis.x * (twice * hx - ix / t) + s.axis.y * (twice * hy - iy / t) +
                   s.axis.z * (twice * hz - iz / t);
    return along - (1 - (double)s.w);
}

static void holds_the_horizon(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 10000; ++k) {
        ggx_base g = configuration(k);
        ggx_optimal s = ggx_optimal_prepare(g);
        for (int j = 0; j < 180; ++j) {
            double slack = horizon_slack(g, s, j * (3.141592653589793 / 90));
            if (!(slack > -SLACK))
                fail_msg("alpha %g %g wi %g %g %g: sticks out by %g", (double)g.ax, (double)g.ay,
                         (double)g.wi.x, (double)g.wi.y, (double)g.wi.z, -slack);
        }
    }
}

/* Height 1 - kappa at a given value of the free scalar. */
static double height(ggx_optimal_frame q, ggx_base g, double f) {
    v3 a = ggx_optimal_axis(q, g.i_std, (real)f);
    double c = ggx_optimal_c(q, g.i_std.z, (real)f);
    return 1 - c / sqrt((double)a.x * a.x + (double)a.y * a.y + (double)a.z * a.z);
}

/* Golden section within the best cell of a scan over all f that can be optimal. */
static double smallest_height(ggx_optimal_frame q, ggx_base g) {
    double reach = fmax(1.5 / sqrt((double)q.mu2),
                        q.q0 > 0 ? (double)q.u2 / fmax((double)(q.gap * g.i_std.z), 1e-12) : 0);
    const int cells = 400;
    int best = -cells;
    for (int j = -cells; j <= cells; ++j)
        if (height(q, g, reach * j / cells) < height(q, g, reach * best / cells)) best = j;
    double lo = reach * (best - 1) / cells, hi = reach * (best + 1) / cells;
    for (int step = 0; step < 40; ++step) {
        double a = lo + 0.381966 * (hi - lo), b = hi - 0.381966 * (hi - lo);
        if (height(q, g, a) < height(q, g, b))
            hi = b;
        else
            lo = a;
    }
    return fmin(height(q, g, 0), height(q, g, 0.5 * (lo + hi)));
}

static void area_is_the_smallest(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 4000; ++k) {
        ggx_base g = configuration(k);
        double ratio = ggx_optimal_prepare(g).w / smallest_height(ggx_optimal_frame_of(g), g);
        if (!(ratio < ROOM))
            fail_msg("alpha %g %g wi %g %g %g: area %g of the smallest", (double)g.ax, (double)g.ay,
                     (double)g.wi.x, (double)g.wi.y, (double)g.wi.z, ratio);
    }
}

static void special_cases(void **state) {
    (void)state;
    v3 wi = v3_of(R(0.6), R(0.0), R(0.8));
    ggx_optimal hemisphere =
        ggx_optimal_prepare(ggx_base_of(wi, R(1.0), R(1.0), facet_options_of(false, false)));
    assert_true(k_abs(hemisphere.w - R(1.0)) < R(2.0) * K_EPS);
    assert_true(k_abs(hemisphere.axis.z - R(1.0)) < R(2.0) * K_EPS);
    v3 normal = v3_of(R(0.0), R(0.0), R(1.0));
    ggx_optimal ring =
        ggx_optimal_prepare(ggx_base_of(normal, R(0.5), R(0.5), facet_options_of(false, false)));
    assert_true(k_abs(ring.w - R(1.6)) < R(4.0) * K_EPS); /* kappa = (a^2 - 1)/(a^2 + 1) */
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(holds_the_horizon),
                                       cmocka_unit_test(area_is_the_smallest),
                                       cmocka_unit_test(special_cases)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
