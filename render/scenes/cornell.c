/* `cornell`: a closed box with a lamp, a rough metal block and a coated sphere. */
#include "shapes.h"

/* A quad of the ceiling, from (x0, z0) to (x1, z1). */
static void add_overhead(lobe_scene *s, uint32_t m, float x0, float z0, float x1, float z1) {
    lobe_shape_quad(s, m, v3(x0, 2.0f, z0), v3(x1 - x0, 0.0f, 0.0f), v3(0.0f, 0.0f, z1 - z0));
}

/* The lamp lies in a hole of the ceiling. Surfaces shine on both sides: the back of a lamp below the
 * ceiling would light a small bright patch, which only chance finds. */
static void add_ceiling(lobe_scene *s, uint32_t white) {
    const float edge = 0.3f;
    add_overhead(s, white, -1.0f, -1.0f, 1.0f, -edge);
    add_overhead(s, white, -1.0f, edge, 1.0f, 3.4f);
    add_overhead(s, white, -1.0f, -edge, -edge, edge);
    add_overhead(s, white, edge, -edge, 1.0f, edge);
    uint32_t lamp = lobe_shape_lamp(s, v3(22.0f, 16.5f, 9.0f));
    add_overhead(s, lamp, -edge, -edge, edge, edge);
}

static void add_walls(lobe_scene *s) {
    uint32_t white = lobe_shape_material(s, v3(0.73f, 0.73f, 0.71f), 0.0f, 1.0f, 0.0f);
    uint32_t red = lobe_shape_material(s, v3(0.63f, 0.06f, 0.05f), 0.0f, 1.0f, 0.0f);
    uint32_t green = lobe_shape_material(s, v3(0.12f, 0.45f, 0.09f), 0.0f, 1.0f, 0.0f);
    const vec3 x = {2.0f, 0.0f, 0.0f}, y = {0.0f, 2.0f, 0.0f}, z = {0.0f, 0.0f, 2.0f};
    const vec3 corner = {-1.0f, 0.0f, -1.0f};
    lobe_shape_quad(s, white, corner, z, x);
    add_ceiling(s, white);
    lobe_shape_quad(s, white, corner, x, y);
    lobe_shape_quad(s, white, v3_add(corner, v3_scale(z, 2.2f)), y, x);
    lobe_shape_quad(s, red, corner, y, v3_scale(z, 2.2f));
    lobe_shape_quad(s, green, v3_add(corner, x), v3_scale(z, 2.2f), y);
    lobe_shape_quad(s, white, v3_add(corner, z), v3_scale(z, 1.2f), x);
}

static void add_block(lobe_scene *s, uint32_t m, vec3 foot, float size, float height, float turn) {
    vec3 a = {size * cosf(turn), 0.0f, -size * sinf(turn)};
    vec3 b = {size * sinf(turn), 0.0f, size * cosf(turn)}, up = {0.0f, height, 0.0f};
    lobe_shape_quad(s, m, v3_add(foot, up), b, a);
    lobe_shape_quad(s, m, v3_add(foot, b), a, up);
    lobe_shape_quad(s, m, foot, up, a);
    lobe_shape_quad(s, m, foot, b, up);
    lobe_shape_quad(s, m, v3_add(foot, a), up, b);
}

void lobe_scene_cornell(lobe_scene *s) {
    add_walls(s);
    uint32_t metal = lobe_shape_material(s, v3(0.95f, 0.78f, 0.55f), 1.0f, 0.45f, 0.0f);
    add_block(s, metal, v3(-0.75f, 0.0f, -0.55f), 0.6f, 1.15f, 0.3f);
    uint32_t coated = lobe_shape_material(s, v3(0.20f, 0.35f, 0.65f), 0.0f, 0.2f, 0.0f);
    lobe_shape_sphere(s, coated, v3(0.42f, 0.38f, 0.25f), 0.38f, 192);
    lobe_scene_add_camera(s, "cornell", v3(0.0f, 1.0f, 3.3f), v3(0.0f, 1.0f, 0.0f),
                          v3(0.0f, 1.0f, 0.0f), 46.0f);
}
