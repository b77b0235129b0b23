/* `normal-mapped`: a rough metal wall with a strong normal map, seen at an angle: many shading normals
 * face away from the viewer, as in the experiment of Tokuyoshi 2021. */
#include <stdlib.h>

#include "shapes.h"

/* Height of round tiles with cross grooves; its slope makes the map. */
static float height_at(float u, float v) {
    float x = sinf(2.0f * LOBE_PI * 8.0f * u), y = sinf(2.0f * LOBE_PI * 6.0f * v);
    float ripple = sinf(2.0f * LOBE_PI * (17.0f * u + 11.0f * v));
    return 0.035f * x * y + 0.006f * ripple;
}

static int make_map(texture *t) {
    enum { SIZE = 512 };
    unsigned char *rgb = malloc(3 * SIZE * SIZE);
    if (!rgb) return 0;
    const float step = 0.5f / SIZE;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            float u = ((float)x + 0.5f) / SIZE, v = ((float)y + 0.5f) / SIZE;
            float du = (height_at(u + step, v) - height_at(u - step, v)) / (2.0f * step);
            float dv = (height_at(u, v + step) - height_at(u, v - step)) / (2.0f * step);
            vec3 n = v3_normalize_or(v3(-du, dv, 1.0f), v3(0.0f, 0.0f, 1.0f));
            unsigned char *c = rgb + 3 * (y * SIZE + x);
            c[0] = (unsigned char)(127.5f * n.x + 128.0f);
            c[1] = (unsigned char)(127.5f * n.y + 128.0f);
            c[2] = (unsigned char)(127.5f * n.z + 128.0f);
        }
    *t = (texture){SIZE, SIZE, 3, 0, .texels = rgb};
    return 1;
}

void lobe_scene_normal_mapped(lobe_scene *s) {
    lobe_shape_sky(s);
    texture map;
    material wall = lobe_default_material();
    wall.base_color = v3(0.95f, 0.80f, 0.62f);
    wall.metallic = 1.0f;
    wall.roughness = 0.6f;
    if (make_map(&map)) wall.normal_map.texture = lobe_scene_add_texture(s, map);
    s->out_of_memory |= wall.normal_map.texture == NO_TEXTURE;
    uint32_t m = lobe_scene_add_material(s, wall);
    lobe_shape_quad(s, m, v3(-4.0f, 0.0f, 0.0f), v3(8.0f, 0.0f, 0.0f), v3(0.0f, 4.0f, 0.0f));
    uint32_t floor = lobe_shape_material(s, v3_all(0.35f), 0.0f, 0.7f, 0.0f);
    lobe_shape_quad(s, floor, v3(-900.0f, 0.0f, 900.0f), v3(1800.0f, 0.0f, 0.0f),
                    v3(0.0f, 0.0f, -1800.0f));
    lobe_scene_add_camera(s, "normal-mapped", v3(-5.2f, 2.2f, 2.4f), v3(0.2f, 1.7f, 0.0f),
                          v3(0.0f, 1.0f, 0.0f), 40.0f);
}
