/* The public entrance: choosing cases, running them on several threads, reporting in order. */
#define _POSIX_C_SOURCE 200809L

#include <lobe/verify.h>

#include <fnmatch.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "reflection_cases.h"
#include "statistics.h"

enum { TITLE_ROOM = 160, PATTERN_ROOM = 256 };

static const uint64_t LEAST_DRAWS = 1000;
static const uint64_t MOST_DRAWS = 1000000000000;
static const int MOST_THREADS = 1024;

typedef struct chosen {
    size_t *indices;
    size_t count;
} chosen;

/* A finished case waits here until its predecessors have been reported. */
typedef struct outcome {
    lobe_report report;
    int is_done;
    int has_memory;
} outcome;

typedef struct run {
    const lobe_verify_options *options;
    lobe_verify_summary *summary;
    chosen cases;
    outcome *outcomes;
    size_t reported;
    lobe_settings settings;
    lobe_monitor monitor;
} run;

lobe_verify_options lobe_verify_default_options(void) {
    return (lobe_verify_options){.level = LOBE_VERIFY_QUICK, .seed = 1};
}

static int matches(const char *only, const lobe_reflection_case *c) {
    char name[TITLE_ROOM], configuration[TITLE_ROOM];
    lobe_reflection_subject_name(c->parameters, c->precision, name, sizeof name, configuration,
                                 sizeof configuration);
    char title[2 * TITLE_ROOM], pattern[PATTERN_ROOM];
    snprintf(title, sizeof title, "%s %s", name, configuration);
    snprintf(pattern, sizeof pattern, "*%s*", only);
    return fnmatch(pattern, title, 0) == 0;
}

static int is_chosen(const lobe_verify_options *options, size_t index) {
    lobe_reflection_case c = lobe_reflection_case_at(index);
    if (options->only == NULL) return 1;
    return strlen(options->only) < PATTERN_ROOM - 2 && matches(options->only, &c);
}

size_t lobe_verify_list(const lobe_verify_options *options,
                        void (*on_case)(void *user, const lobe_verify_case *verify_case),
                        void *user) {
    size_t count = 0;
    for (size_t i = 0; i < lobe_reflection_case_count(); ++i) {
        if (!is_chosen(options, i)) continue;
        count += 1;
        if (on_case == NULL) continue;
        lobe_reflection_case c = lobe_reflection_case_at(i);
        char name[TITLE_ROOM], configuration[TITLE_ROOM];
        lobe_reflection_subject_name(c.parameters, c.precision, name, sizeof name, configuration,
                                     sizeof configuration);
        on_case(user, &(lobe_verify_case){name, configuration});
    }
    return count;
}

/* FNV-1a of the names: a case draws the same numbers wherever it stands in the list. */
static uint64_t stream_of(const lobe_verify_model *model) {
    uint64_t hash = 14695981039346656037u;
    const char *texts[2] = {model->name, model->configuration};
    for (int i = 0; i < 2; ++i) {
        for (const char *c = texts[i]; *c != '\0'; ++c) {
            hash = (hash ^ (unsigned char)*c) * 1099511628211u;
        }
    }
    return hash;
}

static void report_case(run *r, size_t position) {
    const lobe_report *report = &r->outcomes[position].report;
    lobe_reflection_case c = lobe_reflection_case_at(r->cases.indices[position]);
    char name[TITLE_ROOM], configuration[TITLE_ROOM];
    lobe_reflection_subject_name(c.parameters, c.precision, name, sizeof name, configuration,
                                 sizeof configuration);
    r->summary->cases += 1;
    for (int i = 0; i < report->count; ++i) {
        const lobe_report_row *row = &report->rows[i];
        int passed = lobe_report_row_passed(row);
        r->summary->tests_passed += passed;
        r->summary->tests_failed += !passed;
        if (r->options->on_test == NULL) continue;
        lobe_verify_test test = {name,           configuration, row->test,  row->detail, row->kind,
                                 row->statistic, row->value,    row->limit, passed};
        r->options->on_test(r->options->user, &test);
    }
}

/* Reports every case that has finished and whose predecessors have. */
static void report_in_order(run *r) {
    while (r->reported < r->cases.count && r->outcomes[r->reported].is_done) {
        report_case(r, r->reported);
        r->reported += 1;
    }
}

static void run_case(run *r, size_t position) {
    lobe_reflection_case c = lobe_reflection_case_at(r->cases.indices[position]);
    lobe_reflection_subject subject;
    lobe_reflection_subject_make(&subject, c.parameters, c.precision);
    lobe_settings settings = r->settings;
    settings.stream = stream_of(&subject.model);
    outcome *o = &r->outcomes[position];
    o->has_memory = lobe_verify_model_run(&subject.model, &settings, &r->monitor, &o->report);
#pragma omp critical(lobe_verify_callback)
    if (o->has_memory && !atomic_load(&r->monitor.is_cancelled)) {
        o->is_done = 1;
        report_in_order(r);
    }
}

/* Threads share out the cases; what a short list leaves over shares out the draws of a case. */
static void run_cases(run *r) {
    int threads = r->options->threads > 0 ? r->options->threads : omp_get_num_procs();
    int outer = r->cases.count < (size_t)threads ? (int)r->cases.count : threads;
    r->settings.threads = threads / outer;
    omp_set_max_active_levels(2);
#pragma omp parallel for schedule(dynamic, 1) num_threads(outer)
    for (size_t i = 0; i < r->cases.count; ++i) {
        if (!atomic_load(&r->monitor.is_cancelled)) run_case(r, i);
    }
}

static lobe_verify_result fail(run *r, lobe_verify_result result, const char *message) {
    snprintf(r->summary->message, sizeof r->summary->message, "%s", message);
    return result;
}

static lobe_verify_result check_options(run *r) {
    const lobe_verify_options *o = r->options;
    if (o->level != LOBE_VERIFY_QUICK && o->level != LOBE_VERIFY_FULL) {
        return fail(r, LOBE_VERIFY_BAD_OPTION, "unknown level; use quick or full");
    }
    if (o->draws != 0 && (o->draws < LEAST_DRAWS || o->draws > MOST_DRAWS)) {
        return fail(r, LOBE_VERIFY_BAD_OPTION, "draws out of range; use 1000 to 10^12");
    }
    if (o->threads < 0 || o->threads > MOST_THREADS) {
        return fail(r, LOBE_VERIFY_BAD_OPTION, "threads out of range; use 0 to 1024");
    }
    return LOBE_VERIFY_OK;
}

static int choose_cases(run *r) {
    size_t room = lobe_reflection_case_count();
    r->cases.indices = malloc(room * sizeof *r->cases.indices);
    if (r->cases.indices == NULL) return 0;
    for (size_t i = 0; i < room; ++i) {
        if (is_chosen(r->options, i)) r->cases.indices[r->cases.count++] = i;
    }
    r->outcomes = calloc(r->cases.count + 1, sizeof *r->outcomes);
    return r->outcomes != NULL;
}

static void set_up(run *r) {
    const lobe_verify_options *o = r->options;
    r->settings = lobe_level_settings(o->level);
    if (o->draws != 0) r->settings.draws = o->draws;
    r->settings.seed = o->seed;
    /* Of the whole list: a verdict does not depend on what else was chosen. */
    size_t tests = LOBE_P_VALUES_A_CASE * lobe_reflection_case_count();
    r->settings.p_limit = lobe_sidak(LOBE_VERIFY_SIGNIFICANCE, tests);
    r->monitor.on_progress = o->on_progress;
    r->monitor.user = o->user;
    r->monitor.total_draws = (double)r->settings.draws * (double)r->cases.count;
}

static lobe_verify_result conclude(run *r) {
    r->summary->draws = atomic_load(&r->monitor.draws);
    for (size_t i = 0; i < r->cases.count; ++i) {
        int is_finished = r->outcomes[i].is_done || atomic_load(&r->monitor.is_cancelled);
        if (!is_finished) return fail(r, LOBE_VERIFY_NO_MEMORY, "out of memory; use fewer threads");
    }
    if (r->reported < r->cases.count) {
        return fail(r, LOBE_VERIFY_CANCELLED, "cancelled; the cases reported had finished");
    }
    return r->summary->tests_failed > 0 ? LOBE_VERIFY_FAILED : LOBE_VERIFY_OK;
}

lobe_verify_result lobe_verify_run(const lobe_verify_options *options,
                                   lobe_verify_summary *summary) {
    *summary = (lobe_verify_summary){0};
    run r = {.options = options, .summary = summary};
    lobe_verify_result result = check_options(&r);
    if (result != LOBE_VERIFY_OK) return result;
    if (!choose_cases(&r)) {
        result = fail(&r, LOBE_VERIFY_NO_MEMORY, "out of memory; close other programs");
    } else if (r.cases.count == 0) {
        result = fail(&r, LOBE_VERIFY_NO_CASES, "no case matches; list them to see their names");
    } else {
        set_up(&r);
        run_cases(&r);
        result = conclude(&r);
    }
    free(r.cases.indices);
    free(r.outcomes);
    return result;
}
