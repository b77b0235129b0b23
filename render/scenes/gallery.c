/* `gallery`: two rows of spheres, metals before coated dielectrics, smooth to rough, the ends brushed,
 * under a soft box and a sky. */
#include "shapes.h"

static void add_metals(lobe_scene *s) {
    static const struct {
        vec3 color;
        float roughness, anisotropy;
    } metals[] = {
        {{0.96f, 0.79f, 0.43f}, 0.12f, 0.0f},  /* gold */
        {{0.95f, 0.64f, 0.54f}, 0.35f, 0.0f},  /* copper */
        {{0.91f, 0.92f, 0.92f}, 0.55f, 0.8f},  /* brushed aluminium */
        {{0.97f, 0.96f, 0.91f}, 0.60f, 0.0f},  /* silver */
        {{0.56f, 0.57f, 0.58f}, 0.85f, 0.0f},  /* iron */
        {{0.98f, 0.82f, 0.55f}, 0.75f, -0.85f} /* brushed brass */
    };
    for (int i = 0; i < 6; i++) {
        uint32_t m = lobe_shape_material(s, metals[i].color, 1.0f, metals[i].roughness,
                                         metals[i].anisotropy);
        lobe_shape_sphere(s, m, v3(-3.0f + 1.2f * (float)i, 0.5f, 0.55f), 0.5f, 192);
    }
}

static void add_dielectrics(lobe_scene *s) {
    static const vec3 colors[] = {
        {0.70f, 0.07f, 0.06f}, {0.06f, 0.26f, 0.50f}, {0.85f, 0.82f, 0.76f}, {0.05f, 0.33f, 0.17f},
        {0.82f, 0.45f, 0.06f}, {0.12f, 0.11f, 0.12f}, {0.36f, 0.18f, 0.44f}};
    for (int i = 0; i < 7; i++) {
        float roughness = 0.04f + 0.14f * (float)i;
        uint32_t m = lobe_shape_material(s, colors[i], 0.0f, roughness, 0.0f);
        lobe_shape_sphere(s, m, v3(-3.6f + 1.2f * (float)i, 0.5f, -0.65f), 0.5f, 192);
    }
}

void lobe_scene_gallery(lobe_scene *s) {
    lobe_shape_sky(s);
    uint32_t floor = lobe_shape_material(s, v3(0.22f, 0.215f, 0.21f), 0.0f, 0.35f, 0.0f);
    lobe_shape_quad(s, floor, v3(-900.0f, 0.0f, 900.0f), v3(1800.0f, 0.0f, 0.0f),
                    v3(0.0f, 0.0f, -1800.0f));
    uint32_t box = lobe_shape_lamp(s, v3(5.0f, 4.8f, 4.4f));
    lobe_shape_quad(s, box, v3(-2.6f, 4.6f, 2.6f), v3(0.0f, 0.0f, -2.4f), v3(3.6f, 0.0f, 0.0f));
    uint32_t plate = lobe_shape_material(s, v3(0.93f, 0.92f, 0.90f), 1.0f, 0.5f, 0.85f);
    lobe_shape_cylinder(s, plate, v3(3.85f, 0.0f, 0.75f), 0.32f, 1.0f);
    lobe_shape_disk(s, plate, v3(3.85f, 1.0f, 0.75f), 0.32f);
    add_metals(s);
    add_dielectrics(s);
    lobe_scene_add_camera(s, "gallery", v3(0.35f, 1.9f, 8.6f), v3(0.3f, 0.55f, 0.0f),
                          v3(0.0f, 1.0f, 0.0f), 32.0f);
}
