/* Files through Assimp: meshes, materials, textures, cameras, baked into world space. */
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <jansson.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image.h"
#include "scene.h"

static const char MATKEY_ANISOTROPY[] = "$mat.anisotropyFactor";

typedef struct importer {
    lobe_scene *scene;
    const struct aiScene *file;
    const lobe_scene_options *options;
    const char *path;
    uint32_t first_material;
} importer;

/* ---- Extensions that the importer would ignore silently ---------------------------------------- */

/* The JSON of a .gltf file or of the first chunk of a .glb file; NULL: neither. */
static json_t *read_gltf_json(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    uint32_t head[5] = {0};
    size_t words = fread(head, 4, 5, file);
    json_t *json = NULL;
    if (words == 5 && head[0] == 0x46546c67u && head[4] == 0x4e4f534au && head[3] < 1u << 28) {
        char *text = malloc(head[3]);
        if (text && fread(text, 1, head[3], file) == head[3])
            json = json_loadb(text, head[3], 0, NULL);
        free(text);
    } else if (lobe_path_ends(path, ".gltf")) {
        rewind(file);
        json = json_loadf(file, 0, NULL);
    }
    fclose(file);
    return json;
}

static lobe_render_result check_extensions(const char *path) {
    static const char *const refused[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression"};
    json_t *json = read_gltf_json(path), *name;
    const char *found = NULL;
    size_t i;
    json_array_foreach(json_object_get(json, "extensionsRequired"), i, name) {
        for (size_t k = 0; k < 2; k++)
            if (json_is_string(name) && strcmp(json_string_value(name), refused[k]) == 0)
                found = refused[k];
    }
    json_decref(json);
    if (!found) return LOBE_RENDER_OK;
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: needs the extension %s, which cannot be read; export without it", path,
                     found);
}

/* ---- Textures ---------------------------------------------------------------------------------- */

static int read_embedded(const struct aiTexture *embedded, texture *t, int is_srgb) {
    if (embedded->mHeight == 0)
        return lobe_texture_read_memory(t, embedded->pcData, embedded->mWidth, is_srgb);
    unsigned char *rgb = malloc(3 * (size_t)embedded->mWidth * embedded->mHeight);
    if (!rgb) return 0;
    for (size_t i = 0; i < (size_t)embedded->mWidth * embedded->mHeight; i++) {
        rgb[3 * i] = embedded->pcData[i].r;
        rgb[3 * i + 1] = embedded->pcData[i].g;
        rgb[3 * i + 2] = embedded->pcData[i].b;
    }
    *t = (texture){(int)embedded->mWidth, (int)embedded->mHeight, is_srgb, rgb};
    return 1;
}

/* "*3", or the name of a texture in the file; NULL: it lies outside. */
static const struct aiTexture *find_embedded(const struct aiScene *file, const char *name) {
    if (name[0] == '*') {
        unsigned long i = strtoul(name + 1, NULL, 10);
        return i < file->mNumTextures ? file->mTextures[i] : NULL;
    }
    for (unsigned i = 0; i < file->mNumTextures; i++)
        if (file->mTextures[i]->mFilename.length &&
            strcmp(file->mTextures[i]->mFilename.data, name) == 0)
            return file->mTextures[i];
    return NULL;
}

/* A texture beside the scene's file. */
static int read_beside(const importer *k, const char *name, texture *t, int is_srgb) {
    char path[PATH_MAX];
    const char *slash = strrchr(k->path, '/');
    int folder = slash && name[0] != '/' ? (int)(slash - k->path) + 1 : 0;
    if (snprintf(path, sizeof path, "%.*s%s", folder, k->path, name) >= (int)sizeof path) return 0;
    for (char *c = path + folder; *c; c++)
        if (*c == '\\') *c = '/';
    return lobe_texture_read_file(t, path, is_srgb);
}

/* Index of the texture, or NO_TEXTURE if the material names none. A missing one is magenta. */
static int read_texture(importer *k, const struct aiMaterial *m, enum aiTextureType type,
                        int is_srgb) {
    struct aiString name;
    if (aiGetMaterialTexture(m, type, 0, &name, NULL, NULL, NULL, NULL, NULL, NULL) !=
        aiReturn_SUCCESS)
        return NO_TEXTURE;
    const struct aiTexture *embedded = find_embedded(k->file, name.data);
    texture t;
    int ok =
        embedded ? read_embedded(embedded, &t, is_srgb) : read_beside(k, name.data, &t, is_srgb);
    if (!ok) {
        k->scene->info.missing_textures++;
        lobe_warn(&k->scene->warnings,
                  "%s: texture %s is missing or unreadable; it is shown in "
                  "magenta",
                  k->path, name.data);
        if (!is_srgb) return NO_TEXTURE;
        if (!lobe_texture_solid(&t, v3(1.0f, 0.0f, 1.0f), 1)) return NO_TEXTURE;
    }
    return lobe_scene_add_texture(k->scene, t);
}

/* ---- Materials --------------------------------------------------------------------------------- */

static float read_float(const struct aiMaterial *m, const char *key, float fallback) {
    float value;
    if (aiGetMaterialFloatArray(m, key, 0, 0, &value, NULL) != aiReturn_SUCCESS) return fallback;
    return isfinite(value) ? value : fallback;
}

static vec3 read_color(const struct aiMaterial *m, const char *key, vec3 fallback) {
    struct aiColor4D c;
    if (aiGetMaterialColor(m, key, 0, 0, &c) != aiReturn_SUCCESS) return fallback;
    vec3 color = {c.r, c.g, c.b};
    return v3_is_finite(color) ? color : fallback;
}

static vec3 clamp_color(vec3 c) {
    return v3(clampf(c.x, 0.0f, 1.0f), clampf(c.y, 0.0f, 1.0f), clampf(c.z, 0.0f, 1.0f));
}

/* What a file without materials gets, from the options. */
static material fallback_material(const lobe_scene_options *o) {
    material m = lobe_default_material();
    m.base_color = v3(o->default_base_color[0], o->default_base_color[1], o->default_base_color[2]);
    m.metallic = o->default_metallic;
    m.roughness = o->default_roughness;
    return m;
}

static int is_fallback(const struct aiMaterial *m) {
    struct aiString name;
    return aiGetMaterialString(m, AI_MATKEY_NAME, &name) != aiReturn_SUCCESS ||
           strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0;
}

static material read_material(importer *k, const struct aiMaterial *from) {
    material m = fallback_material(k->options);
    if (is_fallback(from)) return m;
    vec3 diffuse = read_color(from, "$clr.diffuse", m.base_color);
    m.base_color = clamp_color(read_color(from, "$clr.base", diffuse));
    m.metallic = clampf(read_float(from, "$mat.metallicFactor", m.metallic), 0.0f, 1.0f);
    m.roughness = clampf(read_float(from, "$mat.roughnessFactor", m.roughness), 0.0f, 1.0f);
    m.anisotropy = clampf(read_float(from, MATKEY_ANISOTROPY, 0.0f), -0.99f, 0.99f);
    vec3 emission = read_color(from, "$clr.emissive", v3_all(0.0f));
    m.emission = v3_scale(emission, fmaxf(read_float(from, "$mat.emissiveIntensity", 1.0f), 0.0f));
    m.base_texture = read_texture(k, from, aiTextureType_BASE_COLOR, 1);
    if (m.base_texture == NO_TEXTURE)
        m.base_texture = read_texture(k, from, aiTextureType_DIFFUSE, 1);
    m.normal_texture = read_texture(k, from, aiTextureType_NORMALS, 0);
    m.surface_texture = read_texture(k, from, aiTextureType_METALNESS, 0);
    if (v3_max(m.emission) > 0.0f)
        m.emission_texture = read_texture(k, from, aiTextureType_EMISSIVE, 1);
    return m;
}

/* ---- Meshes and cameras ------------------------------------------------------------------------ */

static vec3 vector_of(struct aiVector3D v) {
    return v3(v.x, v.y, v.z);
}

static vertex read_vertex(const struct aiMesh *mesh, unsigned i) {
    vertex v = {.position = vector_of(mesh->mVertices[i]), .handedness = 1.0f};
    if (mesh->mNormals) v.normal = vector_of(mesh->mNormals[i]);
    if (mesh->mTextureCoords[0]) {
        v.u = mesh->mTextureCoords[0][i].x;
        v.v = mesh->mTextureCoords[0][i].y;
    }
    if (mesh->mTangents && mesh->mBitangents) {
        v.tangent = vector_of(mesh->mTangents[i]);
        vec3 across = v3_cross(v.normal, v.tangent);
        if (v3_dot(across, vector_of(mesh->mBitangents[i])) < 0.0f) v.handedness = -1.0f;
    }
    return v;
}

static void read_mesh(importer *k, const struct aiMesh *mesh) {
    uint32_t first = k->scene->vertex_count;
    uint32_t m = k->first_material + mesh->mMaterialIndex;
    if (m >= k->scene->material_count) m = k->first_material;
    for (unsigned i = 0; i < mesh->mNumVertices; i++)
        lobe_scene_add_vertex(k->scene, read_vertex(mesh, i));
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        if (face->mNumIndices != 3) continue;
        lobe_scene_add_triangle(k->scene, first + face->mIndices[0], first + face->mIndices[1],
                                first + face->mIndices[2], m);
    }
}

static void read_camera(importer *k, const struct aiCamera *c) {
    vec3 position = vector_of(c->mPosition);
    float aspect = c->mAspect > 0.0f ? c->mAspect : 16.0f / 9.0f;
    float vertical = 2.0f * atanf(tanf(0.5f * c->mHorizontalFOV) / aspect) * (180.0f / LOBE_PI);
    if (!v3_is_finite(position) || !(vertical > 0.1f && vertical < 179.0f)) return;
    lobe_scene_add_camera(k->scene, c->mName.data, position,
                          v3_add(position, vector_of(c->mLookAt)), vertical);
}

static lobe_render_result read_scene(importer *k) {
    k->first_material = k->scene->material_count;
    for (unsigned i = 0; i < k->file->mNumMaterials; i++)
        lobe_scene_add_material(k->scene, read_material(k, k->file->mMaterials[i]));
    if (k->file->mNumMaterials == 0)
        lobe_scene_add_material(k->scene, fallback_material(k->options));
    for (unsigned i = 0; i < k->file->mNumMeshes; i++) read_mesh(k, k->file->mMeshes[i]);
    for (unsigned i = 0; i < k->file->mNumCameras; i++) read_camera(k, k->file->mCameras[i]);
    uint64_t dropped = k->scene->info.dropped_triangles;
    if (dropped)
        lobe_warn(&k->scene->warnings,
                  "%s: %llu triangles without area or with a coordinate that "
                  "is not finite; they are left out",
                  k->path, (unsigned long long)dropped);
    return LOBE_RENDER_OK;
}

lobe_render_result lobe_scene_import(lobe_scene *s, const char *path,
                                     const lobe_scene_options *options) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: no such file and no built-in scene; list the built-in ones to see "
                         "their names",
                         path);
    fclose(file);
    lobe_render_result result = check_extensions(path);
    if (result != LOBE_RENDER_OK) return result;
    const unsigned steps = aiProcess_Triangulate | aiProcess_GenSmoothNormals |
                           aiProcess_CalcTangentSpace | aiProcess_PreTransformVertices |
                           aiProcess_SortByPType | aiProcess_FlipUVs |
                           aiProcess_ValidateDataStructure;
    importer k = {.scene = s, .options = options, .path = path};
    k.file = aiImportFile(path, steps);
    if (!k.file) {
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: cannot be read as a scene (%.200s); is it damaged?", path,
                         aiGetErrorString());
    }
    result = read_scene(&k);
    aiReleaseImport(k.file);
    return result;
}
