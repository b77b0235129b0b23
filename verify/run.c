/* The public entrance: choosing cases, running them, reporting in order. */
#include "run.h"

#include <omp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "state.h"
#include "statistics.h"

static const uint64_t LEAST_DRAWS = 1000;
static const uint64_t MOST_DRAWS = 1000000000000;
static const int MOST_THREADS = 1024;

lobe_verify_options lobe_verify_default_options(void) {
    return (lobe_verify_options){.level = LOBE_VERIFY_QUICK, .seed = 1};
}

const lobe_case_title *lobe_run_title(const lobe_run *run, size_t position) {
    return &run->suite.titles[run->suite.chosen[position]];
}

int lobe_run_threads(const lobe_run *run) {
    return run->options->threads > 0 ? run->options->threads : omp_get_num_procs();
}

void lobe_run_stop(lobe_run *run, lobe_verify_result trouble, const char *message, ...) {
    if (run->trouble != LOBE_VERIFY_OK) return; /* the first one is the cause */
    run->trouble = trouble;
    va_list arguments;
    va_start(arguments, message);
    vsnprintf(run->summary->message, sizeof run->summary->message, message, arguments);
    va_end(arguments);
    atomic_store(&run->monitor.is_cancelled, 1);
}

/* ---- Reporting ------------------------------------------------------------------------------- */

static void report_row(lobe_run *run, const lobe_case_title *title, const lobe_report_row *row) {
    int passed = lobe_report_row_passed(row);
    run->summary->tests_passed += passed;
    run->summary->tests_known += row->is_known;
    run->summary->tests_failed += !passed && !row->is_known;
    if (run->options->on_test == NULL) return;
    lobe_verify_test test = {
        title->model,   title->configuration, row->test,  row->detail, (lobe_verify_kind)row->kind,
        row->statistic, row->value,           row->limit, passed,      row->is_known};
    run->options->on_test(run->options->user, &test);
}

static void report_picture(const lobe_run *run, const lobe_case_title *title,
                           const lobe_picture *picture) {
    if (picture == NULL || picture->sheets == 0 || run->options->on_picture == NULL) return;
    lobe_verify_picture p = {.model = title->model,
                             .configuration = title->configuration,
                             .sheets = picture->sheets,
                             .size = LOBE_PICTURE_SIZE,
                             .curve = picture->curve,
                             .curve_points = LOBE_CURVE_POINTS};
    for (int sheet = 0; sheet < picture->sheets; ++sheet) {
        p.observed[sheet] = picture->observed[sheet];
        p.expected[sheet] = picture->expected[sheet];
        p.difference[sheet] = picture->difference[sheet];
    }
    run->options->on_picture(run->options->user, &p);
}

/* Every case that has finished and whose predecessors have. */
static void report_in_order(lobe_run *run) {
    for (; run->reported < run->suite.chosen_count; ++run->reported) {
        lobe_outcome *outcome = &run->outcomes[run->reported];
        if (!outcome->is_done) return;
        const lobe_case_title *title = lobe_run_title(run, run->reported);
        run->summary->cases += 1;
        for (int i = 0; i < outcome->report.count; ++i) {
            report_row(run, title, &outcome->report.rows[i]);
        }
        report_picture(run, title, outcome->picture);
        free(outcome->picture);
        outcome->picture = NULL;
    }
}

void lobe_run_finish_case(lobe_run *run, size_t position) {
    run->outcomes[position].is_done = 1;
    if (run->options->state != NULL) lobe_state_save(run);
    report_in_order(run);
}

/* ---- Setting up ------------------------------------------------------------------------------ */

static void check_options(lobe_run *run) {
    const lobe_verify_options *o = run->options;
    lobe_verify_result bad = LOBE_VERIFY_BAD_OPTION;
    if (o->level != LOBE_VERIFY_QUICK && o->level != LOBE_VERIFY_FULL) {
        lobe_run_stop(run, bad, "unknown level; use quick or full");
    }
    if (o->draws != 0 && (o->draws < LEAST_DRAWS || o->draws > MOST_DRAWS)) {
        lobe_run_stop(run, bad, "draws out of range; use 1000 to 10^12");
    }
    if (o->threads < 0 || o->threads > MOST_THREADS) {
        lobe_run_stop(run, bad, "threads out of range; use 0 to 1024");
    }
    if (!(o->case_seconds >= 0 && o->case_seconds <= 1e6)) {
        lobe_run_stop(run, bad, "time of a case out of range; use 0 to 10^6 seconds");
    }
}

/* Titles and choice. */
static void make_suite(lobe_run *run) {
    const lobe_verify_options *o = run->options;
    if (o->plugin != NULL && !lobe_plugin_read(&run->plugin, o->plugin, run->summary->message,
                                               sizeof run->summary->message)) {
        run->trouble = LOBE_VERIFY_BAD_PLUGIN;
        return;
    }
    int is_good = o->plugin != NULL ? lobe_plugin_suite(&run->suite, &run->plugin)
                                    : lobe_library_suite(&run->suite);
    if (!is_good || !lobe_suite_choose(&run->suite, o)) {
        lobe_run_stop(run, LOBE_VERIFY_NO_MEMORY, "out of memory; close other programs");
    } else if (run->suite.chosen_count == 0) {
        lobe_run_stop(run, LOBE_VERIFY_NO_CASES, "no case matches; list them to see their names");
    }
}

static size_t count_done(const lobe_run *run) {
    size_t done = 0;
    for (size_t i = 0; i < run->suite.chosen_count; ++i) done += run->outcomes[i].is_done != 0;
    return done;
}

static void set_up(lobe_run *run) {
    const lobe_verify_options *o = run->options;
    run->settings = lobe_level_settings(o->level);
    if (o->draws != 0) run->settings.draws = o->draws;
    run->settings.seed = o->seed;
    run->settings.pictures = o->on_picture != NULL ? o->pictures : LOBE_VERIFY_PICTURES_NONE;
    /* Of the whole list: a verdict does not depend on what else was chosen. */
    size_t tests = LOBE_P_VALUES_A_CASE * run->suite.count;
    run->settings.p_limit = lobe_sidak(LOBE_VERIFY_SIGNIFICANCE, tests);
    run->outcomes = calloc(run->suite.chosen_count, sizeof *run->outcomes);
    if (run->outcomes == NULL) {
        lobe_run_stop(run, LOBE_VERIFY_NO_MEMORY, "out of memory; close other programs");
        return;
    }
    if (o->state != NULL) lobe_state_open(run);
    run->summary->resumed = count_done(run);
    size_t left = run->suite.chosen_count - (size_t)run->summary->resumed;
    run->monitor.on_progress = o->on_progress;
    run->monitor.user = o->user;
    run->monitor.total_draws = (double)run->settings.draws * (double)left;
}

/* ---- Running --------------------------------------------------------------------------------- */

static void conclude(lobe_run *run) {
    run->summary->draws = atomic_load(&run->monitor.draws);
    if (run->trouble == LOBE_VERIFY_OK && run->reported < run->suite.chosen_count) {
        lobe_run_stop(run, LOBE_VERIFY_CANCELLED, "cancelled; the cases reported had finished");
    } else if (run->trouble == LOBE_VERIFY_OK && run->summary->tests_failed > 0) {
        run->trouble = LOBE_VERIFY_FAILED;
    }
}

static void release(lobe_run *run) {
    for (size_t i = 0; run->outcomes != NULL && i < run->suite.chosen_count; ++i) {
        free(run->outcomes[i].picture);
    }
    free(run->outcomes);
    lobe_suite_free(&run->suite);
}

lobe_verify_result lobe_verify_run(const lobe_verify_options *options,
                                   lobe_verify_summary *summary) {
    *summary = (lobe_verify_summary){0};
    lobe_run run = {.options = options, .summary = summary};
    check_options(&run);
    if (run.trouble == LOBE_VERIFY_OK) make_suite(&run);
    if (run.trouble == LOBE_VERIFY_OK) set_up(&run);
    if (run.trouble == LOBE_VERIFY_OK) {
        report_in_order(&run);
        if (options->plugin != NULL) {
            lobe_run_plugin_cases(&run);
        } else {
            lobe_run_library_cases(&run);
        }
        conclude(&run);
    }
    release(&run);
    return run.trouble;
}

size_t lobe_verify_list(const lobe_verify_options *options,
                        void (*on_case)(void *user, const lobe_verify_case *verify_case),
                        void *user) {
    lobe_verify_summary summary;
    lobe_run run = {.options = options, .summary = &summary};
    make_suite(&run);
    size_t count = run.suite.chosen_count;
    for (size_t i = 0; i < count && on_case != NULL; ++i) {
        const lobe_case_title *title = lobe_run_title(&run, i);
        on_case(user, &(lobe_verify_case){title->model, title->configuration});
    }
    release(&run);
    return count;
}
