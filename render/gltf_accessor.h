/* The bytes of views and the numbers of accessors: the one place that reads what a glTF file points
 * at, and that checks every bound before it does. */
#ifndef LOBE_RENDER_GLTF_ACCESSOR_H
#define LOBE_RENDER_GLTF_ACCESSOR_H

#include "gltf_arrays.h"
#include "lobe/render.h"

typedef struct gltf_reader {
    const gltf_model *model;
    const char *path;
    unsigned char **unpacked; /* of each view, by malloc; NULL: not yet, or it is plain */
} gltf_reader;

/* Most elements that an accessor without bytes of its own may have: guards against counts that lie. */
#define GLTF_EMPTY_COUNT_MAX ((size_t)1 << 24)

/* 0: no memory. */
int lobe_gltf_reader_create(gltf_reader *r, const gltf_model *model, const char *path);
void lobe_gltf_reader_free(gltf_reader *r);

lobe_render_result lobe_gltf_view_bytes(gltf_reader *r, int view, gltf_bytes *bytes);

/* *values: by malloc, to be freed in any case; count * channels. Channels that the accessor lacks are
 * 0, a fourth one is 1. */
lobe_render_result lobe_gltf_read_floats(gltf_reader *r, int accessor, int channels, float **values,
                                         size_t *count);
lobe_render_result lobe_gltf_read_indices(gltf_reader *r, int accessor, uint32_t **values,
                                          size_t *count);

/* The semantics of a primitive that are `wanted`; POSITION always. A primitive without positions has
 * none. To be freed in any case. */
lobe_render_result lobe_gltf_arrays_read(gltf_reader *r, const gltf_primitive *p,
                                         const int wanted[GLTF_SEMANTICS], gltf_arrays *arrays);
void lobe_gltf_arrays_free(gltf_arrays *arrays);

#endif
