/* app/table.h: rows of numbers on standard output: --format. */
#ifndef LOBE_APP_TABLE_H
#define LOBE_APP_TABLE_H

#include "model.h"

typedef enum lobe_app_format { LOBE_APP_CSV, LOBE_APP_NDJSON, LOBE_APP_F32LE } lobe_app_format;

extern const char *const lobe_app_formats[];

typedef struct lobe_app_table {
    lobe_app_format format;
    lobe_app_precision precision; /* numbers are written with as many digits as it needs */
    const char *const *columns;   /* names, NULL at the end */
} lobe_app_table;

/* Each returns false when standard output does not take any more. */
bool lobe_app_begin_table(const lobe_app_table *table);
bool lobe_app_write_row(const lobe_app_table *table, const double *numbers);

#endif
