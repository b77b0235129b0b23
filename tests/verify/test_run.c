/* tests/verify/test_run.c: the public entrance. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "verify/reflection_model.h"

#include <lobe/reflection.h>
#include <lobe/verify.h>

/* All that on_test was told, as text. */
typedef struct transcript {
    char text[65536];
    size_t length;
} transcript;

static void write_test(void *user, const lobe_verify_test *test) {
    transcript *t = user;
    int written = snprintf(t->text + t->length, sizeof t->text - t->length,
                           "%s %s %s %s %.17g %.17g %d\n", test->model, test->configuration,
                           test->test, test->detail, test->statistic, test->value, test->passed);
    t->length += (size_t)written;
    assert_true(t->length < sizeof t->text);
}

static void run(const char *only, uint64_t draws, int threads, transcript *t) {
    lobe_verify_options options = lobe_verify_default_options();
    options.only = only;
    options.draws = draws;
    options.threads = threads;
    options.on_test = write_test;
    options.user = t;
    lobe_verify_summary summary;
    t->length = 0;
    lobe_verify_result result = lobe_verify_run(&options, &summary);
    if (result != LOBE_VERIFY_OK) fail_msg("%s\n%s", summary.message, t->text);
    assert_true(summary.tests_passed > 0 && summary.tests_failed == 0);
}

static void threads_do_not_matter(void **state) {
    (void)state;
    static transcript one, four;
    run("bounded f32 alpha=0.2", 100000, 1, &one);
    run("bounded f32 alpha=0.2", 100000, 4, &four);
    assert_string_equal(one.text, four.text);
    /* one case: its draws are shared out */
    run("caps f64 alpha=0.5,1", 300000, 1, &one);
    run("caps f64 alpha=0.5,1", 300000, 3, &four);
    assert_string_equal(one.text, four.text);
}

static void a_choice_does_not_change_a_case(void **state) {
    (void)state;
    static transcript alone, among;
    run("optimal f32 alpha=0.7", 20000, 2, &alone);
    run("optimal f32", 20000, 2, &among);
    assert_non_null(strstr(among.text, alone.text));
}

enum { MOST_MODELS = 64 };

static void count_case(void *user, const lobe_verify_case *verify_case) {
    int *counts = user;
    for (int m = 0; m < lobe_model_count(); ++m) {
        char name[64];
        lobe_reflection_model_name(lobe_model_at(m), name, sizeof name);
        size_t length = strlen(name);
        counts[m] += strncmp(verify_case->model, name, length) == 0 &&
                     strlen(verify_case->model) == length + strlen(" f32");
    }
}

static void every_model_is_in_the_list(void **state) {
    (void)state;
    lobe_verify_options options = lobe_verify_default_options();
    int counts[MOST_MODELS] = {0};
    assert_in_range(lobe_model_count(), 1, MOST_MODELS);
    size_t all = lobe_verify_list(&options, count_case, counts);
    assert_int_equal(all, lobe_verify_list(&options, NULL, NULL));
    for (int m = 0; m < lobe_model_count(); ++m) assert_true(counts[m] > 0);
    options.only = "bounded f??*theta=[46]0";
    assert_true(lobe_verify_list(&options, NULL, NULL) > 0);
    assert_true(lobe_verify_list(&options, NULL, NULL) < all);
    options.only = "nothing of the kind";
    assert_int_equal(lobe_verify_list(&options, NULL, NULL), 0);
}

static void bad_options_are_refused(void **state) {
    (void)state;
    lobe_verify_summary summary;
    lobe_verify_options options = lobe_verify_default_options();
    options.only = "nothing of the kind";
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_NO_CASES);
    assert_non_null(strchr(summary.message, ';'));
    char long_pattern[10000];
    memset(long_pattern, 'x', sizeof long_pattern);
    long_pattern[sizeof long_pattern - 1] = '\0';
    options.only = long_pattern;
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_NO_CASES);
    options = lobe_verify_default_options();
    options.draws = 10;
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_BAD_OPTION);
    options.draws = UINT64_MAX;
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_BAD_OPTION);
    options = lobe_verify_default_options();
    options.threads = -1;
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_BAD_OPTION);
    options = lobe_verify_default_options();
    options.level = (lobe_verify_level)7;
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_BAD_OPTION);
}

typedef struct progress {
    int calls;
    double last;
} progress;

static int cancel_at_third(void *user, double share) {
    progress *p = user;
    p->calls += 1;
    p->last = share;
    return p->calls >= 3;
}

/* 10^12 draws would take days: it ends because it is told to. */
static void a_run_can_be_cancelled(void **state) {
    (void)state;
    progress p = {0, 0};
    lobe_verify_options options = lobe_verify_default_options();
    options.only = "caps";
    options.draws = 1000000000000;
    options.on_progress = cancel_at_third;
    options.user = &p;
    lobe_verify_summary summary;
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_CANCELLED);
    assert_true(p.calls >= 3 && p.last > 0 && p.last < 1);
    assert_int_equal(summary.cases, 0);
    assert_true(summary.message[0] != '\0');
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_matter), cmocka_unit_test(a_choice_does_not_change_a_case),
        cmocka_unit_test(every_model_is_in_the_list), cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(a_run_can_be_cancelled)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
