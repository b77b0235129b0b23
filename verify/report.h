/* What the tests of one case found. Plain bytes without pointers: a report crosses processes and
 * files. */
#ifndef LOBE_VERIFY_REPORT_H
#define LOBE_VERIFY_REPORT_H

#include <lobe/verify.h>

enum { LOBE_REPORT_ROOM = 32 };

typedef struct lobe_report_row {
    char test[16];
    char detail[96];
    int32_t kind; /* lobe_verify_kind */
    int32_t is_known;
    double statistic, value, limit;
} lobe_report_row;

typedef struct lobe_report {
    lobe_report_row rows[LOBE_REPORT_ROOM];
    int32_t count;
    char stage[16]; /* what is under way, for who finds the report of a case that died */
} lobe_report;

void lobe_report_begin(lobe_report *report, const char *stage);

/* The detail is in printf style. */
void lobe_report_p_value(lobe_report *report, const char *test, double statistic, double p,
                         double limit, const char *detail, ...)
    __attribute__((format(printf, 6, 7)));
void lobe_report_error(lobe_report *report, const char *test, double error, double limit,
                       const char *detail, ...) __attribute__((format(printf, 5, 6)));

int lobe_report_row_passed(const lobe_report_row *row);

/* Failures of the tests named in `known_bias` are marked as known. With `is_due` one of them is
 * expected: where none fails, that is a failure of its own. */
void lobe_report_mark_known(lobe_report *report, const char *known_bias, int is_due);

/* Failures that are not known. */
int lobe_report_failures(const lobe_report *report);

/* Makes bytes that anybody may have written a report: terminated texts, counts in range. */
void lobe_report_sanitize(lobe_report *report);

#endif
