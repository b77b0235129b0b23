/* app/json.h: JSON on standard output. */
#ifndef LOBE_APP_JSON_H
#define LOBE_APP_JSON_H

#include <jansson.h>

#include "report.h"

/* Prints `object` as one line and releases it. NULL, which json_pack gives, means: out of memory. */
lobe_app_status lobe_app_print_json(json_t *object);

/* JSON has no NaN and no infinity: null. */
json_t *lobe_app_json_number(double number);

/* JSON is UTF-8, and a file name need not be: then every byte that is not ASCII becomes '?'. */
json_t *lobe_app_json_text(const char *text);

#endif
