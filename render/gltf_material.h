/* Materials and textures of a glTF file. */
#ifndef LOBE_RENDER_GLTF_MATERIAL_H
#define LOBE_RENDER_GLTF_MATERIAL_H

#include "gltf_accessor.h"
#include "scene.h"

/* What a mesh must bring for its material. */
typedef struct material_needs {
    uint32_t material; /* index in the scene */
    int uv_sets[2];    /* which of the file's become the vertex's; -1: none */
} material_needs;

/* Every material of the file, and one more for primitives that name none, at index
 * model->material_count. *needs: by malloc. */
lobe_render_result lobe_gltf_read_materials(lobe_scene *s, gltf_reader *r,
                                            const lobe_scene_options *options,
                                            material_needs **needs);

#endif
