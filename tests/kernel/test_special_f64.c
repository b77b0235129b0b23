/* The special functions in double against exact values (tools/numerics/special_vectors.py): at most 4
 * units in the last place. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/bind/c_f64.h"

#include "kernel/erf.h"
#include "kernel/erfinv.h"

#include <math.h>

#define ULPS 4.0

enum function { LOG, EXP, ERF, ERFC, ERFCX, DEFECT, ERFINV, ERFCINV, FUNCTIONS };

static const char *const names[FUNCTIONS] = {"log",   "exp",    "erf",    "erfc",
                                             "erfcx", "defect", "erfinv", "erfcinv"};

static double (*const kernels[FUNCTIONS])(double) = {k_log,   k_exp,          k_erf,    k_erfc,
                                                     k_erfcx, k_erfcx_defect, k_erfinv, k_erfcinv};

typedef struct row {
    enum function function;
    double x, high, low; /* the value is high + low */
} row;

#define SPECIAL(function, x, high, low) {function, x, high, low},
static const row rows[] = {
#include "special_vectors.h"
};

/* Distance from the exact value in units of its last place, those of normal numbers. */
static double distance(double got, const row *r) {
    double size = fmax(fabs(r->high), 2.2250738585072014e-308);
    return fabs((got - r->high) - r->low) / (nextafter(size, INFINITY) - size);
}

static void against_exact_values(void **state) {
    (void)state;
    int count[FUNCTIONS] = {0};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        double got = kernels[rows[k].function](rows[k].x);
        if (!(distance(got, &rows[k]) <= ULPS))
            fail_msg("%s(%a): %a, not %a (%.2f ulp)", names[rows[k].function], rows[k].x, got,
                     rows[k].high, distance(got, &rows[k]));
        count[rows[k].function]++;
    }
    for (int f = 0; f < FUNCTIONS; ++f) assert_true(count[f] > 200);
}

static void minus_square(void **state) {
    (void)state;
    for (int k = 0; k < 100000; ++k) {
        double x = 26.0 * k / 100000;
        long double exact = expl(-(long double)x * x);
        assert_true(fabsl(k_exp_minus_square(x) - exact) <= ULPS * 2.3e-16L * exact);
    }
}

static void ends(void **state) {
    (void)state;
    assert_true(k_exp(-1e300) == 0.0 && k_exp(1e300) == INFINITY && k_exp(0.0) == 1.0);
    assert_true(k_erf(0.0) == 0.0 && k_erf(INFINITY) == 1.0 && k_erf(-INFINITY) == -1.0);
    assert_true(k_erfc(INFINITY) == 0.0 && k_erfc(-INFINITY) == 2.0 && k_erfc(0.0) == 1.0);
    assert_true(k_erfcx(0.0) == 1.0 && k_erfcx(-30.0) == INFINITY);
    assert_true(k_erfcx_positive(INFINITY) >= 0.0 && k_erfcx_defect(INFINITY) >= 0.0);
    assert_true(isfinite(k_erfinv(1.0)) && isfinite(k_erfinv(-1.0)) && k_erfinv(0.0) == 0.0);
    assert_true(isfinite(k_erfcinv(0.0)) && isfinite(k_erfcinv(2.0)) && k_erfcinv(1.0) == 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(against_exact_values),
                                       cmocka_unit_test(minus_square), cmocka_unit_test(ends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
