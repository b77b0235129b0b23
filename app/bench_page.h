/* app/bench_page.h: the rows of `lobe bench` as a page with bars. */
#ifndef LOBE_APP_BENCH_PAGE_H
#define LOBE_APP_BENCH_PAGE_H

#include <jansson.h>

/* To standard output, one file without references to others. `rows` as in --json. */
void lobe_app_print_bench_page(const char *cpu, double copy_bytes_per_second, const json_t *rows);

#endif
