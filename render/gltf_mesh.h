/* Primitives of a glTF file as triangles of the scene. */
#ifndef LOBE_RENDER_GLTF_MESH_H
#define LOBE_RENDER_GLTF_MESH_H

#include "gltf_material.h"

/* Rows; applied to a column (x, y, z, 1). */
typedef struct affine {
    double m[3][4];
} affine;

affine lobe_affine_identity(void);
affine lobe_affine_product(const affine *a, const affine *b);

/* Of a node to its parent. */
affine lobe_gltf_node_transform(const gltf_node *node);

vec3 lobe_affine_point(const affine *t, vec3 p);
vec3 lobe_affine_direction(const affine *t, vec3 d);

/* 5 and 6 are strips and fans. */
int lobe_gltf_is_made_of_triangles(const gltf_primitive *p);

lobe_render_result lobe_gltf_add_primitive(lobe_scene *s, gltf_reader *r, const gltf_primitive *p,
                                           const material_needs *needs, const affine *to_world);

#endif
