/* KHR_draco_mesh_compression, by libdraco. */
#ifndef LOBE_RENDER_GLTF_DRACO_H
#define LOBE_RENDER_GLTF_DRACO_H

#include "gltf_arrays.h"

#ifdef __cplusplus
extern "C" {
#endif

/* `ids`: the attribute of each semantic, -1 for none. 0: damaged, or no memory; what is in `arrays` is
 * to be freed in any case. Indices are not checked. */
int lobe_gltf_draco_decode(gltf_bytes packed, const int ids[GLTF_SEMANTICS], gltf_arrays *arrays);

#ifdef __cplusplus
}
#endif

#endif
