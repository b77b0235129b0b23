/* Files that appear whole or not at all: written beside the final name, then renamed. */
#ifndef LOBE_RENDER_OUTPUT_H
#define LOBE_RENDER_OUTPUT_H

#include <stdio.h>

#include "lobe/render.h"

typedef struct output {
    FILE *file;
    const char *path; /* final name, not owned */
    char *temporary;  /* NULL: a device or pipe, written in place */
    int is_durable;   /* on the disk before it is renamed */
    int error;        /* first errno of a failed write; 0: none */
} output;

lobe_render_result lobe_output_open(output *out, const char *path);

/* The same for what has to outlive a failing machine. The name beside is always the same, so that a process that was
 * killed leaves one file at most, and the next one takes it. */
lobe_render_result lobe_output_open_durable(output *out, const char *path);

/* Keep the first error, so that callers need not check every write. */
void lobe_output_write(output *out, const void *data, size_t size);

/* End: rename if all went well and `result` is LOBE_RENDER_OK, otherwise remove. Returns `result` or
 * the error of the file. */
lobe_render_result lobe_output_close(output *out, lobe_render_result result);

#endif
