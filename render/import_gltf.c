/* glTF 2.0 files: nodes with their meshes, cameras and lamps, baked into world space. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_file.h"
#include "gltf_material.h"
#include "gltf_mesh.h"
#include "inventory.h"
#include "scene.h"

/* How a mesh that nothing bends is used. */
typedef struct mesh_use {
    size_t places;
    int shape; /* of the scene; -1: every place has its own triangles */
} mesh_use;

typedef struct importer {
    lobe_scene *scene;
    const gltf_model *model;
    const char *path;
    gltf_reader reader;
    const lobe_scene_options *options;
    material_needs *needs;
    gltf_pose pose;
    int *shown, *waiting; /* nodes of the scene in their order; a stack */
    size_t shown_count, waiting_count;
    char *is_known;     /* of each node: it was on the stack */
    mesh_use *uses;     /* of each mesh */
    size_t place_count; /* of instances so far */
    int repeated_nodes, beyond, shapeless;
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
    if (is_usable) {
        lobe_scene_add_lamp(k->scene, l);
        lobe_scene_note(k->scene,
                        (lobe_scene_item){.part = LOBE_SCENE_LIGHT,
                                          .name = from->name[0] ? from->name : node->name});
    } else {
        lobe_warn(&k->scene->warnings,
                  "%s: light %d has values that cannot be used; it is left out", k->path,
                  node->light);
    }
}

/* ---- Meshes -------------------------------------------------------------------------------------- */

static const material_needs *needs_of(const importer *k, const gltf_primitive *p) {
    const size_t last = k->model->material_count;
    return &k->needs[p->material >= 0 && (size_t)p->material < last ? (size_t)p->material : last];
}

/* Lights are chosen among the triangles of the world. */
static int is_shared(const importer *k, const gltf_primitive *p) {
    return lobe_gltf_is_made_of_triangles(p) &&
           !lobe_is_even_light(&k->scene->materials[needs_of(k, p)->material]);
}

static lobe_render_result add_primitives(importer *k, const gltf_mesh *mesh, int with_shared,
                                         const affine *to_world, const gltf_bend *bend) {
    lobe_render_result result = LOBE_RENDER_OK;
    for (size_t i = 0; i < mesh->primitive_count && result == LOBE_RENDER_OK; i++) {
        const gltf_primitive *p = &mesh->primitives[i];
        k->beyond |= p->has_more;
        k->shapeless |= !lobe_gltf_is_made_of_triangles(p);
        if (!lobe_gltf_is_made_of_triangles(p) || (!with_shared && is_shared(k, p))) continue;
        result = lobe_gltf_add_primitive(k->scene, &k->reader, p, needs_of(k, p), to_world, bend);
    }
    return result;
}

/* One place of a mesh. */
static lobe_render_result place_mesh(importer *k, int mesh, const affine *to_world,
                                     const gltf_bend *bend) {
    const int shape = k->uses[mesh].shape;
    const int is_instance = shape >= 0 && !bend->joints && !bend->weight_count &&
                            lobe_scene_add_instance(k->scene, (uint32_t)shape, to_world);
    return add_primitives(k, &k->model->meshes[mesh], !is_instance, to_world, bend);
}

/* ---- Nodes --------------------------------------------------------------------------------------- */

/* The weights that bend a node's mesh: animated, of the node, or of the mesh. */
static gltf_bend bend_of(const importer *k, int node) {
    const gltf_node *n = &k->model->nodes[node];
    const gltf_node_pose *pose = &k->pose.nodes[node];
    const gltf_mesh *mesh = &k->model->meshes[n->mesh];
    if (pose->weights) return (gltf_bend){pose->weights, pose->weight_count, NULL};
    if (n->weight_count) return (gltf_bend){n->weights, n->weight_count, NULL};
    return (gltf_bend){mesh->weights, mesh->weight_count, NULL};
}

/* How often a node shows its mesh. */
static size_t places_of(const importer *k, const gltf_node *n) {
    size_t most = n->is_instanced ? 0 : 1;
    for (int i = 0; i < 3 && n->is_instanced; i++) {
        const int a = n->instances[i];
        if (a < 0 || (size_t)a >= k->model->accessor_count) continue;
        const size_t count = k->model->accessors[a].count;
        if (count > most) most = count;
    }
    return most;
}

/* Most places of meshes in a file: guards against counts that lie. */
enum { PLACES_MAX = 1 << 22 };

/* EXT_mesh_gpu_instancing: from each place to the node. *places: by malloc. */
static lobe_render_result read_places(importer *k, const gltf_node *node, affine **places,
                                      size_t *count) {
    static const int channels[3] = {3, 4, 3};
    static const float unmoved[3][4] = {{0.0f}, {0.0f, 0.0f, 0.0f, 1.0f}, {1.0f, 1.0f, 1.0f}};
    float *values[3] = {NULL};
    size_t counts[3] = {0};
    lobe_render_result result = LOBE_RENDER_OK;
    *count = 0;
    for (int i = 0; i < 3 && result == LOBE_RENDER_OK; i++) {
        if (node->instances[i] < 0) continue;
        result = lobe_gltf_read_floats(&k->reader, node->instances[i], channels[i], &values[i],
                                       &counts[i]);
        if (counts[i] > *count) *count = counts[i];
    }
    for (int i = 0; i < 3 && result == LOBE_RENDER_OK; i++)
        if (values[i] && counts[i] != *count)
            result =
                lobe_fail(LOBE_RENDER_BAD_INPUT,
                          "%s: accessors of instances have %zu and %zu elements; is it damaged?",
                          k->path, counts[i], *count);
    *places = result == LOBE_RENDER_OK ? malloc((*count + 1) * sizeof **places) : NULL;
    if (result == LOBE_RENDER_OK && !*places) result = lobe_fail_memory(k->path);
    for (size_t i = 0; result == LOBE_RENDER_OK && i < *count; i++) {
        double part[3][4];
        for (int p = 0; p < 3; p++)
            for (int c = 0; c < channels[p]; c++)
                part[p][c] = (double)(values[p] ? values[p][i * (size_t)channels[p] + (size_t)c]
                                                : unmoved[p][c]);
        (*places)[i] = lobe_affine_of(part[0], part[1], part[2]);
    }
    for (int i = 0; i < 3; i++) free(values[i]);
    return result;
}

static lobe_render_result add_places(importer *k, const gltf_node *node, const affine *to_world,
                                     const gltf_bend *bend) {
    affine *places = NULL;
    size_t count = places_of(k, node);
    if (count > PLACES_MAX - k->place_count)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: more than %d instances; split the scene",
                         k->path, PLACES_MAX);
    k->place_count += count;
    lobe_render_result result = read_places(k, node, &places, &count);
    for (size_t i = 0; i < count && result == LOBE_RENDER_OK && !k->scene->out_of_memory; i++) {
        const affine place = lobe_affine_product(to_world, &places[i]);
        result = place_mesh(k, node->mesh, &place, bend);
    }
    free(places);
    return result;
}

static lobe_render_result add_mesh(importer *k, int index, const affine *to_world) {
    const gltf_node *node = &k->model->nodes[index];
    if (node->mesh < 0) return LOBE_RENDER_OK;
    gltf_joints joints = {0};
    gltf_bend bend = bend_of(k, index);
    lobe_render_result result = LOBE_RENDER_OK;
    if (node->skin >= 0) {
        result = lobe_gltf_joints_read(&k->reader, &k->pose, node->skin, &joints);
        bend.joints = &joints;
    }
    if (result == LOBE_RENDER_OK)
        result = node->is_instanced ? add_places(k, node, to_world, &bend)
                                    : place_mesh(k, node->mesh, to_world, &bend);
    lobe_gltf_joints_free(&joints);
    return result;
}

static lobe_render_result push_nodes(importer *k, const int *nodes, size_t count) {
    for (size_t i = count; i-- > 0;) {
        const int n = nodes[i];
        if (n < 0 || (size_t)n >= k->model->node_count)
            return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: node %d does not exist; is it damaged?",
                             k->path, n);
        k->repeated_nodes |= k->is_known[n] || k->pose.nodes[n].is_repeated;
        if (k->is_known[n]) continue;
        k->is_known[n] = 1;
        k->waiting[k->waiting_count++] = n;
    }
    return LOBE_RENDER_OK;
}

/* The nodes of the scene, parents first. */
static lobe_render_result find_nodes(importer *k) {
    lobe_render_result result = push_nodes(k, k->model->roots, k->model->root_count);
    while (result == LOBE_RENDER_OK && k->waiting_count > 0) {
        const int n = k->waiting[--k->waiting_count];
        const gltf_node *node = &k->model->nodes[n];
        k->shown[k->shown_count++] = n;
        if (node->mesh >= 0 && (size_t)node->mesh >= k->model->mesh_count)
            return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: mesh %d does not exist; is it damaged?",
                             k->path, node->mesh);
        result = push_nodes(k, node->children, node->child_count);
    }
    return result;
}

/* ---- Shapes -------------------------------------------------------------------------------------- */

/* Copies are faster to trace than instances, and so small ones of them are made. */
enum { COPIED_TRIANGLES_MAX = 10000, SHAPE_TRIANGLES_MIN = 16 };

static void count_places(importer *k) {
    for (size_t i = 0; i < k->model->mesh_count; i++) k->uses[i] = (mesh_use){0, -1};
    for (size_t i = 0; i < k->shown_count; i++) {
        const gltf_node *n = &k->model->nodes[k->shown[i]];
        if (n->mesh < 0 || n->skin >= 0 || bend_of(k, k->shown[i]).weight_count) continue;
        k->uses[n->mesh].places += places_of(k, n);
    }
}

static int is_worth_a_shape(const importer *k, size_t mesh) {
    const gltf_mesh *m = &k->model->meshes[mesh];
    size_t triangles = 0;
    for (size_t i = 0; i < m->primitive_count; i++)
        if (is_shared(k, &m->primitives[i]))
            triangles += lobe_gltf_triangle_count(k->model, &m->primitives[i]);
    return k->uses[mesh].places > 1 && triangles >= SHAPE_TRIANGLES_MIN &&
           triangles > COPIED_TRIANGLES_MAX / (k->uses[mesh].places - 1);
}

/* Before all else: the triangles of the world come after those of shapes. */
static lobe_render_result add_shapes(importer *k) {
    const affine own = lobe_affine_identity();
    const gltf_bend none = {0};
    lobe_render_result result = LOBE_RENDER_OK;
    for (size_t i = 0; i < k->model->mesh_count && result == LOBE_RENDER_OK; i++) {
        const gltf_mesh *mesh = &k->model->meshes[i];
        const uint32_t first = k->scene->triangle_count;
        if (!is_worth_a_shape(k, i)) continue;
        for (size_t p = 0; p < mesh->primitive_count && result == LOBE_RENDER_OK; p++)
            if (is_shared(k, &mesh->primitives[p]))
                result = lobe_gltf_add_primitive(k->scene, &k->reader, &mesh->primitives[p],
                                                 needs_of(k, &mesh->primitives[p]), &own, &none);
        if (k->scene->triangle_count > first)
            k->uses[i].shape = (int)lobe_scene_add_shape(k->scene, first);
    }
    return result;
}

static lobe_render_result read_nodes(importer *k) {
    lobe_render_result result = find_nodes(k);
    if (result != LOBE_RENDER_OK) return result;
    count_places(k);
    result = add_shapes(k);
    for (size_t i = 0; i < k->shown_count && result == LOBE_RENDER_OK; i++) {
        const int n = k->shown[i];
        const affine *to_world = lobe_gltf_to_world(&k->pose, k->model, n);
        add_camera(k, &k->model->nodes[n], to_world);
        add_lamp(k, &k->model->nodes[n], to_world);
        if (k->scene->out_of_memory) break;
        result = add_mesh(k, n, to_world);
    }
    return result;
}

/* ---- What there is -------------------------------------------------------------------------------- */

static void note_mesh(const importer *k, size_t index) {
    const gltf_mesh *mesh = &k->model->meshes[index];
    char words[WORDS_ROOM] = "";
    uint64_t triangles = 0, uses = 0;
    int has[GLTF_SEMANTICS] = {0}, is_packed = 0, is_morphed = 0, is_skinned = 0;
    for (size_t i = 0; i < mesh->primitive_count; i++) {
        const gltf_primitive *p = &mesh->primitives[i];
        triangles += lobe_gltf_triangle_count(k->model, p);
        is_packed |= p->draco_view >= 0;
        is_morphed |= p->target_count > 0;
        for (int s = 0; s < GLTF_SEMANTICS; s++) has[s] |= p->accessors[s] >= 0;
    }
    for (size_t i = 0; i < k->shown_count; i++) {
        const gltf_node *n = &k->model->nodes[k->shown[i]];
        if (n->mesh != (int)index) continue;
        uses += places_of(k, n);
        is_skinned |= n->skin >= 0;
    }
    lobe_add_word(words, has[GLTF_NORMAL], "normals");
    lobe_add_word(words, has[GLTF_TANGENT], "tangents");
    lobe_add_word(words, has[GLTF_COLOR], "colours");
    lobe_add_word(words, has[GLTF_TEXCOORD], "texture coordinates");
    lobe_add_word(words, has[GLTF_TEXCOORD + 1], "a second set");
    lobe_add_word(words, is_skinned, "skin");
    lobe_add_word(words, is_morphed, "morph targets");
    lobe_add_word(words, is_packed, "Draco");
    lobe_add_word(words, k->uses[index].shape >= 0, "instances");
    lobe_scene_note(k->scene, (lobe_scene_item){.part = LOBE_SCENE_MESH,
                                                .name = mesh->name,
                                                .about = words,
                                                .count = triangles,
                                                .uses = uses});
}

static void note_animation(importer *k, const gltf_animation *a) {
    static const char *const paths[] = {"translation", "rotation", "scale", "weights",
                                        "something that is ignored"};
    static const char *const ways[] = {"steps", "lines", "cubics"};
    int has_path[5] = {0}, has_way[3] = {0};
    char words[WORDS_ROOM] = "";
    lobe_scene_item item = {
        .part = LOBE_SCENE_ANIMATION, .name = a->name, .count = a->channel_count};
    for (size_t i = 0; i < a->channel_count; i++) {
        const gltf_channel *c = &a->channels[i];
        const int input = c->input;
        has_path[c->path] = has_way[c->interpolation] = 1;
        if (input < 0 || (size_t)input >= k->model->accessor_count) continue;
        item.seconds = fmax(item.seconds, k->model->accessors[input].greatest);
    }
    for (int i = 0; i < 5; i++) lobe_add_word(words, has_path[i], paths[i]);
    for (int i = 0; i < 3; i++) lobe_add_word(words, has_way[i], ways[i]);
    item.about = words;
    lobe_scene_note(k->scene, item);
}

static void note_extension(const importer *k, const char *name) {
    char words[WORDS_ROOM] = "";
    int is_required = 0;
    for (size_t i = 0; i < k->model->required_count; i++)
        is_required |= strcmp(k->model->required[i], name) == 0;
    lobe_add_word(words, 1, lobe_gltf_knows(name) ? "read" : "ignored");
    lobe_add_word(words, is_required, "required");
    lobe_scene_note(k->scene,
                    (lobe_scene_item){.part = LOBE_SCENE_EXTENSION, .name = name, .about = words});
}

static void note_parts(importer *k) {
    const gltf_model *m = k->model;
    for (size_t i = 0; i < m->mesh_count; i++) note_mesh(k, i);
    for (size_t i = 0; i < m->animation_count; i++) note_animation(k, &m->animations[i]);
    for (size_t i = 0; i < m->extension_count; i++) note_extension(k, m->extensions[i]);
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
    if (k->model->animation_count && !isfinite(k->options->frame_time))
        lobe_warn(w,
                  "%s: is animated; nodes are shown where they rest, --frame-time shows a moment",
                  k->path);
    if (k->beyond)
        lobe_warn(w,
                  "%s: has more joints, colours or morphed attributes of vertices than are read; "
                  "the rest is ignored",
                  k->path);
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
    k->shown = malloc((nodes + 1) * sizeof *k->shown);
    k->uses = malloc((k->model->mesh_count + 1) * sizeof *k->uses);
    lobe_render_result result = LOBE_RENDER_OK;
    if (!lobe_gltf_reader_create(&k->reader, k->model, k->path) || !k->is_known || !k->waiting ||
        !k->shown || !k->uses)
        result = lobe_fail_memory(k->path);
    if (result == LOBE_RENDER_OK)
        result =
            lobe_gltf_pose_create(&k->pose, &k->reader, options->animation, options->frame_time);
    if (result == LOBE_RENDER_OK)
        result = lobe_gltf_read_materials(k->scene, &k->reader, options, &k->needs);
    if (result == LOBE_RENDER_OK && !k->scene->out_of_memory) result = read_nodes(k);
    if (result == LOBE_RENDER_OK) note_parts(k);
    if (result == LOBE_RENDER_OK) warn_of_features(k);
    lobe_gltf_pose_free(&k->pose);
    lobe_gltf_reader_free(&k->reader);
    free(k->is_known);
    free(k->waiting);
    free(k->shown);
    free(k->uses);
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
    importer k = {.scene = s, .model = model, .path = path, .options = options};
    s->is_animated = model->animation_count > 0;
    result = read_scene(&k, options);
    lobe_gltf_model_free(model);
    return result;
}
