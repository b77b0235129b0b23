/* glTF 2.0 files: nodes with their meshes, cameras and lamps, baked into world space. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_file.h"
#include "gltf_material.h"
#include "gltf_mesh.h"
#include "scene.h"

/* A node that waits for its turn. */
typedef struct visit {
    int node;
    affine to_parent; /* of the parent to the world */
} visit;

typedef struct importer {
    lobe_scene *scene;
    const gltf_model *model;
    const char *path;
    gltf_reader reader;
    material_needs *needs;
    visit *waiting; /* a stack; every node comes on it once */
    size_t waiting_count;
    char *is_known; /* of each node: it was on the stack */
    int repeated_nodes, skinned, morphed, shapeless;
} importer;

/* ---- Cameras and lamps --------------------------------------------------------------------------- */

static void name_camera(const importer *k, const gltf_node *node, char *name, size_t size) {
    const char *own = k->model->cameras[node->camera].name;
    if (node->name[0] || own[0])
        snprintf(name, size, "%s", node->name[0] ? node->name : own);
    else
        snprintf(name, size, "camera-%d", node->camera);
}

/* A camera looks along -Z, Y is up; its node's scale does not count. */
static void add_camera(importer *k, const gltf_node *node, const affine *to_world) {
    if (node->camera < 0 || (size_t)node->camera >= k->model->camera_count) return;
    const gltf_camera *c = &k->model->cameras[node->camera];
    char name[64];
    name_camera(k, node, name, sizeof name);
    const vec3 position = lobe_affine_point(to_world, v3_all(0.0f));
    const vec3 forward =
        v3_normalize_or(lobe_affine_direction(to_world, v3(0.0f, 0.0f, -1.0f)), v3_all(0.0f));
    const vec3 up = lobe_affine_direction(to_world, v3(0.0f, 1.0f, 0.0f));
    const float degrees = (float)c->vertical_angle * (180.0f / LOBE_PI);
    const int is_usable = c->is_perspective && v3_is_finite(position) && v3_is_finite(up) &&
                          v3_dot(forward, forward) > 0.0f && degrees > 0.1f && degrees < 179.0f;
    /* far enough ahead that the sum keeps the direction */
    const float ahead = 1.0f + v3_length(position);
    if (is_usable)
        lobe_scene_add_camera(k->scene, name, position, v3_add(position, v3_scale(forward, ahead)),
                              up, degrees);
    else
        lobe_warn(&k->scene->warnings,
                  "%s: camera %s is not a perspective one that can be used; it is left out",
                  k->path, name);
}

static void add_lamp(importer *k, const gltf_node *node, const affine *to_world) {
    if (node->light < 0 || (size_t)node->light >= k->model->light_count) return;
    const gltf_light *from = &k->model->lights[node->light];
    const float intensity = (float)from->intensity;
    lamp l = {.kind = from->kind == GLTF_LIGHT_SPOT          ? LAMP_SPOT
                      : from->kind == GLTF_LIGHT_DIRECTIONAL ? LAMP_DIRECTIONAL
                                                             : LAMP_POINT,
              .position = lobe_affine_point(to_world, v3_all(0.0f)),
              .direction = v3_normalize_or(lobe_affine_direction(to_world, v3(0.0f, 0.0f, -1.0f)),
                                           v3_all(0.0f)),
              .intensity =
                  v3_scale(v3((float)from->color[0], (float)from->color[1], (float)from->color[2]),
                           intensity),
              .cos_inner = cosf((float)from->inner_angle),
              .cos_outer = cosf((float)from->outer_angle),
              .range = (float)from->range};
    const vec3 i = l.intensity;
    const int is_usable = from->kind != GLTF_LIGHT_UNKNOWN && v3_is_finite(l.position) &&
                          v3_is_finite(i) && i.x >= 0.0f && i.y >= 0.0f && i.z >= 0.0f &&
                          v3_dot(l.direction, l.direction) > 0.0f && isfinite(l.cos_inner) &&
                          isfinite(l.cos_outer) && l.range >= 0.0f;
    if (is_usable)
        lobe_scene_add_lamp(k->scene, l);
    else
        lobe_warn(&k->scene->warnings,
                  "%s: light %d has values that cannot be used; it is left out", k->path,
                  node->light);
}

/* ---- Meshes -------------------------------------------------------------------------------------- */

static const material_needs *needs_of(const importer *k, const gltf_primitive *p) {
    const size_t last = k->model->material_count;
    return &k->needs[p->material >= 0 && (size_t)p->material < last ? (size_t)p->material : last];
}

static lobe_render_result add_mesh(importer *k, const gltf_node *node, const affine *to_world) {
    if (node->mesh < 0) return LOBE_RENDER_OK;
    if ((size_t)node->mesh >= k->model->mesh_count)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: mesh %d does not exist; is it damaged?",
                         k->path, node->mesh);
    const gltf_mesh *mesh = &k->model->meshes[node->mesh];
    k->skinned |= node->skin >= 0;
    lobe_render_result result = LOBE_RENDER_OK;
    for (size_t i = 0; i < mesh->primitive_count && result == LOBE_RENDER_OK; i++) {
        const gltf_primitive *p = &mesh->primitives[i];
        k->morphed |= p->has_targets;
        k->shapeless |= !lobe_gltf_is_made_of_triangles(p);
        if (lobe_gltf_is_made_of_triangles(p))
            result = lobe_gltf_add_primitive(k->scene, &k->reader, p, needs_of(k, p), to_world);
    }
    return result;
}

/* ---- Nodes --------------------------------------------------------------------------------------- */

static lobe_render_result push_nodes(importer *k, const int *nodes, size_t count,
                                     const affine *to_parent) {
    for (size_t i = count; i-- > 0;) {
        const int n = nodes[i];
        if (n < 0 || (size_t)n >= k->model->node_count)
            return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: node %d does not exist; is it damaged?",
                             k->path, n);
        k->repeated_nodes |= k->is_known[n];
        if (k->is_known[n]) continue;
        k->is_known[n] = 1;
        k->waiting[k->waiting_count++] = (visit){n, *to_parent};
    }
    return LOBE_RENDER_OK;
}

static lobe_render_result read_nodes(importer *k) {
    const affine world = lobe_affine_identity();
    lobe_render_result result = push_nodes(k, k->model->roots, k->model->root_count, &world);
    while (result == LOBE_RENDER_OK && k->waiting_count > 0 && !k->scene->out_of_memory) {
        const visit v = k->waiting[--k->waiting_count];
        const gltf_node *node = &k->model->nodes[v.node];
        const affine own = lobe_gltf_node_transform(node);
        const affine to_world = lobe_affine_product(&v.to_parent, &own);
        add_camera(k, node, &to_world);
        add_lamp(k, node, &to_world);
        result = add_mesh(k, node, &to_world);
        if (result == LOBE_RENDER_OK)
            result = push_nodes(k, node->children, node->child_count, &to_world);
    }
    return result;
}

/* ---- What is left out ---------------------------------------------------------------------------- */

static void warn_of_extensions(const importer *k) {
    const gltf_model *m = k->model;
    for (size_t i = 0; i < m->extension_count; i++)
        if (!lobe_gltf_knows(m->extensions[i]))
            lobe_warn(&k->scene->warnings, "%s: uses the extension %.100s; it is ignored", k->path,
                      m->extensions[i]);
}

static void warn_of_features(const importer *k) {
    warnings *w = &k->scene->warnings;
    const uint64_t dropped = k->scene->info.dropped_triangles;
    warn_of_extensions(k);
    if (k->model->animation_count)
        lobe_warn(w, "%s: is animated; nodes are shown where they rest", k->path);
    if (k->skinned) lobe_warn(w, "%s: has skins; meshes are shown as they were bound", k->path);
    if (k->morphed) lobe_warn(w, "%s: has morph targets; they are ignored", k->path);
    if (k->shapeless) lobe_warn(w, "%s: has points or lines; they are left out", k->path);
    if (k->repeated_nodes)
        lobe_warn(w, "%s: has nodes with more than one parent; they are shown once", k->path);
    if (dropped)
        lobe_warn(w,
                  "%s: %llu triangles without area or with a coordinate that is not finite; they "
                  "are left out",
                  k->path, (unsigned long long)dropped);
}

/* ---- The file ------------------------------------------------------------------------------------ */

static lobe_render_result read_scene(importer *k, const lobe_scene_options *options) {
    const size_t nodes = k->model->node_count;
    k->is_known = calloc(nodes + 1, sizeof *k->is_known);
    k->waiting = malloc((nodes + 1) * sizeof *k->waiting);
    lobe_render_result result = LOBE_RENDER_OK;
    if (!lobe_gltf_reader_create(&k->reader, k->model, k->path) || !k->is_known || !k->waiting)
        result = lobe_fail_memory(k->path);
    if (result == LOBE_RENDER_OK)
        result = lobe_gltf_read_materials(k->scene, &k->reader, options, &k->needs);
    if (result == LOBE_RENDER_OK && !k->scene->out_of_memory) result = read_nodes(k);
    if (result == LOBE_RENDER_OK) warn_of_features(k);
    lobe_gltf_reader_free(&k->reader);
    free(k->is_known);
    free(k->waiting);
    free(k->needs);
    return result;
}

lobe_render_result lobe_scene_import_gltf(lobe_scene *s, const char *path,
                                          const lobe_scene_options *options) {
    gltf_file file;
    lobe_render_result result = lobe_gltf_file_read(path, &file);
    if (result != LOBE_RENDER_OK) return result;
    char folder[PATH_MAX], message[500];
    const char *slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path) + 1 : 0, path);
    gltf_model *model = lobe_gltf_model_read(file.glb, file.size, folder, message, sizeof message);
    free(file.glb);
    if (!model)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: cannot be read as glTF (%.200s); is it damaged?", path, message);
    importer k = {.scene = s, .model = model, .path = path};
    result = read_scene(&k, options);
    lobe_gltf_model_free(model);
    return result;
}
