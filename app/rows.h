/* app/rows.h: rows of numbers from a file or standard input, separated by commas or blanks. */
#ifndef LOBE_APP_ROWS_H
#define LOBE_APP_ROWS_H

#include <stddef.h>
#include <stdint.h>

#include "report.h"

typedef struct lobe_app_rows {
    const char *name;    /* for error lines */
    const char *columns; /* what a row is, "ox oy oz"; as a first line with commas it is skipped */
    int least, most;     /* numbers in a row */
    int file;
    int ended;
    uint64_t line;
    size_t begin, end; /* of what was read and not yet used */
    char bytes[65536];
} lobe_app_rows;

/* `path` "-" is standard input. */
lobe_app_status lobe_app_open_rows(lobe_app_rows *rows, const char *path, const char *columns,
                                   int least, int most);
void lobe_app_close_rows(lobe_app_rows *rows);

/* Reads the next row; *count is 0 at the end. Blank lines do not count. Flushes standard output
 * before it waits, so that a program at the other end of two pipes gets each answer at once. */
lobe_app_status lobe_app_next_row(lobe_app_rows *rows, double *numbers, int *count);

/* Bad input in the row just read. */
lobe_app_status lobe_app_reject_row(const lobe_app_rows *rows, const char *hint, const char *what);

#endif
