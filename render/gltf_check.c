#include "gltf_check.h"

#include <jansson.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image.h"
#include "message.h"

enum { NODE_DEPTH_MAX = 1000 };

static lobe_render_result refuse_json(const char *path, const json_error_t *error) {
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: line %d: not the JSON of a glTF file (%s); is it "
                     "damaged?",
                     path, error->line, error->text);
}

/* The JSON of a .gltf file or of the first chunk of a .glb file, version 1 or 2; NULL: neither, or an
 * error. */
static json_t *read_json(const char *path, lobe_render_result *result) {
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    uint32_t head[5] = {0};
    const size_t words = fread(head, 4, 5, file);
    json_t *json = NULL;
    json_error_t error = {.line = -1};
    if (words == 5 && head[0] == 0x46546c67u) {
        const int is_json = head[1] == 1 ? head[4] == 0 : head[4] == 0x4e4f534au;
        char *text = is_json && head[3] < 1u << 28 ? malloc((size_t)head[3] + 1) : NULL;
        /* a chunk that ends before its length is left to the importer, which says so */
        const int is_whole = text && fread(text, 1, head[3], file) == head[3];
        if (is_whole && !(json = json_loadb(text, head[3], 0, &error)))
            *result = refuse_json(path, &error);
        free(text);
    } else if (lobe_path_ends(path, ".gltf")) {
        rewind(file);
        if (!(json = json_loadf(file, 0, &error))) *result = refuse_json(path, &error);
    }
    fclose(file);
    return json;
}

static lobe_render_result check_extensions(const char *path, const json_t *json) {
    /* Assimp takes quantised coordinates for floats. */
    static const char *const refused[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                          "KHR_mesh_quantization"};
    const json_t *name;
    size_t i;
    json_array_foreach(json_object_get(json, "extensionsRequired"), i, name) {
        for (size_t k = 0; k < sizeof refused / sizeof *refused; k++)
            if (json_is_string(name) && strcmp(json_string_value(name), refused[k]) == 0)
                return lobe_fail(LOBE_RENDER_BAD_INPUT,
                                 "%s: needs the extension %s, which cannot be read; export without "
                                 "it",
                                 path, refused[k]);
    }
    return LOBE_RENDER_OK;
}

/* Every node's parent, -1 for none. NULL: no memory. */
static json_int_t *find_parents(const json_t *nodes) {
    const size_t count = json_array_size(nodes);
    json_int_t *parents = malloc((count + 1) * sizeof *parents);
    if (!parents) return NULL;
    for (size_t i = 0; i < count; i++) parents[i] = -1;
    const json_t *node, *child;
    size_t i, k;
    json_array_foreach(nodes, i, node) {
        json_array_foreach(json_object_get(node, "children"), k, child) {
            const json_int_t c = json_integer_value(child);
            if (json_is_integer(child) && c >= 0 && (size_t)c < count) parents[c] = (json_int_t)i;
        }
    }
    return parents;
}

static lobe_render_result check_depth(const char *path, const json_t *json) {
    const json_t *nodes = json_object_get(json, "nodes");
    json_int_t *parents = find_parents(nodes);
    if (!parents) return lobe_fail_memory(path);
    int is_deep = 0;
    for (size_t i = 0; i < json_array_size(nodes) && !is_deep; i++) {
        int depth = 0;
        for (json_int_t n = (json_int_t)i; n >= 0 && depth <= NODE_DEPTH_MAX; n = parents[n])
            depth++;
        is_deep = depth > NODE_DEPTH_MAX;
    }
    free(parents);
    if (!is_deep) return LOBE_RENDER_OK;
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: nodes are nested in a circle or more than %d deep; flatten them", path,
                     NODE_DEPTH_MAX);
}

lobe_render_result lobe_gltf_check(const char *path) {
    lobe_render_result result = LOBE_RENDER_OK;
    json_t *json = read_json(path, &result);
    if (json) result = check_extensions(path, json);
    if (json && result == LOBE_RENDER_OK) result = check_depth(path, json);
    json_decref(json);
    return result;
}
