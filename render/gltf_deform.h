/* Meshes that are bent: morph targets and skins. */
#ifndef LOBE_RENDER_GLTF_DEFORM_H
#define LOBE_RENDER_GLTF_DEFORM_H

#include "gltf_pose.h"

/* Adds the targets of `p` to its positions, normals and tangents by their weights, missing ones 0. */
lobe_render_result lobe_gltf_morph(gltf_reader *r, const gltf_primitive *p, const double *weights,
                                   size_t weight_count, gltf_arrays *arrays);

/* The joints of a skin: from where a vertex was bound to the world. */
typedef struct gltf_joints {
    affine *to_world; /* by malloc */
    size_t count;
} gltf_joints;

/* To be freed in any case. */
lobe_render_result lobe_gltf_joints_read(gltf_reader *r, gltf_pose *pose, int skin,
                                         gltf_joints *joints);
void lobe_gltf_joints_free(gltf_joints *joints);

/* Moves positions, normals and tangents into the world. What no joint holds is placed by `to_world`. *is_mirrored:
 * the triangles have turned round. */
lobe_render_result lobe_gltf_skin_arrays(const gltf_reader *r, const gltf_joints *joints,
                                         const affine *to_world, gltf_arrays *arrays,
                                         int *is_mirrored);

#endif
