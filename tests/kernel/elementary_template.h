/* tests/kernel/elementary_template.h: elementary kernels against the C library in long double.
 * Before including: a binding and ULP. The exhaustive search is tools/numerics/worst_error.c. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/arc.h"
#include "kernel/ggx.h"
#include "kernel/kepler.h"
#include "kernel/log.h"

#include <math.h>

static void sine_and_cosine(void **state) {
    (void)state;
    const long double two_pi = 6.283185307179586476925286766559L;
    for (int k = 0; k <= 1000000; ++k) {
        real u = (real)k / R(1000000.0);
        k_sincos r = k_sincos_2pi(u);
        /* exact reduction for the reference too: sin(2 pi u) near u = 1/2 and 1 */
        long double v = (long double)u - roundl((long double)u * 2) / 2;
        long double sign = (long long)roundl((long double)u * 2) % 2 ? -1 : 1;
        assert_true(fabsl((long double)r.s - sign * sinl(two_pi * v)) < 1.5 * ULP);
        assert_true(fabsl((long double)r.c - sign * cosl(two_pi * v)) < 1.5 * ULP);
    }
}

static void logarithm(void **state) {
    (void)state;
    for (int k = -3000; k <= 3000; ++k) {
        real x = (real)expl(0.0213L * k + 1e-4L * (k % 7));
        long double exact = logl((long double)x);
        assert_true(fabsl((long double)k_log(x) - exact) <= 2 * ULP * fabsl(exact));
    }
}

static void inverses_of_tangent_and_sinh(void **state) {
    (void)state;
    for (int k = -3000; k <= 3000; ++k) {
        real size = (real)expl(0.0071L * k + 1e-4L * (k % 7)), x = k % 2 ? size : -size;
        long double angle = atanl((long double)x), area = asinhl((long double)x);
        assert_true(fabsl((long double)k_angle(x, R(1.0)) - angle) <= 2.5 * ULP * fabsl(angle));
        assert_true(fabsl((long double)k_asinh(x) - area) <= 4 * ULP * fabsl(area));
    }
    assert_true(k_angle(R(0.0), R(0.0)) == R(0.0));
    assert_true(k_abs(k_angle(R(1.0), R(0.0)) - R(0.5) * K_PI) < (real)ULP);
    assert_true(k_asinh(R(0.0)) == R(0.0));
}

static void kepler_residual(void **state) {
    (void)state;
    for (int k = 1; k <= 100000; ++k) {
        real t = K_PI * (real)k / R(100000.0);
        long double e = (long double)k_kepler(t);
        /* back through the equation: relative, since e^3/6 is what is left of it for small e */
        long double residual = (e - sinl(e) - (long double)t) / (long double)t;
        if (!(fabsl(residual) < 40 * ULP))
            fail_msg("t = %.9g: residual %.3g", (double)t, (double)residual);
    }
}

/* G1 = 1/(1 + Lambda), in the two forms that do not cancel. */
static void masking(void **state) {
    (void)state;
    for (int k = 1; k < 1000; ++k) {
        real z = (real)k / R(1000.0);
        v3 v = v3_of(k_sqrt(R(1.0) - z * z), R(0.0), z);
        for (real alpha = R(1e-3); alpha < R(10.0); alpha *= R(3.0)) {
            real g1 = R(1.0) / (R(1.0) + ggx_lambda(v, alpha, R(0.5)));
            assert_true(k_abs(g1 - ggx_g1_out(v, alpha, R(0.5))) < (real)(4 * ULP));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sine_and_cosine), cmocka_unit_test(logarithm),
        cmocka_unit_test(inverses_of_tangent_and_sinh), cmocka_unit_test(kepler_residual),
        cmocka_unit_test(masking)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
