/* tests/kernel/beckmann_slopes_template.h: the inverse distribution of visible slopes against the distribution
 * in long double. Before including: a binding and RESIDUAL, the largest error of the share. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "kernel/beckmann_slopes.h"
#include "beckmann_exact.h"

static uint64_t cases = 150000; /* or the argument of the program */

static double worst;

/* c over all magnitudes of both signs, u over the interval and both its ends. */
static real cotangent(uint64_t k) {
    double size = k % 2 == 0 ? 8 * uniform(k, 0) : pow(10, 10 * uniform(k, 0) - 5);
    return (real)(k % 3 == 0 ? -size : size);
}

static real number(uint64_t k) {
    double u = uniform(k, 1);
    if (k % 5 == 0) u = pow(10, -11 * u);
    if (k % 5 == 1) u = 1 - pow(10, -7.2 * u);
    return k_min((real)u, K_BELOW_ONE);
}

/* Keeps the worst of a test. */
static void keep(double e, real c, real u) {
    if (!(e < RESIDUAL)) fail_msg("c = %.9g, u = %.9g: residual %.3g", (double)c, (double)u, e);
    worst = fmax(worst, e);
}

/* |exact share - wanted share|, taken on the side where the share is small */
static double residual(real c, beckmann_slopes r, real u) {
    real t = beckmann_slopes_inverse(r, u);
    shares at = exact_shares(c, t), least = exact_shares(c, r.t_least);
    shares most = exact_shares(c, r.t_most);
    long double v = 1 - (long double)u;
    if (r.deep_most == R(0.0)) most.deep = 0, most.shallow = 1;
    if (r.shallow_least == R(0.0)) least.deep = 1, least.shallow = 0;
    long double deep = u * least.deep + v * most.deep;
    long double shallow = v * most.shallow + u * least.shallow;
    return (double)fabsl(deep < 0.5L ? at.deep - deep : at.shallow - shallow);
}

static void inverse_of_all_slopes(void **state) {
    (void)state;
    worst = 0;
    for (uint64_t k = 0; k < cases; ++k) {
        real c = cotangent(k), u = number(k);
        keep(residual(c, beckmann_slopes_of(c), u), c, u);
    }
    print_message("worst residual %.3g\n", worst);
}

/* [3c, c) below the horizon (V-cavity), any two limits above it (horizon) */
static void inverse_between_limits(void **state) {
    (void)state;
    worst = 0;
    for (uint64_t k = 0; k < cases; ++k) {
        real c = cotangent(k), u = number(k);
        real t_least = c < R(0.0) ? R(0.0) : -c + (real)uniform(k, 2) * (c + R(1.0));
        real t_most = c < R(0.0) ? R(-2.0) * c : t_least + R(3.0) * (real)uniform(k, 3);
        beckmann_slopes r = beckmann_slopes_between(beckmann_slopes_of(c), t_least, t_most);
        keep(residual(c, r, u), c, u);
        real t = beckmann_slopes_inverse(r, u);
        assert_true(t >= r.t_least && t <= r.t_most);
    }
    print_message("worst residual %.3g\n", worst);
}

/* A share u more never gives a deeper slope, beyond rounding: no jump up at a change of formula, and the
 * residual says that there is none down. */
static void inverse_is_monotone(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 60; ++k) {
        beckmann_slopes r = beckmann_slopes_of(cotangent(k));
        real before = K_HUGE;
        for (int j = 0; j < 4000; ++j) {
            real u = ((real)j + R(0.5)) / R(4000.0);
            real t = beckmann_slopes_inverse(r, u);
            if (!(t <= before + R(40.0) * K_EPS * (R(1.0) + k_abs(t))))
                fail_msg("c = %.9g: jump at u = %.9g", (double)(r.c_plus - r.s), (double)u);
            before = t;
        }
    }
}

int main(int argc, char **argv) {
    if (argc > 1) cases = strtoull(argv[1], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inverse_of_all_slopes),
        cmocka_unit_test(inverse_between_limits),
        cmocka_unit_test(inverse_is_monotone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
