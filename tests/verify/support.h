/* tests/verify/support.h: running the engine on a model of the test's own. */
#ifndef LOBE_TESTS_VERIFY_SUPPORT_H
#define LOBE_TESTS_VERIFY_SUPPORT_H

#include <string.h>

#include <cmocka.h>

#include "verify/engine.h"
#include "verify/reflection_model.h"

/* The limit of a p-value in the whole list of `lobe verify`. */
#define LIST_P_LIMIT 1e-6

static inline void run_engine(const lobe_verify_model *model, const lobe_settings *settings,
                              lobe_report *report) {
    lobe_monitor monitor = {.total_draws = 1};
    assert_true(lobe_verify_model_run(model, settings, &monitor, report, NULL));
}

/* One call each: a defect that replaces one of them is seen by all tests. */
static inline void call_one_by_one(lobe_verify_model *model) {
    model->sample_many = NULL;
    model->evaluate_many = NULL;
}

static inline int count_failures(const lobe_report *report) {
    int failures = 0;
    for (int i = 0; i < report->count; ++i) failures += !lobe_report_row_passed(&report->rows[i]);
    return failures;
}

/* NULL where the test did not run. */
static inline const lobe_report_row *find_row(const lobe_report *report, const char *test) {
    for (int i = 0; i < report->count; ++i) {
        if (strcmp(report->rows[i].test, test) == 0) return &report->rows[i];
    }
    return NULL;
}

/* Prints what failed, one line. */
static inline void print_failures(const lobe_verify_model *model, const lobe_report *report) {
    print_message("%s, %s:", model->name, model->configuration);
    for (int i = 0; i < report->count; ++i) {
        const lobe_report_row *row = &report->rows[i];
        if (!lobe_report_row_passed(row)) print_message(" %s (%.3g)", row->test, row->value);
    }
    print_message("\n");
}

static inline lobe_reflection_parameters ggx_parameters(lobe_method method, double alpha_x,
                                                        double alpha_y, double theta, double phi) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = method;
    return (lobe_reflection_parameters){options, alpha_x, alpha_y, theta, phi, 0, 0};
}

#endif
