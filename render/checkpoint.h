/* A picture in the making as a file: written beside the final name, on the disk before it is renamed, with a hash
 * over all of it. */
#ifndef LOBE_RENDER_CHECKPOINT_H
#define LOBE_RENDER_CHECKPOINT_H

#include "film.h"

/* What the work has cost so far. */
typedef struct checkpoint_cost {
    uint64_t rays;
    double seconds, cpu_seconds;
} checkpoint_cost;

lobe_render_result lobe_checkpoint_write(const char *path, const lobe_film *film,
                                         checkpoint_cost cost);

/* *film is NULL unless all of the file is there and unchanged. */
lobe_render_result lobe_checkpoint_read(const char *path, lobe_film **film, checkpoint_cost *cost);

/* Whether there is a file that could be lost by writing a checkpoint of this name, because it is something else. */
int lobe_checkpoint_would_destroy(const char *path);

/* Whether the file begins as a checkpoint does. */
int lobe_checkpoint_is_one(const char *path);

#endif
