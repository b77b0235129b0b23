/* tests/verify/test_statistics.c: tail probabilities against known values. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

#include "verify/statistics.h"

static void assert_near(double value, double expected, double relative) {
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%.17g is not %.17g", value, expected);
}

static void chi_square_tails(void **state) {
    (void)state;
    /* two degrees of freedom: exp(-x/2); one: erfc(sqrt(x/2)); four: (1 + x/2) exp(-x/2) */
    for (double x = 0.1; x < 200; x *= 1.7) {
        assert_near(lobe_chi_square_survival(x, 2), exp(-x / 2), 1e-12);
        assert_near(lobe_chi_square_survival(x, 1), erfc(sqrt(x / 2)), 1e-11);
        assert_near(lobe_chi_square_survival(x, 4), (1 + x / 2) * exp(-x / 2), 1e-12);
    }
    /* quantiles of printed tables */
    assert_near(lobe_chi_square_survival(18.307038, 10), 0.05, 1e-6);
    assert_near(lobe_chi_square_survival(124.342113, 100), 0.05, 1e-6);
    assert_near(lobe_chi_square_survival(1074.679449, 1000), 0.05, 1e-5);
}

static void complements(void **state) {
    (void)state;
    for (double a = 0.3; a < 1e5; a *= 3.1)
        for (double x = 0.5 * a; x < 2 * a; x += 0.17 * a)
            assert_near(lobe_gamma_p(a, x) + lobe_gamma_q(a, x), 1, 1e-12);
}

static void other_tails(void **state) {
    (void)state;
    assert_near(lobe_normal_two_sided(1.959963984540054), 0.05, 1e-12);
    assert_near(lobe_sidak(0.05, 1), 0.05, 1e-14);
    assert_near(1 - pow(1 - lobe_sidak(1e-3, 500), 500), 1e-3, 1e-9);
    /* mean 2: P(0) = exp(-2) */
    assert_near(lobe_poisson_two_sided(2, 0), 2 * exp(-2), 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(chi_square_tails),
                                       cmocka_unit_test(complements),
                                       cmocka_unit_test(other_tails)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
