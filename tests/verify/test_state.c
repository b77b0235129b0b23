/* tests/verify/test_state.c: a run that was interrupted goes on, and ends as if it had not been. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include <lobe/verify.h>

enum { ROOM = 1 << 18 };

static char path[64], part[72];

typedef struct transcript {
    char text[ROOM];
    size_t length;
    int calls, cancel_at;
} transcript;

static void write_test(void *user, const lobe_verify_test *test) {
    transcript *t = user;
    int written = snprintf(t->text + t->length, sizeof t->text - t->length,
                           "%s %s %s %s %.17g %.17g %.17g %d %d\n", test->model,
                           test->configuration, test->test, test->detail, test->statistic,
                           test->value, test->limit, (int)test->passed, (int)test->is_known);
    t->length += (size_t)written;
    assert_true(t->length < sizeof t->text);
}

static int count_calls(void *user, double share) {
    transcript *t = user;
    (void)share;
    t->calls += 1;
    return t->cancel_at != 0 && t->calls >= t->cancel_at;
}

static lobe_verify_options options_for(transcript *t, const char *state) {
    lobe_verify_options options = lobe_verify_default_options();
    options.only = "caps f??*g2=separable";
    options.draws = 100000;
    options.threads = 1;
    options.on_test = write_test;
    options.on_progress = count_calls;
    options.user = t;
    options.state = state;
    t->length = 0;
    t->calls = 0;
    t->cancel_at = 0;
    return options;
}

static int set_up(void **state) {
    (void)state;
    snprintf(path, sizeof path, "/tmp/lobe_state_%ld", (long)getpid());
    snprintf(part, sizeof part, "%s.part", path);
    remove(path);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    remove(path);
    return 0;
}

static void an_interrupted_run_goes_on(void **state) {
    (void)state;
    static transcript whole, first, second;
    lobe_verify_summary summary;
    lobe_verify_options options = options_for(&whole, NULL);
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_OK);
    uint64_t cases = summary.cases;
    assert_true(cases >= 8);

    options = options_for(&first, path);
    first.cancel_at = 7; /* two calls a case */
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_CANCELLED);
    assert_in_range(summary.cases, 2, cases - 1);
    uint64_t finished = summary.cases;

    options = options_for(&second, path);
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_OK);
    assert_int_equal(summary.resumed, finished);
    assert_int_equal(summary.draws, (cases - finished) * options.draws);
    assert_string_equal(second.text, whole.text);
    assert_int_equal(access(part, F_OK), -1);

    /* All of it is there now: nothing is drawn. */
    options = options_for(&second, path);
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_OK);
    assert_int_equal(summary.draws, 0);
    assert_string_equal(second.text, whole.text);
}

static void check_refused(lobe_verify_options options, const char *word) {
    lobe_verify_summary summary;
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_BAD_STATE);
    if (strstr(summary.message, word) == NULL) fail_msg("%s", summary.message);
    assert_non_null(strchr(summary.message, ';'));
}

static void another_run_is_refused(void **state) {
    (void)state;
    static transcript t;
    lobe_verify_summary summary;
    lobe_verify_options options = options_for(&t, path);
    options.only = "caps f32 alpha=1,1 theta=60";
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_OK);
    lobe_verify_options other = options;
    other.seed = 2;
    check_refused(other, "seed");
    other = options;
    other.draws = 100001;
    check_refused(other, "draws");
    other = options;
    other.level = LOBE_VERIFY_FULL;
    check_refused(other, "level");
    other = options;
    other.only = "caps f64 alpha=1,1 theta=60";
    check_refused(other, "cases");
}

static size_t read_all(char *text) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t size = fread(text, 1, ROOM, file);
    fclose(file);
    return size;
}

static void write_all(const char *text, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    fclose(file);
}

/* Every truncation and every changed byte, some of each. */
static void damage_is_refused(void **state) {
    (void)state;
    static transcript t;
    static char text[ROOM], changed[ROOM];
    lobe_verify_summary summary;
    lobe_verify_options options = options_for(&t, path);
    options.only = "caps f32 alpha=1,1 theta=60";
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_OK);
    size_t size = read_all(text);
    for (size_t i = 0; i < size; i += 41) {
        write_all(text, i);
        check_refused(options, "state");
        memcpy(changed, text, size);
        changed[i] ^= 1;
        write_all(changed, size);
        check_refused(options, path);
        changed[i] = '\0';
        write_all(changed, size);
        check_refused(options, path);
    }
}

static void a_place_that_cannot_be_written_is_told_at_once(void **state) {
    (void)state;
    static transcript t;
    lobe_verify_summary summary;
    lobe_verify_options options = options_for(&t, "/nowhere/at/all");
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_NOT_SAVED);
    assert_int_equal(summary.cases, 0);
    options.state = "/tmp";
    assert_int_equal(lobe_verify_run(&options, &summary), LOBE_VERIFY_BAD_STATE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(an_interrupted_run_goes_on, set_up, tear_down),
        cmocka_unit_test_setup_teardown(another_run_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(damage_is_refused, set_up, tear_down),
        cmocka_unit_test(a_place_that_cannot_be_written_is_told_at_once)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
