#include "gltf_file.h"

#include <jansson.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "message.h"

enum { NODE_DEPTH_MAX = 1000, JSON_DEPTH_MAX = 100 };
enum { GLB_HEADER = 12, CHUNK_HEADER = 8 };
static const uint32_t GLB_MAGIC = 0x46546c67u, JSON_CHUNK = 0x4e4f534au, BINARY_CHUNK = 0x004e4942u;

int lobe_gltf_knows(const char *extension) {
    static const char *const known[] = {
        "EXT_mesh_gpu_instancing",
        "EXT_meshopt_compression",
        "KHR_draco_mesh_compression",
        "KHR_lights_punctual",
        "KHR_materials_anisotropy",
        "KHR_materials_unlit",
        "KHR_materials_emissive_strength",
        "KHR_materials_transmission",
        "KHR_materials_ior",
        "KHR_materials_volume",
        "KHR_materials_specular",
        "KHR_materials_clearcoat",
        "KHR_mesh_quantization",
        "KHR_texture_transform",
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i], extension) == 0) return 1;
    return 0;
}

/* ---- The bytes ----------------------------------------------------------------------------------- */

/* The JSON and the binary chunk, inside `bytes`. */
typedef struct chunks {
    unsigned char *bytes; /* the whole file, by malloc */
    const char *json;
    size_t json_size;
    const unsigned char *binary; /* NULL: there is none */
    size_t binary_size;
} chunks;

static lobe_render_result read_bytes(const char *path, chunks *c, size_t *size) {
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode))
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: not a regular file; give a scene", path);
    if (status.st_size >= UINT32_MAX - 64)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: larger than 4 GiB; move buffers out of it",
                         path);
    FILE *file = fopen(path, "rb");
    if (!file) return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: cannot be opened; give a scene", path);
    *size = (size_t)status.st_size;
    c->bytes = malloc(*size + 1);
    const int is_whole = c->bytes && fread(c->bytes, 1, *size, file) == *size;
    fclose(file);
    if (!c->bytes) return lobe_fail_memory(path);
    if (!is_whole)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: cannot be read to its end; try again", path);
    return LOBE_RENDER_OK;
}

static uint32_t word_at(const unsigned char *bytes) {
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static lobe_render_result refuse(const char *path, const char *why) {
    return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: %s; is it damaged?", path, why);
}

static lobe_render_result find_chunks(const char *path, chunks *c, size_t size) {
    const unsigned char *b = c->bytes;
    if (size < 4 || word_at(b) != GLB_MAGIC) {
        c->json = (const char *)b;
        c->json_size = size;
        return LOBE_RENDER_OK;
    }
    if (size < GLB_HEADER + CHUNK_HEADER) return refuse(path, "ends within its header");
    if (word_at(b + 4) != 2)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: version %u of glTF; convert it to 2.0", path,
                         word_at(b + 4));
    const size_t length = word_at(b + 8), json_size = word_at(b + 12);
    if (length > size || length < GLB_HEADER + CHUNK_HEADER)
        return refuse(path, "shorter than its header says");
    if (word_at(b + 16) != JSON_CHUNK || json_size > length - GLB_HEADER - CHUNK_HEADER)
        return refuse(path, "has no whole JSON chunk");
    c->json = (const char *)b + GLB_HEADER + CHUNK_HEADER;
    c->json_size = json_size;
    const size_t next = GLB_HEADER + CHUNK_HEADER + ((json_size + 3) & ~(size_t)3);
    if (next + CHUNK_HEADER > length || word_at(b + next + 4) != BINARY_CHUNK)
        return LOBE_RENDER_OK;
    c->binary = b + next + CHUNK_HEADER;
    c->binary_size = word_at(b + next);
    if (c->binary_size > length - next - CHUNK_HEADER)
        return refuse(path, "its binary chunk ends too early");
    return LOBE_RENDER_OK;
}

/* ---- The JSON ------------------------------------------------------------------------------------ */

/* Readers recurse: deep nesting would exhaust their stack. */
static int is_nested_too_deep(const char *text, size_t size) {
    int depth = 0, is_string = 0;
    for (size_t i = 0; i < size; i++) {
        const char c = text[i];
        if (is_string) {
            if (c == '\\')
                i++;
            else if (c == '"')
                is_string = 0;
        } else if (c == '"') {
            is_string = 1;
        } else if (c == '[' || c == '{') {
            if (++depth > JSON_DEPTH_MAX) return 1;
        } else if (c == ']' || c == '}') {
            depth--;
        }
    }
    return 0;
}

static lobe_render_result parse(const char *path, const chunks *c, json_t **json) {
    json_error_t error;
    if (is_nested_too_deep(c->json, c->json_size))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: JSON nested to a depth of more than %d; flatten it", path,
                         JSON_DEPTH_MAX);
    *json = json_loadb(c->json, c->json_size, 0, &error);
    if (!*json)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: line %d: not the JSON of a glTF file (%s); is it damaged?", path,
                         error.line, error.text);
    const char *version =
        json_string_value(json_object_get(json_object_get(*json, "asset"), "version"));
    if (version && strncmp(version, "2.", 2) == 0) return LOBE_RENDER_OK;
    return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: version %.20s of glTF; convert it to 2.0", path,
                     version ? version : "unknown");
}

static lobe_render_result check_extensions(const char *path, const json_t *json) {
    const json_t *name;
    size_t i;
    json_array_foreach(json_object_get(json, "extensionsRequired"), i, name) {
        if (!json_is_string(name) || !lobe_gltf_knows(json_string_value(name)))
            return lobe_fail(LOBE_RENDER_BAD_INPUT,
                             "%s: needs the extension %.100s, which cannot be read; export without "
                             "it",
                             path, json_is_string(name) ? json_string_value(name) : "(no name)");
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

/* tinygltf wants bytes in every buffer; the fallback of EXT_meshopt_compression has none. */
static void fill_empty_buffers(json_t *json) {
    json_t *buffer;
    size_t i;
    json_array_foreach(json_object_get(json, "buffers"), i, buffer) {
        const json_t *extension =
            json_object_get(json_object_get(buffer, "extensions"), "EXT_meshopt_compression");
        if (!json_is_true(json_object_get(extension, "fallback"))) continue;
        if (json_object_get(buffer, "uri")) continue;
        json_object_set_new(buffer, "uri",
                            json_string("data:application/octet-stream;base64,AA=="));
        json_object_set_new(buffer, "byteLength", json_integer(1));
    }
}

/* It takes a plus in a name for a blank. */
static void protect_plus(json_t *json) {
    json_t *buffer;
    size_t i;
    json_array_foreach(json_object_get(json, "buffers"), i, buffer) {
        const char *uri = json_string_value(json_object_get(buffer, "uri"));
        if (!uri || strncmp(uri, "data:", 5) == 0 || !strchr(uri, '+')) continue;
        char *longer = malloc(3 * strlen(uri) + 1), *to = longer;
        if (!longer) return;
        for (; *uri; uri++) {
            if (*uri == '+') {
                memcpy(to, "%2B", 3);
                to += 3;
            } else {
                *to++ = *uri;
            }
        }
        *to = 0;
        json_object_set_new(buffer, "uri", json_string(longer));
        free(longer);
    }
}

/* It wants a view below every accessor of indices; Draco brings its own. */
static void drop_draco_indices(json_t *json) {
    json_t *mesh, *primitive;
    size_t i, k;
    json_array_foreach(json_object_get(json, "meshes"), i, mesh) {
        json_array_foreach(json_object_get(mesh, "primitives"), k, primitive) {
            if (json_object_get(json_object_get(primitive, "extensions"),
                                "KHR_draco_mesh_compression"))
                json_object_del(primitive, "indices");
        }
    }
}

/* ---- Together again ------------------------------------------------------------------------------ */

static void put_word(unsigned char *to, uint32_t word) {
    for (int i = 0; i < 4; i++) to[i] = (unsigned char)(word >> 8 * i);
}

static size_t padded(size_t size) {
    return (size + 3) & ~(size_t)3;
}

static lobe_render_result assemble(const char *path, const json_t *json, const chunks *c,
                                   gltf_file *file) {
    char *text = json_dumps(json, JSON_COMPACT);
    if (!text) return lobe_fail_memory(path);
    const size_t length = strlen(text), json_size = padded(length);
    const size_t binary_size = c->binary_size ? padded(c->binary_size) + CHUNK_HEADER : 0;
    const size_t start = GLB_HEADER + CHUNK_HEADER;
    file->size = start + json_size + binary_size;
    file->glb = file->size < UINT32_MAX ? calloc(1, file->size) : NULL;
    if (file->glb) {
        put_word(file->glb, GLB_MAGIC);
        put_word(file->glb + 4, 2);
        put_word(file->glb + 8, (uint32_t)file->size);
        put_word(file->glb + GLB_HEADER, (uint32_t)json_size);
        put_word(file->glb + GLB_HEADER + 4, JSON_CHUNK);
        memset(file->glb + start, ' ', json_size);
        memcpy(file->glb + start, text, length);
    }
    if (file->glb && binary_size) {
        unsigned char *chunk = file->glb + start + json_size;
        put_word(chunk, (uint32_t)padded(c->binary_size));
        put_word(chunk + 4, BINARY_CHUNK);
        memcpy(chunk + CHUNK_HEADER, c->binary, c->binary_size);
    }
    free(text);
    return file->glb ? LOBE_RENDER_OK : lobe_fail_memory(path);
}

lobe_render_result lobe_gltf_file_read(const char *path, gltf_file *file) {
    *file = (gltf_file){NULL, 0};
    chunks c = {0};
    json_t *json = NULL;
    size_t size = 0;
    lobe_render_result result = read_bytes(path, &c, &size);
    if (result == LOBE_RENDER_OK) result = find_chunks(path, &c, size);
    if (result == LOBE_RENDER_OK) result = parse(path, &c, &json);
    if (result == LOBE_RENDER_OK) result = check_extensions(path, json);
    if (result == LOBE_RENDER_OK) result = check_depth(path, json);
    if (result == LOBE_RENDER_OK) {
        fill_empty_buffers(json);
        protect_plus(json);
        drop_draco_indices(json);
        result = assemble(path, json, &c, file);
    }
    json_decref(json);
    free(c.bytes);
    return result;
}
