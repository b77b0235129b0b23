/* tests/metrics/test_difference.c: errors of pictures against closed forms. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

#include <lobe/metrics.h>

static void assert_near(double value, double expected) {
    if (!(fabs(value - expected) <= 1e-12 * (1 + fabs(expected))))
        fail_msg("%.17g, expected %.17g", value, expected);
}

static void same_pictures_do_not_differ(void **state) {
    (void)state;
    const float picture[6] = {0, 0.25f, 1, 7, 1e-3f, 1e6f};
    const lobe_picture_difference d = lobe_compare_pictures(picture, picture, 2);
    assert_true(d.rmse == 0 && d.relative_mse == 0 && d.largest == 0 && d.mean == d.mean_reference);
}

/* Differences 1, 0, 2, 0, 0, -3 of the references 0, 1, 1, 2, 0, 3. */
static void closed_forms(void **state) {
    (void)state;
    const float picture[6] = {1, 1, 3, 2, 0, 0}, reference[6] = {0, 1, 1, 2, 0, 3};
    const lobe_picture_difference d = lobe_compare_pictures(picture, reference, 2);
    assert_near(d.rmse, sqrt((1.0 + 4 + 9) / 6));
    assert_near(d.relative_mse, (1 / 0.01 + 4 / 1.01 + 9 / 9.01) / 6);
    assert_near(d.mean, 7.0 / 6);
    assert_near(d.mean_reference, 7.0 / 6);
    assert_near(d.largest, 3);
}

static void relative_error_has_one_reference(void **state) {
    (void)state;
    const float a[3] = {2, 2, 2}, b[3] = {1, 1, 1};
    assert_near(lobe_compare_pictures(a, b, 1).relative_mse, 1 / 1.01);
    assert_near(lobe_compare_pictures(b, a, 1).relative_mse, 1 / 4.01);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(same_pictures_do_not_differ),
                                       cmocka_unit_test(closed_forms),
                                       cmocka_unit_test(relative_error_has_one_reference)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
