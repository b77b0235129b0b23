/* app/page.h: what the pages that commands write have in common: files that appear whole or not at all, text,
 * colours, pictures. */
#ifndef LOBE_APP_PAGE_H
#define LOBE_APP_PAGE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "report.h"

/* A file that is written beside its final name. */
typedef struct lobe_app_file {
    const char *path;
    char part[4096]; /* where it is written until it is whole */
    FILE *stream;
} lobe_app_file;

/* Reports what is in the way. */
lobe_app_status lobe_app_begin_file(lobe_app_file *file, const char *path);

/* Gives the file its name if it is wanted and nothing went wrong; otherwise removes it. `errno` tells why
 * is_good is false. */
lobe_app_status lobe_app_finish_file(lobe_app_file *file, bool is_wanted, bool is_good);

/* Up to and with <style>: the head of a page whose colours follow the reader's system. */
void lobe_app_begin_html(FILE *file, const char *title, const char *style);

/* "lobe NAME ARGUMENTS", as it was typed; to be freed. NULL: out of memory. */
char *lobe_app_command_line(const char *name, int argc, char **argv);

/* Text with <, >, & and " as entities. */
void lobe_app_write_html(FILE *file, const char *text);

/* A picture of 1, 3 or 4 bytes a pixel as a data URI; false: out of memory. PNG is exact, JPEG small. */
bool lobe_app_write_png_uri(FILE *file, const uint8_t *pixels, int width, int height, int channels);
bool lobe_app_write_jpeg_uri(FILE *file, const uint8_t *pixels, int width, int height);

#endif
