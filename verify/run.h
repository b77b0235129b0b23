/* A run under way: what running, saving and reporting of cases share. */
#ifndef LOBE_VERIFY_RUN_H
#define LOBE_VERIFY_RUN_H

#include "engine.h"
#include "picture.h"
#include "plugin.h"
#include "suite.h"

/* A finished case waits here until its predecessors have been reported. */
typedef struct lobe_outcome {
    lobe_report report;
    lobe_picture *picture; /* NULL: none */
    int is_done;
} lobe_outcome;

typedef struct lobe_run {
    const lobe_verify_options *options;
    lobe_verify_summary *summary;
    lobe_suite suite;
    lobe_plugin_file plugin; /* where options->plugin is given */
    lobe_outcome *outcomes;  /* of the chosen cases */
    size_t reported;
    lobe_settings settings;
    lobe_monitor monitor;
    lobe_verify_result trouble; /* what stopped the run, OK: nothing */
} lobe_run;

const lobe_case_title *lobe_run_title(const lobe_run *run, size_t position);

/* Takes over a finished case: saves the state and reports what is due. One call at a time. */
void lobe_run_finish_case(lobe_run *run, size_t position);

/* Ends the run with a message, "WHAT; HINT" in printf style. */
void lobe_run_stop(lobe_run *run, lobe_verify_result trouble, const char *message, ...)
    __attribute__((format(printf, 3, 4)));

/* Runs what is not done yet: the library's models in threads, those of a plugin in processes. */
void lobe_run_library_cases(lobe_run *run);
void lobe_run_plugin_cases(lobe_run *run);

/* The number of threads or processes to use. */
int lobe_run_threads(const lobe_run *run);

#endif
