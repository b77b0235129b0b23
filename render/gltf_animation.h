/* Animations of a glTF file: what their channels say at a moment. */
#ifndef LOBE_RENDER_GLTF_ANIMATION_H
#define LOBE_RENDER_GLTF_ANIMATION_H

#include "gltf_accessor.h"

/* The keys of a channel. */
typedef struct gltf_keys {
    float *times, *values; /* by malloc */
    size_t count, width;   /* width: numbers of a value */
} gltf_keys;

/* To be freed in any case. */
lobe_render_result lobe_gltf_keys_read(gltf_reader *r, const gltf_channel *channel,
                                       gltf_keys *keys);
void lobe_gltf_keys_free(gltf_keys *keys);

/* The value at `time`, in seconds; before the first key and after the last one theirs. `keys` has at least one;
 * `value`: keys->width numbers; rotations: of any length. */
void lobe_gltf_keys_at(const gltf_keys *keys, const gltf_channel *channel, double time,
                       double *value);

#endif
