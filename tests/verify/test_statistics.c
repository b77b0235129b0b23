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

/* Computed with 40 digits (mpmath). */
static void incomplete_gamma(void **state) {
    (void)state;
    static const double KNOWN[][4] = {
        {0.5, 20, 0.99999999974603714, 2.539628589470865e-10},
        {2.5, 3, 0.6937810815867216, 0.3062189184132784},
        {10, 30, 0.99999287824913718, 7.1217508628155771e-6},
        {127.5, 180, 0.99998406572738008, 1.5934272619916326e-5},
        {2000, 2300, 0.99999999992567654, 7.432346137968059e-11},
        {50000.5, 50700, 0.99908109341617259, 0.00091890658382740838},
        {500000, 499000, 0.078580291987144946, 0.92141970801285505},
        {500000, 503500, 0.99999960680703642, 3.9319296357575028e-7},
        {1, 1e-300, 1e-300, 1},
        {3, 700, 1, 2.4225323864783195e-299},
    };
    for (size_t i = 0; i < sizeof KNOWN / sizeof *KNOWN; ++i) {
        assert_near(lobe_gamma_p(KNOWN[i][0], KNOWN[i][1]), KNOWN[i][2], 1e-11);
        assert_near(lobe_gamma_q(KNOWN[i][0], KNOWN[i][1]), KNOWN[i][3], 1e-11);
    }
}

/* What cannot be judged is never accepted. */
static void not_a_number(void **state) {
    (void)state;
    assert_true(lobe_chi_square_survival(INFINITY, 10) == 0);
    assert_true(lobe_chi_square_survival(NAN, 10) == 0);
    assert_true(lobe_normal_two_sided(NAN) == 0);
    assert_true(lobe_poisson_two_sided(NAN, 1) == 0);
}

static void other_tails(void **state) {
    (void)state;
    assert_near(lobe_normal_two_sided(1.959963984540054), 0.05, 1e-12);
    assert_near(lobe_sidak(0.05, 1), 0.05, 1e-14);
    assert_near(1 - pow(1 - lobe_sidak(1e-3, 500), 500), 1e-3, 1e-9);
    /* mean 2: P(0) = exp(-2) */
    assert_near(lobe_poisson_two_sided(2, 0), 2 * exp(-2), 1e-12);
    /* P(X >= 5 | 1) = 1 - 65/24 exp(-1) */
    assert_near(lobe_poisson_two_sided(1, 5), 2 * (1 - 65.0 / 24 * exp(-1)), 1e-12);
    assert_true(lobe_poisson_two_sided(0, 0) == 1 && lobe_poisson_two_sided(0, 1) == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chi_square_tails), cmocka_unit_test(complements),
        cmocka_unit_test(incomplete_gamma), cmocka_unit_test(not_a_number),
        cmocka_unit_test(other_tails)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
