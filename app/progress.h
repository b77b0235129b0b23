/* app/progress.h: how far long work is, on standard error. */
#ifndef LOBE_APP_PROGRESS_H
#define LOBE_APP_PROGRESS_H

#include <stdbool.h>

#include "options.h"

typedef enum lobe_app_progress_mode {
    LOBE_APP_PROGRESS_AUTO, /* a bar on a terminal, nothing elsewhere */
    LOBE_APP_PROGRESS_ALWAYS,
    LOBE_APP_PROGRESS_NEVER,
    LOBE_APP_PROGRESS_JSON /* one object a line */
} lobe_app_progress_mode;

extern const char *const lobe_app_progress_modes[];

/* A row of a table of options; MEMBER is the int that receives the lobe_app_progress_mode. */
#define LOBE_APP_PROGRESS_OPTION(TYPE, MEMBER)                                                     \
    {                                                                                              \
        "--progress", "MODE", "auto", "progress bar on standard error; auto: on a terminal",       \
            lobe_app_read_choice, offsetof(TYPE, MEMBER), lobe_app_progress_modes                  \
    }

typedef struct lobe_app_progress {
    const char *label;
    const char *unit; /* of the work done: "rows", "samples" */
    lobe_app_progress_mode mode;
    double start;
    double shown;                        /* when a line was printed last */
    double fraction_before, work_before; /* done in an earlier run: no part of the rate */
} lobe_app_progress;

lobe_app_progress lobe_app_begin_progress(int mode, const char *label, const char *unit);

/* Call as often as you like: prints a few times a second. `work` is in units; `fraction` of the whole
 * in [0, 1], negative if the whole is not known. */
void lobe_app_show_progress(lobe_app_progress *progress, double fraction, double work);

/* Removes the bar. */
void lobe_app_end_progress(lobe_app_progress *progress);

/* Seconds of a clock that only goes forward. */
double lobe_app_seconds(void);

#endif
