/* `brushed`: strongly anisotropic disks and cylinders under the sky. */
#include "shapes.h"

void lobe_scene_brushed(lobe_scene *s) {
    lobe_shape_sky(s);
    uint32_t floor = lobe_shape_material(s, v3(0.16f, 0.17f, 0.19f), 0.0f, 0.6f, 0.0f);
    lobe_shape_quad(s, floor, v3(-900.0f, 0.0f, 900.0f), v3(1800.0f, 0.0f, 0.0f),
                    v3(0.0f, 0.0f, -1800.0f));
    static const vec3 colors[] = {
        {0.91f, 0.92f, 0.92f}, {0.95f, 0.64f, 0.54f}, {0.98f, 0.82f, 0.55f}};
    for (int i = 0; i < 3; i++) {
        float x = -2.2f + 2.2f * (float)i, roughness = 0.45f + 0.15f * (float)i;
        uint32_t around = lobe_shape_material(s, colors[i], 1.0f, roughness, 0.9f);
        uint32_t along = lobe_shape_material(s, colors[i], 1.0f, roughness, -0.9f);
        lobe_shape_cylinder(s, around, v3(x, 0.0f, 0.0f), 0.7f, 1.4f);
        lobe_shape_disk(s, around, v3(x, 1.4f, 0.0f), 0.7f);
        lobe_shape_cylinder(s, along, v3(x + 0.9f, 0.0f, 1.3f), 0.3f, 0.6f);
        lobe_shape_disk(s, along, v3(x + 0.9f, 0.6f, 1.3f), 0.3f);
    }
    lobe_scene_add_camera(s, "brushed", v3(0.6f, 3.2f, 6.4f), v3(0.3f, 0.65f, 0.2f),
                          v3(0.0f, 1.0f, 0.0f), 34.0f);
}
