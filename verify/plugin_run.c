/* The cases of a plugin: each in a process of its own, as many at a time as there are threads. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "child.h"
#include "run.h"

static const double QUICK_SECONDS = 20;
static const double FULL_SECONDS = 1800;

/* What a process and this one share. */
typedef struct shared {
    lobe_report report;
    lobe_picture picture;
    lobe_monitor monitor; /* the draws that the process has counted */
    char message[512];
    int is_complete, has_memory;
} shared;

/* A place for one process, and what it is told. */
typedef struct place {
    lobe_child child;
    shared *shared;
    const lobe_run *run;
    size_t position;
} place;

static void run_case(void *task) {
    const place *p = task;
    const lobe_run *run = p->run;
    shared *s = p->shared;
    lobe_report_begin(&s->report, "loading");
    const lobe_plugin *plugin =
        lobe_plugin_load(run->options->plugin, s->message, sizeof s->message);
    if (plugin == NULL) return;
    lobe_plugin_subject subject;
    lobe_plugin_subject_make(&subject, plugin, run->suite.chosen[p->position]);
    lobe_settings settings = run->settings;
    settings.threads = 1;
    settings.stream = lobe_title_stream(lobe_run_title(run, p->position));
    s->has_memory =
        lobe_verify_model_run(&subject.model, &settings, &s->monitor, &s->report, &s->picture);
    s->is_complete = 1;
}

static double case_seconds(const lobe_run *run) {
    if (run->options->case_seconds > 0) return run->options->case_seconds;
    return run->options->level == LOBE_VERIFY_FULL ? FULL_SECONDS : QUICK_SECONDS;
}

static int start_case(place *p, size_t position) {
    memset(p->shared, 0, sizeof *p->shared);
    p->position = position;
    return lobe_child_start(&p->child, run_case, p, case_seconds(p->run));
}

/* The tests that the process finished count; that it did not finish is a test of its own. */
static void add_survival(place *p, const char *cause) {
    shared *s = p->shared;
    int is_complete = s->is_complete && *cause == '\0';
    if (is_complete && s->has_memory) {
        lobe_report_error(&s->report, "survival", 0, 0, "ended by itself");
        return;
    }
    s->message[sizeof s->message - 1] = '\0';
    const char *what = *cause != '\0' ? cause
                       : is_complete  ? "out of memory"
                       : *s->message  ? "could not be loaded again"
                                      : "exited";
    if (s->report.count >= LOBE_REPORT_ROOM) s->report.count = LOBE_REPORT_ROOM - 1;
    lobe_report_error(&s->report, "survival", 1, 0, "%s, during: %s", what, s->report.stage);
}

static int take_picture(lobe_outcome *outcome, const shared *s) {
    int sheets = s->picture.sheets;
    if (!s->is_complete || (sheets != 1 && sheets != 2)) return 1;
    outcome->picture = malloc(sizeof *outcome->picture);
    if (outcome->picture == NULL) return 0;
    *outcome->picture = s->picture;
    return 1;
}

static void finish_case(lobe_run *run, place *p, const char *cause) {
    lobe_report_sanitize(&p->shared->report);
    add_survival(p, cause);
    lobe_outcome *outcome = &run->outcomes[p->position];
    outcome->report = p->shared->report;
    if (!take_picture(outcome, p->shared)) {
        lobe_run_stop(run, LOBE_VERIFY_NO_MEMORY, "out of memory; close other programs");
        return;
    }
    lobe_run_finish_case(run, p->position);
}

/* Starts the next case that is to do in a free place. */
static void fill_place(lobe_run *run, place *p, size_t *next) {
    while (*next < run->suite.chosen_count && run->outcomes[*next].is_done) *next += 1;
    if (*next == run->suite.chosen_count) return;
    if (start_case(p, *next)) {
        *next += 1;
    } else {
        lobe_run_stop(run, LOBE_VERIFY_NO_MEMORY,
                      "no process for the plugin; close other programs");
    }
}

/* Draws of all processes, those under way included. */
static void show_progress(lobe_run *run, const place *places, int count, uint64_t finished) {
    uint64_t draws = finished;
    for (int i = 0; i < count; ++i) {
        if (places[i].child.pid != 0) draws += atomic_load(&places[i].shared->monitor.draws);
    }
    uint64_t before = atomic_load(&run->monitor.draws);
    lobe_monitor_advance(&run->monitor, draws > before ? draws - before : 0);
}

static void run_in_places(lobe_run *run, place *places, int count) {
    size_t next = 0;
    uint64_t finished = 0;
    int under_way = 1;
    while (under_way > 0 && !atomic_load(&run->monitor.is_cancelled)) {
        under_way = 0;
        for (int i = 0; i < count; ++i) {
            place *p = &places[i];
            char cause[64];
            if (p->child.pid != 0 && lobe_child_has_ended(&p->child, cause, sizeof cause)) {
                finished += run->settings.draws;
                finish_case(run, p, cause);
            }
            if (p->child.pid == 0) fill_place(run, p, &next);
            under_way += p->child.pid != 0;
        }
        show_progress(run, places, count, finished);
        if (under_way > 0) lobe_child_pause();
    }
}

void lobe_run_plugin_cases(lobe_run *run) {
    int count = lobe_run_threads(run);
    if ((size_t)count > run->suite.chosen_count) count = (int)run->suite.chosen_count;
    place *places = calloc((size_t)count, sizeof *places);
    int is_good = places != NULL;
    for (int i = 0; i < count && is_good; ++i) {
        places[i].run = run;
        places[i].shared = lobe_shared_make(sizeof *places[i].shared);
        is_good = places[i].shared != NULL;
    }
    if (is_good) {
        run_in_places(run, places, count);
    } else {
        lobe_run_stop(run, LOBE_VERIFY_NO_MEMORY, "out of memory; use fewer threads");
    }
    for (int i = 0; i < count && places != NULL; ++i) {
        lobe_child_end(&places[i].child);
        lobe_shared_free(places[i].shared, sizeof *places[i].shared);
    }
    free(places);
}
