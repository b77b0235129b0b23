/* The arrays that the page sees, and where they are. */
#include "page.h"

#include <stddef.h>

float page_numbers[3][ROWS];
float page_query[3][ROWS];
float page_answer[2][ROWS];
float page_curve[4][CURVE];
double page_result[16];
rows page_rows[METHODS];

/* The library asks the environment for an instruction set; a page has none. */
char *getenv(const char *name);
char *getenv(const char *name) {
    (void)name;
    return NULL;
}

EXPORT(rows_at_most) int page_rows_at_most(void);
int page_rows_at_most(void) {
    return ROWS;
}

EXPORT(numbers_at) float *page_numbers_at(void);
float *page_numbers_at(void) {
    return page_numbers[0];
}

EXPORT(query_at) float *page_query_at(void);
float *page_query_at(void) {
    return page_query[0];
}

EXPORT(answer_at) float *page_answer_at(void);
float *page_answer_at(void) {
    return page_answer[0];
}

/* Four arrays of curve_at_most() numbers. */
EXPORT(curve_at) float *page_curve_at(void);
float *page_curve_at(void) {
    return page_curve[0];
}

EXPORT(curve_at_most) int page_curve_at_most(void);
int page_curve_at_most(void) {
    return CURVE;
}

EXPORT(result_at) double *page_result_at(void);
double *page_result_at(void) {
    return page_result;
}

/* Ten arrays of rows_at_most() numbers: m, wo (three each), cos_im, pdf_m, pdf, weight. */
EXPORT(draws_at) float *page_draws_at(int method);
float *page_draws_at(int method) {
    return page_rows[method].m[0];
}
