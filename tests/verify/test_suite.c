/* tests/verify/test_suite.c: how a full run is kept within its time, however long the list. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "verify/suite.h"

enum { CONFIGURATIONS = 28 };

/* Models in pairs, as the two precisions of a method are. */
static lobe_suite suite_of(size_t models) {
    lobe_suite suite = {.count = models * CONFIGURATIONS};
    suite.titles = calloc(suite.count, sizeof *suite.titles);
    assert_non_null(suite.titles);
    for (size_t i = 0; i < suite.count; ++i) {
        size_t model = i / CONFIGURATIONS;
        snprintf(suite.titles[i].model, sizeof suite.titles[i].model, "m%zu f%d", model / 2,
                 model % 2 ? 64 : 32);
        snprintf(suite.titles[i].configuration, sizeof suite.titles[i].configuration, "c=%zu",
                 i % CONFIGURATIONS);
    }
    return suite;
}

static void check_spread(size_t models) {
    lobe_suite suite = suite_of(models);
    lobe_verify_options options = lobe_verify_default_options();
    options.level = LOBE_VERIFY_FULL;
    assert_true(lobe_suite_choose(&suite, &options));
    size_t stride = (suite.count + LOBE_VERIFY_FULL_CASES - 1) / LOBE_VERIFY_FULL_CASES;
    /* A model more or less where the stride does not divide the configurations. */
    assert_true(suite.chosen_count <= LOBE_VERIFY_FULL_CASES + models);
    int by_configuration[CONFIGURATIONS] = {0};
    int *by_model = calloc(models, sizeof *by_model);
    assert_non_null(by_model);
    for (size_t i = 0; i < suite.chosen_count; ++i) {
        by_model[suite.chosen[i] / CONFIGURATIONS] += 1;
        by_configuration[suite.chosen[i] % CONFIGURATIONS] += 1;
    }
    for (size_t m = 0; m < models; ++m) {
        assert_true(by_model[m] >= CONFIGURATIONS / (int)stride);
    }
    for (int c = 0; c < CONFIGURATIONS; ++c) {
        assert_true(by_configuration[c] >= (int)(models / stride));
    }
    free(by_model);
    lobe_suite_free(&suite);
}

static void full_is_an_even_choice(void **state) {
    (void)state;
    for (size_t models = 2; models <= 80; models += 2) check_spread(models);
}

/* Two models with configurations of their own behind many others: every one of them is run once. */
static void few_models_are_not_thinned_out(void **state) {
    (void)state;
    enum { MODELS = 60 };
    lobe_suite suite = suite_of(MODELS);
    for (size_t i = (MODELS - 2) * CONFIGURATIONS; i < suite.count; ++i)
        suite.titles[i].configuration[0] = 'd';
    lobe_verify_options options = lobe_verify_default_options();
    options.level = LOBE_VERIFY_FULL;
    assert_true(lobe_suite_choose(&suite, &options));
    int by_configuration[CONFIGURATIONS] = {0};
    for (size_t i = 0; i < suite.chosen_count; ++i) {
        if (suite.chosen[i] >= (MODELS - 2) * CONFIGURATIONS)
            by_configuration[suite.chosen[i] % CONFIGURATIONS] += 1;
    }
    for (int c = 0; c < CONFIGURATIONS; ++c) assert_int_equal(by_configuration[c], 1);
    lobe_suite_free(&suite);
}

static void a_pattern_chooses_from_the_whole_list(void **state) {
    (void)state;
    lobe_suite suite = suite_of(60);
    lobe_verify_options options = lobe_verify_default_options();
    options.level = LOBE_VERIFY_FULL;
    options.only = "m7 f??*c=1";
    assert_true(lobe_suite_choose(&suite, &options));
    assert_int_equal(suite.chosen_count, 2 * 11); /* 1, 10 to 19 */
    lobe_suite_free(&suite);
    suite = suite_of(60);
    options.only = "*";
    assert_true(lobe_suite_choose(&suite, &options));
    assert_int_equal(suite.chosen_count, suite.count);
    lobe_suite_free(&suite);
}

static void quick_is_all(void **state) {
    (void)state;
    lobe_suite suite = suite_of(60);
    lobe_verify_options options = lobe_verify_default_options();
    assert_true(lobe_suite_choose(&suite, &options));
    assert_int_equal(suite.chosen_count, suite.count);
    lobe_suite_free(&suite);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_is_an_even_choice), cmocka_unit_test(few_models_are_not_thinned_out),
        cmocka_unit_test(a_pattern_chooses_from_the_whole_list), cmocka_unit_test(quick_is_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
