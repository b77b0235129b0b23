/* The arrays of a primitive, out of accessors or a Draco buffer, as floats and checked. */
#ifndef LOBE_RENDER_GLTF_ARRAYS_H
#define LOBE_RENDER_GLTF_ARRAYS_H

#include <stdint.h>

#include "gltf_model.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gltf_arrays {
    size_t vertex_count, index_count;
    uint32_t *indices;             /* below vertex_count; NULL: the vertices in their order */
    float *values[GLTF_SEMANTICS]; /* NULL: absent */
} gltf_arrays;                     /* all by malloc */

/* Floats a vertex. Colours without alpha get an alpha of 1. */
extern const int lobe_gltf_channels[GLTF_SEMANTICS];

#ifdef __cplusplus
}
#endif

#endif
