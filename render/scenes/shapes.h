/* Shapes for the scenes that are made in code. */
#ifndef LOBE_RENDER_SCENES_SHAPES_H
#define LOBE_RENDER_SCENES_SHAPES_H

#include "../scene.h"

uint32_t lobe_shape_material(lobe_scene *s, vec3 color, float metallic, float roughness,
                             float anisotropy);
uint32_t lobe_shape_lamp(lobe_scene *s, vec3 radiance);

/* Parallelogram corner, corner + a, corner + a + b, corner + b; its front is along a x b. */
void lobe_shape_quad(lobe_scene *s, uint32_t material, vec3 corner, vec3 a, vec3 b);

/* Tangents run around the axis +Y. */
void lobe_shape_sphere(lobe_scene *s, uint32_t material, vec3 centre, float radius, int steps);

/* Lying disk that faces +Y, brushed in circles. */
void lobe_shape_disk(lobe_scene *s, uint32_t material, vec3 centre, float radius);

/* Standing cylinder, brushed around. */
void lobe_shape_cylinder(lobe_scene *s, uint32_t material, vec3 foot, float radius, float height);

/* One function a scene; see lobe_builtin_scene_name. */
void lobe_scene_gallery(lobe_scene *s);
void lobe_scene_furnace(lobe_scene *s);
void lobe_scene_brushed(lobe_scene *s);
void lobe_scene_normal_mapped(lobe_scene *s);
void lobe_scene_cornell(lobe_scene *s);
void lobe_scene_glass(lobe_scene *s);

/* Light of one colour from everywhere, or a clear sky. */
void lobe_shape_light(lobe_scene *s, vec3 radiance);
void lobe_shape_sky(lobe_scene *s);

#endif
