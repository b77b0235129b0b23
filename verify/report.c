#include "report.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>

static lobe_report_row *add_row(lobe_report *report) {
    assert(report->count < LOBE_REPORT_ROOM);
    return &report->rows[report->count++];
}

void lobe_report_p_value(lobe_report *report, const char *test, double statistic, double p,
                         double limit, const char *detail, ...) {
    lobe_report_row *row = add_row(report);
    *row = (lobe_report_row){.test = test,
                             .kind = LOBE_VERIFY_P_VALUE,
                             .statistic = statistic,
                             .value = p,
                             .limit = limit};
    va_list arguments;
    va_start(arguments, detail);
    vsnprintf(row->detail, sizeof row->detail, detail, arguments);
    va_end(arguments);
}

void lobe_report_error(lobe_report *report, const char *test, double error, double limit,
                       const char *detail, ...) {
    lobe_report_row *row = add_row(report);
    *row = (lobe_report_row){.test = test,
                             .kind = LOBE_VERIFY_ERROR,
                             .statistic = error,
                             .value = error,
                             .limit = limit};
    va_list arguments;
    va_start(arguments, detail);
    vsnprintf(row->detail, sizeof row->detail, detail, arguments);
    va_end(arguments);
}

int lobe_report_row_passed(const lobe_report_row *row) {
    return row->kind == LOBE_VERIFY_P_VALUE ? row->value >= row->limit : row->value <= row->limit;
}
