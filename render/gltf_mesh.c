#include "gltf_mesh.h"

#include <stdlib.h>

/* Most vertices of a scene: guards against files that unfold without end. */
enum { VERTICES_MAX = 1 << 28 };

int lobe_gltf_is_made_of_triangles(const gltf_primitive *p) {
    return p->mode >= 4 && p->mode <= 6;
}

static size_t triangles_of(const gltf_primitive *p, size_t index_count) {
    if (p->mode == 4) return index_count / 3;
    return index_count < 3 ? 0 : index_count - 2;
}

static size_t triangle_count(const gltf_primitive *p, const gltf_arrays *a) {
    return triangles_of(p, a->index_count);
}

size_t lobe_gltf_triangle_count(const gltf_model *m, const gltf_primitive *p) {
    const int indices = p->indices >= 0 ? p->indices : p->accessors[GLTF_POSITION];
    if (!lobe_gltf_is_made_of_triangles(p) || indices < 0 || (size_t)indices >= m->accessor_count)
        return 0;
    return triangles_of(p, m->accessors[indices].count);
}

/* Corners of a triangle, in the order that faces the viewer; every other one of a strip turns. */
static void corners_of(const gltf_primitive *p, const gltf_arrays *a, size_t i,
                       uint32_t corners[3]) {
    const size_t list[3] = {3 * i, 3 * i + 1, 3 * i + 2}, fan[3] = {i + 1, i + 2, 0};
    const size_t strip[3] = {i, i + 1 + i % 2, i + 2 - i % 2};
    const size_t *places = p->mode == 4 ? list : p->mode == 5 ? strip : fan;
    for (int k = 0; k < 3; k++)
        corners[k] = a->indices ? a->indices[places[k]] : (uint32_t)places[k];
}

static vec3 vec3_at(const float *values, size_t i) {
    const vec3 v = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return v;
}

static vec3 finite_or_zero(vec3 v) {
    return v3_is_finite(v) ? v : v3_all(0.0f);
}

/* ---- Tangents ------------------------------------------------------------------------------------ */

/* Texture coordinates as the map sees them, v upward as normal maps expect. */
static void mapped_uv(const texture_map *map, const float *uv, size_t i, float *u, float *v) {
    const float a = uv[2 * i], b = uv[2 * i + 1];
    *u = map->u[0] * a + map->u[1] * b + map->u[2];
    *v = -(map->v[0] * a + map->v[1] * b + map->v[2]);
}

/* The directions in which u and v grow over a triangle, as long as its area. */
static void tangents_of(const gltf_arrays *a, const texture_map *map, const float *uv,
                        const uint32_t c[3], vec3 *along, vec3 *across) {
    float u[3], v[3];
    for (int k = 0; k < 3; k++) mapped_uv(map, uv, c[k], &u[k], &v[k]);
    const float *p = a->values[GLTF_POSITION];
    const vec3 e1 = v3_sub(vec3_at(p, c[1]), vec3_at(p, c[0]));
    const vec3 e2 = v3_sub(vec3_at(p, c[2]), vec3_at(p, c[0]));
    const float u1 = u[1] - u[0], v1 = v[1] - v[0], u2 = u[2] - u[0], v2 = v[2] - v[0];
    const float turn = u1 * v2 - u2 * v1 < 0.0f ? -1.0f : 1.0f;
    const float area = v3_length(v3_cross(e1, e2));
    const vec3 t = v3_scale(v3_sub(v3_scale(e1, v2), v3_scale(e2, v1)), turn);
    const vec3 b = v3_scale(v3_sub(v3_scale(e2, u1), v3_scale(e1, u2)), turn);
    *along = finite_or_zero(v3_scale(v3_normalize_or(t, v3_all(0.0f)), area));
    *across = finite_or_zero(v3_scale(v3_normalize_or(b, v3_all(0.0f)), area));
}

/* Four floats a vertex, as in the TANGENT of a file: the mean over the triangles at each vertex. NULL:
 * no texture coordinates, or no memory. */
static float *make_tangents(const gltf_primitive *p, const gltf_arrays *a, const texture_map *map,
                            int uv_set) {
    const float *uv =
        uv_set >= 0 && uv_set < GLTF_TEXCOORD_SETS ? a->values[GLTF_TEXCOORD + uv_set] : NULL;
    vec3 *sums = uv ? calloc(a->vertex_count + 1, 2 * sizeof *sums) : NULL;
    float *tangents = sums ? calloc(a->vertex_count + 1, 4 * sizeof *tangents) : NULL;
    for (size_t i = 0; tangents && i < triangle_count(p, a); i++) {
        uint32_t c[3];
        vec3 along, across;
        corners_of(p, a, i, c);
        tangents_of(a, map, uv, c, &along, &across);
        for (int k = 0; k < 3; k++) {
            vec3 *sum = sums + 2 * (size_t)c[k];
            sum[0] = v3_add(sum[0], along);
            sum[1] = v3_add(sum[1], across);
        }
    }
    for (size_t i = 0; tangents && i < a->vertex_count; i++) {
        const float *n = a->values[GLTF_NORMAL];
        const vec3 normal = n ? vec3_at(n, i) : v3_all(0.0f);
        const float side = v3_dot(v3_cross(normal, sums[2 * i]), sums[2 * i + 1]);
        tangents[4 * i] = sums[2 * i].x;
        tangents[4 * i + 1] = sums[2 * i].y;
        tangents[4 * i + 2] = sums[2 * i].z;
        tangents[4 * i + 3] = side < 0.0f ? -1.0f : 1.0f;
    }
    free(sums);
    return tangents;
}

/* ---- Vertices and triangles ---------------------------------------------------------------------- */

static void read_uv(const gltf_arrays *a, int set, size_t i, float *u, float *v) {
    if (set < 0 || set >= GLTF_TEXCOORD_SETS || !a->values[GLTF_TEXCOORD + set]) return;
    *u = a->values[GLTF_TEXCOORD + set][2 * i];
    *v = a->values[GLTF_TEXCOORD + set][2 * i + 1];
}

static vertex vertex_at(const gltf_arrays *a, const material_needs *needs, size_t i,
                        const affine *to_world, const normal_transform *turn) {
    const float *normals = a->values[GLTF_NORMAL], *tangents = a->values[GLTF_TANGENT];
    const float *colors = a->values[GLTF_COLOR];
    vertex v = {.position = lobe_affine_point(to_world, vec3_at(a->values[GLTF_POSITION], i)),
                .handedness = 1.0f};
    if (normals)
        v.normal = finite_or_zero(lobe_affine_direction(&turn->cofactors, vec3_at(normals, i)));
    if (tangents) {
        const vec3 t = {tangents[4 * i], tangents[4 * i + 1], tangents[4 * i + 2]};
        v.tangent = finite_or_zero(lobe_affine_direction(to_world, t));
        v.handedness = (tangents[4 * i + 3] < 0.0f ? -1.0f : 1.0f) * (float)turn->sign;
    }
    read_uv(a, needs->uv_sets[0], i, &v.u, &v.v);
    read_uv(a, needs->uv_sets[1], i, &v.u1, &v.v1);
    for (int c = 0; colors && c < 4; c++)
        v.darkening[c] =
            (uint16_t)(65535.0f * (1.0f - clampf(colors[4 * i + (size_t)c], 0.0f, 1.0f)) + 0.5f);
    return v;
}

static void add_triangles(lobe_scene *s, const gltf_primitive *p, const gltf_arrays *a,
                          uint32_t first, uint32_t material, int is_mirrored) {
    for (size_t i = 0; i < triangle_count(p, a); i++) {
        uint32_t c[3];
        corners_of(p, a, i, c);
        /* a reflection turns what was counter-clockwise */
        lobe_scene_add_triangle(s, first + c[0], first + c[is_mirrored ? 2 : 1],
                                first + c[is_mirrored ? 1 : 2], material);
    }
}

/* Which arrays the material and the bending need. */
static void find_wanted(const lobe_scene *s, const material_needs *needs, const gltf_bend *bend,
                        int wanted[GLTF_SEMANTICS]) {
    const material *m = &s->materials[needs->material];
    for (int i = 0; i < GLTF_SEMANTICS; i++) wanted[i] = i >= GLTF_JOINTS && bend->joints != NULL;
    wanted[GLTF_NORMAL] = wanted[GLTF_COLOR] = 1;
    wanted[GLTF_TANGENT] = m->normal_map.texture != NO_TEXTURE || m->stretch > 0.0f;
    for (int i = 0; i < 2; i++)
        if (needs->uv_sets[i] >= 0 && needs->uv_sets[i] < GLTF_TEXCOORD_SETS)
            wanted[GLTF_TEXCOORD + needs->uv_sets[i]] = 1;
}

/* *to_world becomes what is left to do for the arrays. */
static lobe_render_result bend_arrays(gltf_reader *r, const gltf_primitive *p,
                                      const gltf_bend *bend, gltf_arrays *a, affine *to_world,
                                      int *is_mirrored) {
    lobe_render_result result = lobe_gltf_morph(r, p, bend->weights, bend->weight_count, a);
    if (result != LOBE_RENDER_OK || !bend->joints) return result;
    result = lobe_gltf_skin_arrays(r, bend->joints, to_world, a, is_mirrored);
    *to_world = lobe_affine_identity();
    return result;
}

static void add_arrays(lobe_scene *s, const gltf_primitive *p, gltf_arrays *a,
                       const material_needs *needs, const affine *to_world, int is_mirrored) {
    const normal_transform turn = lobe_affine_normals(to_world);
    const uint32_t first = s->vertex_count;
    for (size_t i = 0; i < a->vertex_count; i++)
        lobe_scene_add_vertex(s, vertex_at(a, needs, i, to_world, &turn));
    add_triangles(s, p, a, first, needs->material, (turn.sign < 0.0) != is_mirrored);
}

lobe_render_result lobe_gltf_add_primitive(lobe_scene *s, gltf_reader *r, const gltf_primitive *p,
                                           const material_needs *needs, const affine *to_world,
                                           const gltf_bend *bend) {
    int wanted[GLTF_SEMANTICS], is_mirrored = 0;
    affine rest = *to_world;
    gltf_arrays a;
    find_wanted(s, needs, bend, wanted);
    lobe_render_result result = lobe_gltf_arrays_read(r, p, wanted, &a);
    if (result == LOBE_RENDER_OK && a.vertex_count > VERTICES_MAX - s->vertex_count)
        result = lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: more than %d vertices; split the scene",
                           r->path, VERTICES_MAX);
    if (result == LOBE_RENDER_OK) result = bend_arrays(r, p, bend, &a, &rest, &is_mirrored);
    if (result == LOBE_RENDER_OK) {
        if (wanted[GLTF_TANGENT] && !a.values[GLTF_TANGENT])
            a.values[GLTF_TANGENT] =
                make_tangents(p, &a, &s->materials[needs->material].normal_map, needs->uv_sets[0]);
        add_arrays(s, p, &a, needs, &rest, is_mirrored);
    }
    lobe_gltf_arrays_free(&a);
    return result;
}
