/* Where the nodes of a glTF file are at a moment, and how their meshes are bent. */
#ifndef LOBE_RENDER_GLTF_POSE_H
#define LOBE_RENDER_GLTF_POSE_H

#include "affine.h"
#include "gltf_accessor.h"

typedef struct gltf_node_pose {
    double translation[3], rotation[4], scale[3];
    int has_matrix;  /* in place of the three; what is animated has none */
    double *weights; /* of morph targets, by malloc; NULL: those of the file */
    size_t weight_count;
    int parent;      /* -1: none; of several the first */
    int is_repeated; /* has several parents */
    int is_placed;   /* to_world is known */
    affine to_world;
} gltf_node_pose;

typedef struct gltf_pose {
    gltf_node_pose *nodes; /* one a node of the file; by malloc */
    size_t count;
    int *path; /* of node_to_world */
} gltf_pose;

/* `time` in seconds, NaN: at rest. `animation`: a name, "all" for all one after the other, NULL for the first.
 * To be freed in any case. */
lobe_render_result lobe_gltf_pose_create(gltf_pose *pose, gltf_reader *r, const char *animation,
                                         double time);
void lobe_gltf_pose_free(gltf_pose *pose);

/* `node` is one of the file. Its ancestors are finite in number: gltf_file.c has refused circles. */
const affine *lobe_gltf_to_world(gltf_pose *pose, const gltf_model *model, int node);

#endif
