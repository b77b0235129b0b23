/* Primitives of a glTF file as triangles of the scene. */
#ifndef LOBE_RENDER_GLTF_MESH_H
#define LOBE_RENDER_GLTF_MESH_H

#include "gltf_deform.h"
#include "gltf_material.h"

/* 5 and 6 are strips and fans. */
int lobe_gltf_is_made_of_triangles(const gltf_primitive *p);

/* How many it has, as its accessors tell; those without area count. */
size_t lobe_gltf_triangle_count(const gltf_model *m, const gltf_primitive *p);

/* What moves the vertices of a mesh against each other. */
typedef struct gltf_bend {
    const double *weights; /* of the morph targets */
    size_t weight_count;
    const gltf_joints *joints; /* NULL: none; else they place what they hold in the world */
} gltf_bend;

lobe_render_result lobe_gltf_add_primitive(lobe_scene *s, gltf_reader *r, const gltf_primitive *p,
                                           const material_needs *needs, const affine *to_world,
                                           const gltf_bend *bend);

#endif
