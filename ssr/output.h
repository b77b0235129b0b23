/* A file that appears whole or not at all: written beside its name, then renamed. */
#ifndef LOBE_SSR_OUTPUT_H
#define LOBE_SSR_OUTPUT_H

#include <stdio.h>

#include "lobe/ssr.h"

typedef struct ssr_output {
    FILE *file;
    const char *path;
    char temporary[4200];
    int error; /* first errno; 0: none */
} ssr_output;

lobe_ssr_result lobe_ssr_output_open(ssr_output *out, const char *path);
void lobe_ssr_output_write(ssr_output *out, const void *bytes, size_t size);

/* Keeps the file if `is_good` and nothing failed, removes it otherwise. */
lobe_ssr_result lobe_ssr_output_close(ssr_output *out, int is_good);

#endif
