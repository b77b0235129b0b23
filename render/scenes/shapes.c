#include "shapes.h"

uint32_t lobe_shape_material(lobe_scene *s, vec3 color, float metallic, float roughness,
                             float anisotropy) {
    material m = lobe_default_material();
    m.base_color = color;
    m.metallic = metallic;
    m.roughness = roughness;
    m.anisotropy = anisotropy;
    return lobe_scene_add_material(s, m);
}

uint32_t lobe_shape_lamp(lobe_scene *s, vec3 radiance) {
    material m = lobe_default_material();
    m.base_color = v3_all(0.0f);
    m.roughness = 1.0f;
    m.emission = radiance;
    return lobe_scene_add_material(s, m);
}

static uint32_t add(lobe_scene *s, vec3 position, vec3 normal, vec3 tangent, float u, float v) {
    return lobe_scene_add_vertex(s, (vertex){.position = position,
                                             .normal = normal,
                                             .tangent = tangent,
                                             .u = u,
                                             .v = v,
                                             .handedness = 1.0f});
}

void lobe_shape_quad(lobe_scene *s, uint32_t material, vec3 corner, vec3 a, vec3 b) {
    vec3 normal = v3_normalize_or(v3_cross(a, b), v3(0.0f, 1.0f, 0.0f));
    vec3 tangent = v3_normalize_or(a, v3_across(normal));
    uint32_t p = add(s, corner, normal, tangent, 0.0f, 1.0f);
    add(s, v3_add(corner, a), normal, tangent, 1.0f, 1.0f);
    add(s, v3_add(v3_add(corner, a), b), normal, tangent, 1.0f, 0.0f);
    add(s, v3_add(corner, b), normal, tangent, 0.0f, 0.0f);
    lobe_scene_add_triangle(s, p, p + 1, p + 2, material);
    lobe_scene_add_triangle(s, p, p + 2, p + 3, material);
}

/* A surface of revolution about +Y: `at` gives radius, height and normal of its outline. */
typedef struct outline_point {
    float radius, height, normal_out, normal_up;
} outline_point;

static void revolve(lobe_scene *s, uint32_t material, vec3 foot, const outline_point *outline,
                    int points, int steps) {
    uint32_t first = s->vertex_count, row = (uint32_t)steps + 1;
    for (int i = 0; i < points; i++)
        for (int k = 0; k <= steps; k++) {
            float angle = 2.0f * LOBE_PI * (float)k / (float)steps;
            float c = cosf(angle), n = sinf(angle);
            const outline_point *p = &outline[i];
            vec3 place = {foot.x + p->radius * c, foot.y + p->height, foot.z - p->radius * n};
            add(s, place, v3(p->normal_out * c, p->normal_up, -p->normal_out * n), v3(-n, 0.0f, -c),
                (float)k / (float)steps, 1.0f - (float)i / (float)(points - 1));
        }
    for (uint32_t i = 0; i + 1 < (uint32_t)points; i++)
        for (uint32_t k = 0; k < (uint32_t)steps; k++) {
            uint32_t a = first + i * row + k, b = a + row;
            lobe_scene_add_triangle(s, a, a + 1, b + 1, material);
            lobe_scene_add_triangle(s, a, b + 1, b, material);
        }
}

void lobe_shape_sphere(lobe_scene *s, uint32_t material, vec3 centre, float radius, int steps) {
    enum { MOST = 129 };
    outline_point outline[MOST];
    int points = steps / 2 + 1 < MOST ? steps / 2 + 1 : MOST;
    for (int i = 0; i < points; i++) {
        float angle = LOBE_PI * ((float)i / (float)(points - 1) - 0.5f);
        float out = i == 0 || i == points - 1 ? 0.0f : cosf(angle), up = sinf(angle);
        outline[i] = (outline_point){radius * out, radius * up, out, up};
    }
    /* the poles' degenerate triangles are not defects of a file */
    uint64_t dropped = s->info.dropped_triangles;
    revolve(s, material, centre, outline, points, steps);
    s->info.dropped_triangles = dropped;
}

void lobe_shape_disk(lobe_scene *s, uint32_t material, vec3 centre, float radius) {
    const outline_point outline[2] = {{radius, 0.0f, 0.0f, 1.0f},
                                      {1e-3f * radius, 0.0f, 0.0f, 1.0f}};
    revolve(s, material, centre, outline, 2, 256);
}

void lobe_shape_cylinder(lobe_scene *s, uint32_t material, vec3 foot, float radius, float height) {
    const outline_point outline[2] = {{radius, 0.0f, 1.0f, 0.0f}, {radius, height, 1.0f, 0.0f}};
    revolve(s, material, foot, outline, 2, 256);
}

static void set_light(lobe_scene *s, int made, image picture) {
    s->has_sky = made && lobe_environment_create(&s->sky, picture, 0.0f);
    s->out_of_memory |= !s->has_sky;
}

void lobe_shape_light(lobe_scene *s, vec3 radiance) {
    image picture;
    int made = lobe_environment_constant(&picture, radiance);
    set_light(s, made, picture);
}

void lobe_shape_sky(lobe_scene *s) {
    image picture;
    int made = lobe_environment_sky(&picture);
    set_light(s, made, picture);
}
