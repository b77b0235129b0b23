/* app/report.h: exit statuses and error lines, the same for every command. */
#ifndef LOBE_APP_REPORT_H
#define LOBE_APP_REPORT_H

typedef enum lobe_app_status {
    LOBE_APP_DONE = 0,
    LOBE_APP_FAILED = 1,       /* while running: file, memory, device */
    LOBE_APP_BAD_INPUT = 2,    /* bad usage or bad input */
    LOBE_APP_NOT_HELD = 3,     /* a verification or comparison did not hold */
    LOBE_APP_INTERRUPTED = 130 /* what was finished is saved */
} lobe_app_status;

/* Prints `lobe: WHERE: WHAT; HINT` as one line, whatever bytes the arguments hold. */
void lobe_app_report(const char *where, const char *hint, const char *what, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for bad usage and bad input; returns LOBE_APP_BAD_INPUT. */
lobe_app_status lobe_app_reject(const char *where, const char *hint, const char *what, ...)
    __attribute__((format(printf, 3, 4)));

/* Prints `lobe: MESSAGE` as one line; `message` has the three parts already. */
void lobe_app_report_line(const char *message);

/* The one of `names` (NULL at the end) that is most like `name`, NULL if none is. */
const char *lobe_app_nearest(const char *name, const char *const *names);

#endif
