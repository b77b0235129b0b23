#include "report.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void lobe_report_begin(lobe_report *report, const char *stage) {
    snprintf(report->stage, sizeof report->stage, "%s", stage);
}

/* The row counts when it is complete: the process that fills it may end at any point. */
static void add_row(lobe_report *report, const char *test, lobe_report_row row, const char *detail,
                    va_list arguments) {
    assert(report->count < LOBE_REPORT_ROOM);
    snprintf(row.test, sizeof row.test, "%s", test);
    vsnprintf(row.detail, sizeof row.detail, detail, arguments);
    report->rows[report->count] = row;
    report->count += 1;
}

void lobe_report_p_value(lobe_report *report, const char *test, double statistic, double p,
                         double limit, const char *detail, ...) {
    lobe_report_row row = {
        .kind = LOBE_VERIFY_P_VALUE, .statistic = statistic, .value = p, .limit = limit};
    va_list arguments;
    va_start(arguments, detail);
    add_row(report, test, row, detail, arguments);
    va_end(arguments);
}

void lobe_report_error(lobe_report *report, const char *test, double error, double limit,
                       const char *detail, ...) {
    lobe_report_row row = {
        .kind = LOBE_VERIFY_ERROR, .statistic = error, .value = error, .limit = limit};
    va_list arguments;
    va_start(arguments, detail);
    add_row(report, test, row, detail, arguments);
    va_end(arguments);
}

int lobe_report_row_passed(const lobe_report_row *row) {
    return row->kind == LOBE_VERIFY_P_VALUE ? row->value >= row->limit : row->value <= row->limit;
}

/* Whether `name` is one of the words of `names`. */
static int names_it(const char *names, const char *name) {
    size_t length = strlen(name);
    for (const char *at = names; (at = strstr(at, name)) != NULL; at += length) {
        int begins = at == names || at[-1] == ' ';
        if (begins && (at[length] == ' ' || at[length] == '\0')) return 1;
    }
    return 0;
}

void lobe_report_mark_known(lobe_report *report, const char *known_bias, int is_due) {
    int named = 0, failed = 0;
    for (int i = 0; i < report->count; ++i) {
        lobe_report_row *row = &report->rows[i];
        if (!names_it(known_bias, row->test)) continue;
        row->is_known = !lobe_report_row_passed(row);
        named += 1;
        failed += row->is_known;
    }
    if (is_due && named > 0) {
        lobe_report_error(report, "known bias", failed == 0, 0, "%d of %d tests show it", failed,
                          named);
    }
}

int lobe_report_failures(const lobe_report *report) {
    int failures = 0;
    for (int i = 0; i < report->count; ++i) {
        failures += !lobe_report_row_passed(&report->rows[i]) && !report->rows[i].is_known;
    }
    return failures;
}

static void make_text(char *text, size_t size) {
    text[size - 1] = '\0';
    for (char *c = text; *c != '\0'; ++c) {
        if (*c < 0x20 || *c > 0x7e) *c = '?';
    }
}

void lobe_report_sanitize(lobe_report *report) {
    int count = report->count;
    report->count = count < 0 ? 0 : count > LOBE_REPORT_ROOM - 1 ? LOBE_REPORT_ROOM - 1 : count;
    make_text(report->stage, sizeof report->stage);
    for (int i = 0; i < report->count; ++i) {
        lobe_report_row *row = &report->rows[i];
        make_text(row->test, sizeof row->test);
        make_text(row->detail, sizeof row->detail);
        row->kind = row->kind == LOBE_VERIFY_P_VALUE ? LOBE_VERIFY_P_VALUE : LOBE_VERIFY_ERROR;
        row->is_known = row->is_known != 0;
    }
}
