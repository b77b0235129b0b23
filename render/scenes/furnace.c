/* `furnace`: a white sphere in white light. A white dielectric reflects all light at any roughness
 * (render/material.h): where the renderer is right, nothing is to be seen. */
#include "shapes.h"

void lobe_scene_furnace(lobe_scene *s) {
    lobe_shape_light(s, v3_all(0.5f));
    uint32_t white = lobe_shape_material(s, v3_all(1.0f), 0.0f, 0.5f, 0.0f);
    lobe_shape_sphere(s, white, v3_all(0.0f), 1.0f, 256);
    lobe_scene_add_camera(s, "furnace", v3(0.0f, 0.0f, 5.0f), v3_all(0.0f), v3(0.0f, 1.0f, 0.0f),
                          32.0f);
}
