#include "gltf_pose.h"

#include <stdlib.h>
#include <string.h>

#include "gltf_animation.h"
#include "message.h"

static void rest(gltf_node_pose *pose, const gltf_node *node) {
    *pose = (gltf_node_pose){.has_matrix = node->has_matrix, .parent = -1};
    memcpy(pose->translation, node->translation, sizeof pose->translation);
    memcpy(pose->rotation, node->rotation, sizeof pose->rotation);
    memcpy(pose->scale, node->scale, sizeof pose->scale);
}

static void find_parents(gltf_pose *pose, const gltf_model *m) {
    for (size_t i = 0; i < m->node_count; i++)
        for (size_t k = 0; k < m->nodes[i].child_count; k++) {
            const int child = m->nodes[i].children[k];
            if (child < 0 || (size_t)child >= m->node_count) continue;
            gltf_node_pose *c = &pose->nodes[child];
            c->is_repeated |= c->parent >= 0;
            if (c->parent < 0) c->parent = (int)i;
        }
}

/* ---- Animation ----------------------------------------------------------------------------------- */

static void set_weights(gltf_node_pose *pose, const gltf_keys *keys, const gltf_channel *channel,
                        double time) {
    free(pose->weights);
    pose->weights = calloc(keys->width + 1, sizeof *pose->weights);
    pose->weight_count = pose->weights ? keys->width : 0;
    if (pose->weights) lobe_gltf_keys_at(keys, channel, time, pose->weights);
}

static void move(gltf_node_pose *pose, const gltf_keys *keys, const gltf_channel *channel,
                 double time) {
    pose->has_matrix = 0;
    switch (channel->path) {
    case GLTF_TRANSLATION:
        lobe_gltf_keys_at(keys, channel, time, pose->translation);
        break;
    case GLTF_ROTATION:
        lobe_gltf_keys_at(keys, channel, time, pose->rotation);
        break;
    case GLTF_SCALE:
        lobe_gltf_keys_at(keys, channel, time, pose->scale);
        break;
    default:
        set_weights(pose, keys, channel, time);
    }
}

/* Channels without a node or of an unknown path belong to extensions. */
static lobe_render_result play(gltf_pose *pose, gltf_reader *r, const gltf_animation *animation,
                               double time) {
    lobe_render_result result = LOBE_RENDER_OK;
    for (size_t i = 0; i < animation->channel_count && result == LOBE_RENDER_OK; i++) {
        const gltf_channel *c = &animation->channels[i];
        if (c->path == GLTF_NO_PATH || c->node < 0 || (size_t)c->node >= pose->count) continue;
        gltf_keys keys;
        result = lobe_gltf_keys_read(r, c, &keys);
        if (result == LOBE_RENDER_OK && keys.count > 0) move(&pose->nodes[c->node], &keys, c, time);
        lobe_gltf_keys_free(&keys);
    }
    return result;
}

static int is_asked_for(const char *asked, const gltf_animation *animation, size_t index) {
    if (!asked) return index == 0;
    return strcmp(asked, "all") == 0 || strcmp(asked, animation->name) == 0;
}

static lobe_render_result play_all(gltf_pose *pose, gltf_reader *r, const char *asked,
                                   double time) {
    const gltf_model *m = r->model;
    lobe_render_result result = LOBE_RENDER_OK;
    int is_found = !asked || strcmp(asked, "all") == 0;
    for (size_t i = 0; i < m->animation_count && result == LOBE_RENDER_OK; i++) {
        if (!is_asked_for(asked, &m->animations[i], i)) continue;
        is_found = 1;
        result = play(pose, r, &m->animations[i], time);
    }
    if (is_found) return result;
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: no animation named %.100s; lobe info lists them, without a name the "
                     "first one is taken",
                     r->path, asked);
}

/* ---- The whole ----------------------------------------------------------------------------------- */

lobe_render_result lobe_gltf_pose_create(gltf_pose *pose, gltf_reader *r, const char *animation,
                                         double time) {
    const gltf_model *m = r->model;
    *pose = (gltf_pose){malloc((m->node_count + 1) * sizeof *pose->nodes), m->node_count,
                        malloc((m->node_count + 1) * sizeof *pose->path)};
    if (!pose->nodes || !pose->path) {
        pose->count = 0;
        return lobe_fail_memory(r->path);
    }
    for (size_t i = 0; i < m->node_count; i++) rest(&pose->nodes[i], &m->nodes[i]);
    find_parents(pose, m);
    return isfinite(time) ? play_all(pose, r, animation, time) : LOBE_RENDER_OK;
}

void lobe_gltf_pose_free(gltf_pose *pose) {
    for (size_t i = 0; i < pose->count; i++) free(pose->nodes[i].weights);
    free(pose->nodes);
    free(pose->path);
}

static affine to_parent(const gltf_node_pose *pose, const gltf_node *node) {
    if (!pose->has_matrix) return lobe_affine_of(pose->translation, pose->rotation, pose->scale);
    affine t;
    for (int i = 0; i < 12; i++) t.m[i / 4][i % 4] = node->matrix[4 * (i % 4) + i / 4];
    return t;
}

const affine *lobe_gltf_to_world(gltf_pose *pose, const gltf_model *model, int node) {
    size_t depth = 0;
    for (int n = node; n >= 0 && !pose->nodes[n].is_placed; n = pose->nodes[n].parent)
        pose->path[depth++] = n;
    while (depth > 0) {
        const int n = pose->path[--depth];
        gltf_node_pose *p = &pose->nodes[n];
        const affine own = to_parent(p, &model->nodes[n]);
        p->to_world =
            p->parent < 0 ? own : lobe_affine_product(&pose->nodes[p->parent].to_world, &own);
        p->is_placed = 1;
    }
    return &pose->nodes[node].to_world;
}
