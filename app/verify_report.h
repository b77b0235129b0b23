/* app/verify_report.h: `lobe verify --report`: everything that a run found, as one page that needs
 * nothing else: no network, no scripts. */
#ifndef LOBE_APP_VERIFY_REPORT_H
#define LOBE_APP_VERIFY_REPORT_H

#include <stdio.h>

#include <lobe/verify.h>

#include "page.h"

/* A text that grows. */
typedef struct lobe_app_text {
    char *bytes;
    size_t size;
    FILE *stream; /* NULL: none, or no memory */
} lobe_app_text;

typedef struct lobe_app_page {
    const char *path; /* NULL: no page is wanted */
    lobe_app_file file;
    lobe_app_text rows, failures, cases; /* made while the run goes on */
    lobe_app_text tests;                 /* of the present case */
    int pictures, left_out;
    char model[64], configuration[256]; /* of the last row */
} lobe_app_page;

/* What stands in the head of the page. */
typedef struct lobe_app_page_head {
    const char *plugin; /* NULL: the library's own models */
    const char *only;
    const char *level;
    uint64_t seed, draws; /* draws: 0: those of the level */
} lobe_app_page_head;

/* Opens the temporary file: what cannot be written shall not be noticed after an hour. */
lobe_app_status lobe_app_begin_page(lobe_app_page *page, const char *path);

void lobe_app_add_test(lobe_app_page *page, const lobe_verify_test *test);
void lobe_app_add_picture(lobe_app_page *page, const lobe_verify_picture *picture);

/* Writes the page and gives it its name; without `summary` it is dropped. */
lobe_app_status lobe_app_finish_page(lobe_app_page *page, const lobe_app_page_head *head,
                                     const lobe_verify_summary *summary);

#endif
