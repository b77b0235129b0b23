#include "gltf_deform.h"

#include <stdlib.h>

#include "message.h"

/* ---- Morph targets ------------------------------------------------------------------------------- */

static lobe_render_result add_target(gltf_reader *r, int accessor, int semantic, double weight,
                                     gltf_arrays *a) {
    float *values = NULL;
    size_t count = 0;
    lobe_render_result result = lobe_gltf_read_floats(r, accessor, 3, &values, &count);
    if (result == LOBE_RENDER_OK && count != a->vertex_count)
        result = lobe_fail(LOBE_RENDER_BAD_INPUT,
                           "%s: accessor %d has %zu elements for %zu positions; is it damaged?",
                           r->path, accessor, count, a->vertex_count);
    const size_t stride = (size_t)lobe_gltf_channels[semantic];
    for (size_t i = 0; result == LOBE_RENDER_OK && i < count; i++)
        for (size_t c = 0; c < 3; c++)
            a->values[semantic][stride * i + c] += (float)(weight * (double)values[3 * i + c]);
    free(values);
    return result;
}

lobe_render_result lobe_gltf_morph(gltf_reader *r, const gltf_primitive *p, const double *weights,
                                   size_t weight_count, gltf_arrays *a) {
    lobe_render_result result = LOBE_RENDER_OK;
    for (size_t i = 0; i < p->target_count && i < weight_count; i++)
        for (int s = 0; s < GLTF_MORPHED && weights[i] != 0.0; s++) {
            const int accessor = p->targets[i].accessors[s];
            if (accessor < 0 || !a->values[s] || result != LOBE_RENDER_OK) continue;
            result = add_target(r, accessor, s, weights[i], a);
        }
    return result;
}

/* ---- Skins --------------------------------------------------------------------------------------- */

static affine inverse_bind_of(const float *columns) {
    affine t;
    for (int i = 0; i < 12; i++) t.m[i / 4][i % 4] = (double)columns[4 * (i % 4) + i / 4];
    return t;
}

static lobe_render_result check_skin(const gltf_reader *r, int skin) {
    const gltf_model *m = r->model;
    if (skin < 0 || (size_t)skin >= m->skin_count)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: skin %d does not exist; is it damaged?",
                         r->path, skin);
    for (size_t i = 0; i < m->skins[skin].joint_count; i++) {
        const int joint = m->skins[skin].joints[i];
        if (joint < 0 || (size_t)joint >= m->node_count)
            return lobe_fail(LOBE_RENDER_BAD_INPUT,
                             "%s: skin %d has node %d, which does not exist; is it damaged?",
                             r->path, skin, joint);
    }
    return LOBE_RENDER_OK;
}

lobe_render_result lobe_gltf_joints_read(gltf_reader *r, gltf_pose *pose, int skin,
                                         gltf_joints *joints) {
    float *inverse = NULL;
    size_t count = 0;
    *joints = (gltf_joints){0};
    lobe_render_result result = check_skin(r, skin);
    if (result != LOBE_RENDER_OK) return result;
    const gltf_skin *s = &r->model->skins[skin];
    if (s->inverse_bind >= 0)
        result = lobe_gltf_read_floats(r, s->inverse_bind, GLTF_MATRIX, &inverse, &count);
    if (result == LOBE_RENDER_OK && s->inverse_bind >= 0 && count < s->joint_count)
        result = lobe_fail(LOBE_RENDER_BAD_INPUT,
                           "%s: skin %d has %zu matrices for %zu joints; is it damaged?", r->path,
                           skin, count, s->joint_count);
    if (result == LOBE_RENDER_OK) {
        joints->to_world = malloc((s->joint_count + 1) * sizeof *joints->to_world);
        if (!joints->to_world) result = lobe_fail_memory(r->path);
    }
    for (size_t i = 0; result == LOBE_RENDER_OK && i < s->joint_count; i++) {
        const affine *joint = lobe_gltf_to_world(pose, r->model, s->joints[i]);
        const affine bound =
            inverse ? inverse_bind_of(inverse + GLTF_MATRIX * i) : lobe_affine_identity();
        joints->to_world[joints->count++] = lobe_affine_product(joint, &bound);
    }
    free(inverse);
    return result;
}

void lobe_gltf_joints_free(gltf_joints *joints) {
    free(joints->to_world);
    *joints = (gltf_joints){0};
}

/* The mean of the joints of a vertex by their weights. 0: a joint does not exist. */
static int blend(const gltf_joints *joints, const affine *fallback, const gltf_arrays *a, size_t i,
                 affine *mean) {
    double sum = 0.0;
    *mean = (affine){{{0.0}}};
    for (size_t k = 0; k < 4 * GLTF_JOINT_SETS; k++) {
        const float *indices = a->values[GLTF_JOINTS + k / 4];
        const float *weights = a->values[GLTF_WEIGHTS + k / 4];
        if (!indices || !weights) continue;
        const float index = indices[4 * i + k % 4], weight = weights[4 * i + k % 4];
        if (!(weight > 0.0f)) continue;
        if (!(index >= 0.0f && (double)index < (double)joints->count)) return 0;
        const affine *joint = &joints->to_world[(size_t)index];
        for (int e = 0; e < 12; e++)
            mean->m[e / 4][e % 4] += (double)weight * joint->m[e / 4][e % 4];
        sum += (double)weight;
    }
    if (!(sum > 0.0))
        *mean = *fallback;
    else
        for (int e = 0; e < 12; e++) mean->m[e / 4][e % 4] /= sum;
    return 1;
}

/* Unit directions stay so: the mean over a triangle weighs them by their length. */
static void turn(const affine *t, float *values) {
    const vec3 turned = lobe_affine_direction(t, v3(values[0], values[1], values[2]));
    const vec3 v = v3_normalize_or(turned, v3_all(0.0f));
    values[0] = v.x;
    values[1] = v.y;
    values[2] = v.z;
}

/* Returns the sign of the transform. */
static double move_vertex(const affine *t, gltf_arrays *a, size_t i) {
    const normal_transform normals = lobe_affine_normals(t);
    float *p = a->values[GLTF_POSITION] + 3 * i;
    const vec3 place = lobe_affine_point(t, v3(p[0], p[1], p[2]));
    p[0] = place.x;
    p[1] = place.y;
    p[2] = place.z;
    if (a->values[GLTF_NORMAL]) turn(&normals.cofactors, a->values[GLTF_NORMAL] + 3 * i);
    if (a->values[GLTF_TANGENT]) {
        turn(t, a->values[GLTF_TANGENT] + 4 * i);
        a->values[GLTF_TANGENT][4 * i + 3] *= (float)normals.sign;
    }
    return normals.sign;
}

lobe_render_result lobe_gltf_skin_arrays(const gltf_reader *r, const gltf_joints *joints,
                                         const affine *to_world, gltf_arrays *a, int *is_mirrored) {
    double signs = 0.0;
    for (size_t i = 0; i < a->vertex_count; i++) {
        affine t;
        if (!blend(joints, to_world, a, i, &t))
            return lobe_fail(
                LOBE_RENDER_BAD_INPUT,
                "%s: a vertex names a joint beyond the %zu of its skin; is it damaged?", r->path,
                joints->count);
        signs += move_vertex(&t, a, i);
    }
    *is_mirrored = signs < 0.0;
    return LOBE_RENDER_OK;
}
