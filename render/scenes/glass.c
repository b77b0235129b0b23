/* `glass`: spheres of glass, smooth to rough, before a chequered wall: solid ones, then a thin-walled one, a
 * tinted and an absorbing one. */
#include "shapes.h"

static uint32_t glass_of(lobe_scene *s, float roughness, float thickness, vec3 color,
                         vec3 absorption) {
    material m = lobe_default_material();
    m.base_color = color;
    m.roughness = roughness;
    m.transmission = 1.0f;
    m.thickness = thickness;
    m.absorption = absorption;
    return lobe_scene_add_material(s, m);
}

static void add_spheres(lobe_scene *s) {
    const float roughnesses[] = {0.0f, 0.2f, 0.35f, 0.5f, 0.7f};
    for (int i = 0; i < 5; i++) {
        uint32_t m = glass_of(s, roughnesses[i], 1.0f, v3_all(1.0f), v3_all(0.0f));
        lobe_shape_sphere(s, m, v3(-2.4f + 1.2f * (float)i, 0.5f, 0.6f), 0.5f, 256);
    }
    uint32_t thin = glass_of(s, 0.0f, 0.0f, v3_all(1.0f), v3_all(0.0f));
    uint32_t frosted = glass_of(s, 0.45f, 0.0f, v3(0.80f, 0.92f, 0.98f), v3_all(0.0f));
    uint32_t amber = glass_of(s, 0.0f, 1.0f, v3_all(1.0f), v3(0.25f, 1.1f, 3.2f));
    uint32_t green = glass_of(s, 0.3f, 1.0f, v3_all(1.0f), v3(2.6f, 0.35f, 1.5f));
    lobe_shape_sphere(s, thin, v3(-1.8f, 0.5f, -0.6f), 0.5f, 256);
    lobe_shape_sphere(s, frosted, v3(-0.6f, 0.5f, -0.6f), 0.5f, 256);
    lobe_shape_sphere(s, amber, v3(0.6f, 0.5f, -0.6f), 0.5f, 256);
    lobe_shape_sphere(s, green, v3(1.8f, 0.5f, -0.6f), 0.5f, 256);
}

/* Squares of two colours. */
static void add_wall(lobe_scene *s) {
    uint32_t colors[2] = {lobe_shape_material(s, v3(0.75f, 0.72f, 0.66f), 0.0f, 0.8f, 0.0f),
                          lobe_shape_material(s, v3(0.10f, 0.16f, 0.24f), 0.0f, 0.8f, 0.0f)};
    const float size = 0.4f;
    for (int i = -20; i < 20; i++)
        for (int k = 0; k < 8; k++)
            lobe_shape_quad(s, colors[(i + k) & 1], v3(size * (float)i, size * (float)k, -2.0f),
                            v3(size, 0.0f, 0.0f), v3(0.0f, size, 0.0f));
}

void lobe_scene_glass(lobe_scene *s) {
    lobe_shape_sky(s);
    uint32_t floor = lobe_shape_material(s, v3(0.34f, 0.33f, 0.31f), 0.0f, 0.5f, 0.0f);
    lobe_shape_quad(s, floor, v3(-900.0f, 0.0f, 900.0f), v3(1800.0f, 0.0f, 0.0f),
                    v3(0.0f, 0.0f, -1800.0f));
    uint32_t lamp = lobe_shape_lamp(s, v3(5.0f, 4.8f, 4.4f));
    lobe_shape_quad(s, lamp, v3(-2.6f, 4.6f, 2.6f), v3(0.0f, 0.0f, -2.4f), v3(3.6f, 0.0f, 0.0f));
    add_wall(s);
    add_spheres(s);
    lobe_scene_add_camera(s, "glass", v3(0.4f, 1.7f, 8.0f), v3(0.0f, 0.65f, 0.0f),
                          v3(0.0f, 1.0f, 0.0f), 26.0f);
}
