/* What the tests of one case found. */
#ifndef LOBE_VERIFY_REPORT_H
#define LOBE_VERIFY_REPORT_H

#include <lobe/verify.h>

enum { LOBE_REPORT_ROOM = 32 };

typedef struct lobe_report_row {
    const char *test;
    char detail[96];
    lobe_verify_kind kind;
    double statistic, value, limit;
} lobe_report_row;

typedef struct lobe_report {
    lobe_report_row rows[LOBE_REPORT_ROOM];
    int count;
} lobe_report;

/* The detail is in printf style. */
void lobe_report_p_value(lobe_report *report, const char *test, double statistic, double p,
                         double limit, const char *detail, ...)
    __attribute__((format(printf, 6, 7)));
void lobe_report_error(lobe_report *report, const char *test, double error, double limit,
                       const char *detail, ...) __attribute__((format(printf, 5, 6)));

int lobe_report_row_passed(const lobe_report_row *row);

#endif
