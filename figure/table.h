/* The numbers of a figure as CSV. */
#ifndef LOBE_FIGURE_TABLE_H
#define LOBE_FIGURE_TABLE_H

#include "bytes.h"

/* `columns`: names with commas between. */
void lobe_table_begin(bytes *t, const char *columns);

/* One row: `labels`, texts with commas between (NULL: none), then numbers in ten digits. */
void lobe_table_row(bytes *t, const char *labels, int count, const double *numbers);

#endif
