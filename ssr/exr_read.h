/* Named channels out of an OpenEXR file, straight into arrays. */
#ifndef LOBE_SSR_EXR_READ_H
#define LOBE_SSR_EXR_READ_H

#include "lobe/ssr.h"

typedef struct ssr_wanted {
    const char *name;
    float *values; /* the first pixel's, */
    int stride;    /* the next is so many floats on */
    int is_needed;
    int is_there; /* in the file: set by the call */
} ssr_wanted;

/* Fails if a channel that is needed is not there, or anything cannot be read. `key`: as lobe_ssr_read_exr. */
lobe_ssr_result lobe_ssr_read_channels(const char *path, int width, int height, ssr_wanted *wanted,
                                       int count, const char *key);

#endif
