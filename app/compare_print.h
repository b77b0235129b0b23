/* app/compare_print.h: a comparison as a table, and as JSON. */
#ifndef LOBE_APP_COMPARE_PRINT_H
#define LOBE_APP_COMPARE_PRINT_H

#include <jansson.h>

#include "comparison.h"

void lobe_app_print_comparison(const lobe_app_comparison *c);

/* NULL: out of memory. */
json_t *lobe_app_json_comparison(const lobe_app_comparison *c);

#endif
