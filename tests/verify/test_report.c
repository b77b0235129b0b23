/* tests/verify/test_report.c: known failures, and reports that somebody else wrote. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "tests/verify/support.h"

static lobe_report two_rows(double p, double error) {
    lobe_report report = {.count = 0};
    lobe_report_p_value(&report, "chi2", 1, p, 1e-6, "of %d", 7);
    lobe_report_error(&report, "density", error, 32, "none");
    return report;
}

/* A documented failure is none; any other one is; and where it is due and absent, that is one. */
static void known_failures_are_set_apart(void **state) {
    (void)state;
    lobe_report report = two_rows(1e-9, 1);
    assert_int_equal(lobe_report_failures(&report), 1);
    lobe_report_mark_known(&report, "chi2 furnace", 0);
    assert_int_equal(lobe_report_failures(&report), 0);
    assert_int_equal(report.count, 2);

    report = two_rows(1e-9, 100);
    lobe_report_mark_known(&report, "chi2 furnace", 1);
    assert_int_equal(lobe_report_failures(&report), 1);
    assert_true(report.rows[0].is_known && !report.rows[1].is_known);

    report = two_rows(0.3, 1);
    lobe_report_mark_known(&report, "chi2 furnace", 0);
    assert_int_equal(lobe_report_failures(&report), 0);
    report = two_rows(0.3, 1);
    lobe_report_mark_known(&report, "chi2 furnace", 1);
    assert_int_equal(lobe_report_failures(&report), 1);
    assert_string_equal(report.rows[2].test, "known bias");
}

static void names_are_whole_words(void **state) {
    (void)state;
    lobe_report report = two_rows(1e-9, 1);
    lobe_report_mark_known(&report, "chi2b achi2", 0);
    assert_int_equal(lobe_report_failures(&report), 1);
    lobe_report_mark_known(&report, "chi2b chi2", 0);
    assert_int_equal(lobe_report_failures(&report), 0);
}

static void any_bytes_become_a_report(void **state) {
    (void)state;
    lobe_report report;
    for (int byte = 0; byte < 256; ++byte) {
        memset(&report, byte, sizeof report);
        lobe_report_sanitize(&report);
        assert_in_range(report.count, 0, LOBE_REPORT_ROOM - 1);
        assert_true(strlen(report.stage) < sizeof report.stage);
        for (int i = 0; i < report.count; ++i) {
            assert_true(strlen(report.rows[i].detail) < sizeof report.rows[i].detail);
            lobe_report_row_passed(&report.rows[i]);
        }
    }
}

/* The published fit at 2 10^6 draws: the engine sets its failure apart. */
static void published_bias_is_known(void **state) {
    (void)state;
    lobe_reflection_subject subject;
    lobe_reflection_subject_make(&subject,
                                 ggx_parameters(LOBE_METHOD_SLOPE_PUBLISHED, 0.3, 0.1, 95, 200),
                                 LOBE_PRECISION_F64);
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    settings.draws = 2000000;
    settings.p_limit = LIST_P_LIMIT;
    lobe_report report;
    run_engine(&subject.model, &settings, &report);
    assert_false(lobe_report_row_passed(find_row(&report, "chi2")));
    assert_int_equal(lobe_report_failures(&report), 0);
    assert_null(find_row(&report, "known bias"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_failures_are_set_apart), cmocka_unit_test(names_are_whole_words),
        cmocka_unit_test(any_bytes_become_a_report), cmocka_unit_test(published_bias_is_known)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
