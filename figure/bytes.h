/* Bytes that grow in memory, then become a file: whole, or not at all. */
#ifndef LOBE_FIGURE_BYTES_H
#define LOBE_FIGURE_BYTES_H

#include <stddef.h>

typedef struct bytes {
    char *data;
    size_t size, room;
    int failed; /* out of memory, now or before */
} bytes;

void lobe_bytes_add(bytes *b, const void *data, size_t size);
void lobe_bytes_free(bytes *b);

/* Writes beside the final name, then renames; a device or a pipe is written in place. 0, or errno. */
int lobe_bytes_save(const bytes *b, const char *path);

#endif
