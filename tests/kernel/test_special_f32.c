/* The special functions in single precision: at most 2 units in the last place of the exact value,
 * 5 where no sampler asks for better. One float in 1009; all of them: tools/numerics/worst_error.c. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/bind/c_f32.h"

#include "kernel/erf.h"
#include "kernel/erfinv.h"

#include <math.h>

enum { STRIDE = 1009 };

typedef float (*kernel_function)(float x);
typedef double (*exact_function)(double x);

static double distance(float got, double exact) {
    float size = fmaxf(fabsf((float)exact), 1.17549435e-38f);
    return fabs((double)got - exact) / ((double)nextafterf(size, INFINITY) - (double)size);
}

/* sign * x for every STRIDE-th float x from low to high. */
static void sweep(kernel_function kernel, exact_function exact, double ulps, float sign, float low,
                  float high) {
    for (kint bits = k_bits(low); bits <= k_bits(high) - STRIDE; bits += STRIDE) {
        float x = sign * k_from_bits(bits);
        double d = distance(kernel(x), exact((double)x));
        if (!(d <= ulps)) fail_msg("at %a: %.2f ulp", (double)x, d);
    }
}

static double scaled_erfc(double x) {
    return (double)(expl((long double)x * x) * erfcl(x));
}

static double defect(double x) {
    return (double)(1 - 1.7724538509055160273L * x * expl((long double)x * x) * erfcl(x));
}

static double inverse_erf(double x) {
    double z = k_erfinv((float)x);
    for (int step = 0; step < 3; ++step) z -= (erf(z) - x) * (0.88622692545275801365 * exp(z * z));
    return z;
}

static double inverse_erfc(double y) {
    double z = k_erfcinv((float)y);
    for (int step = 0; step < 3; ++step) z += (erfc(z) - y) * (0.88622692545275801365 * exp(z * z));
    return z;
}

static void exponential(void **state) {
    (void)state;
    sweep(k_exp, exp, 2, 1, 1e-30f, 88.7f);
    sweep(k_exp, exp, 2, -1, 1e-30f, 1e30f);
}

static void error_function(void **state) {
    (void)state;
    sweep(k_erf, erf, 2, 1, 1e-30f, 1e30f);
    sweep(k_erf, erf, 2, -1, 1e-30f, 1e30f);
}

static void complement(void **state) {
    (void)state;
    sweep(k_erfc, erfc, 2, 1, 1e-30f, 1e30f);
    sweep(k_erfc, erfc, 2, -1, 1e-30f, 1e30f);
}

static void scaled_complement(void **state) {
    (void)state;
    sweep(k_erfcx, scaled_erfc, 2, 1, 1e-30f, 50.0f);
    sweep(k_erfcx, scaled_erfc, 2, -1, 1e-30f, 9.38f);
    sweep(k_erfcx_defect, defect, 5, 1, 1e-30f, 20.0f);
}

static void inverses(void **state) {
    (void)state;
    sweep(k_erfinv, inverse_erf, 2, 1, 1e-30f, 0.99999994f);
    sweep(k_erfinv, inverse_erf, 2, -1, 1e-30f, 0.99999994f);
    sweep(k_erfcinv, inverse_erfc, 3, 1, 4.5e-18f, 1.9999998f);
}

static void ends(void **state) {
    (void)state;
    assert_true(k_exp(-1e30f) == 0.0f && k_exp(1e30f) == INFINITY && k_exp(0.0f) == 1.0f);
    assert_true(k_erf(0.0f) == 0.0f && k_erf(INFINITY) == 1.0f && k_erf(-INFINITY) == -1.0f);
    assert_true(k_erfc(INFINITY) == 0.0f && k_erfc(-INFINITY) == 2.0f && k_erfc(0.0f) == 1.0f);
    assert_true(k_erfcx(0.0f) == 1.0f && k_erfcx(-10.0f) == INFINITY);
    assert_true(k_erfcx_positive(INFINITY) >= 0.0f && k_erfcx_defect(INFINITY) >= 0.0f);
    assert_true(isfinite(k_erfinv(1.0f)) && isfinite(k_erfinv(-1.0f)) && k_erfinv(0.0f) == 0.0f);
    assert_true(isfinite(k_erfcinv(0.0f)) && isfinite(k_erfcinv(2.0f)) && k_erfcinv(1.0f) == 0.0f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exponential), cmocka_unit_test(error_function),
        cmocka_unit_test(complement),  cmocka_unit_test(scaled_complement),
        cmocka_unit_test(inverses),    cmocka_unit_test(ends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
