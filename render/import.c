/* Files: glTF by its own importer, all others through Assimp: meshes, materials, textures, cameras, baked
 * into world space. */
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdio.h>
#include <string.h>

#include "image.h"
#include "import_camera.h"
#include "import_obj.h"
#include "import_pose.h"
#include "import_texture.h"
#include "inventory.h"
#include "scene.h"

static const char MATKEY_ANISOTROPY[] = "$mat.anisotropyFactor";

typedef struct importer {
    lobe_scene *scene;
    const struct aiScene *file;
    const lobe_scene_options *options;
    const char *path;
    uint32_t first_material;
    texture_reader textures;
    obj_reader obj;
    int is_obj;
    unsigned types_read, types_unread; /* bits of aiTextureType, of the material and of all */
    int has_turned_picture, has_other_set, has_projection, has_own_parameters, has_colors,
        has_lines;
} importer;

/* ---- Materials --------------------------------------------------------------------------------- */

/* Placing a picture, as FBX and Collada say it: scaled, then moved; v points up. */
static void read_transform(importer *k, const struct aiMaterial *m, enum aiTextureType type,
                           texture_map *map) {
    struct aiUVTransform t;
    if (aiGetMaterialUVTransform(m, "$tex.uvtrafo", (unsigned)type, 0, &t) != aiReturn_SUCCESS)
        return;
    map->u[0] = t.mScaling.x;
    map->u[2] = t.mTranslation.x;
    map->v[1] = t.mScaling.y;
    map->v[2] = 1.0f - t.mScaling.y - t.mTranslation.y;
    k->has_turned_picture |= t.mRotation != 0.0f;
}

static texture_wrap wrap_of(enum aiTextureMapMode mode) {
    return mode == aiTextureMapMode_Mirror                                    ? WRAP_MIRROR
           : mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? WRAP_CLAMP
                                                                              : WRAP_REPEAT;
}

/* Of the first type that the material has a picture of. */
static texture_map read_map(importer *k, const struct aiMaterial *m, enum aiTextureType type,
                            enum aiTextureType other, picture_use use) {
    struct aiString name;
    unsigned uv_set = 0;
    enum aiTextureMapping mapping = aiTextureMapping_UV;
    enum aiTextureMapMode modes[3] = {0};
    texture_map map = lobe_texture_map(NO_TEXTURE);
    if (aiGetMaterialTextureCount(m, type) == 0) type = other;
    if (aiGetMaterialTexture(m, type, 0, &name, &mapping, &uv_set, NULL, NULL, modes, NULL) !=
        aiReturn_SUCCESS)
        return map;
    k->types_read |= 1u << type;
    k->has_other_set |= uv_set != 0;
    k->has_projection |= mapping != aiTextureMapping_UV;
    map.texture = lobe_import_texture(&k->textures, name.data, use);
    map.wrap_u = wrap_of(modes[0]);
    map.wrap_v = wrap_of(modes[1]);
    read_transform(k, m, type, &map);
    return map;
}

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

/* The material that the importer puts where the file names none. */
static int is_fallback(const importer *k, unsigned index) {
    struct aiString name;
    return aiGetMaterialString(k->file->mMaterials[index], AI_MATKEY_NAME, &name) ==
               aiReturn_SUCCESS &&
           strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0;
}

/* A map is taken alone: many exporters leave the number beside it at 0. */
static float share_or(const struct aiMaterial *m, const char *key, const texture_map *map,
                      float fallback) {
    if (map->texture != NO_TEXTURE) return 1.0f;
    return clampf(read_float(m, key, fallback), 0.0f, 1.0f);
}

/* Nobody writes what cannot be seen: an opacity of 0 is a mistake in most files. */
static void read_opacity(importer *k, const struct aiMaterial *from, material *m) {
    const float opacity = read_float(from, "$mat.opacity", 1.0f);
    m->opacity_map = read_map(k, from, aiTextureType_OPACITY, aiTextureType_OPACITY, AS_OPACITY);
    if (opacity > 0.0f) m->alpha = fminf(opacity, 1.0f);
    if (m->alpha < 1.0f || m->opacity_map.texture != NO_TEXTURE) m->alpha_mode = ALPHA_BLEND;
}

/* What the material has beyond what was read of it. Ambient light and occlusion mean nothing to a path tracer. */
static void note_unread(importer *k, const struct aiMaterial *m) {
    const unsigned meaningless =
        1u << aiTextureType_AMBIENT | 1u << aiTextureType_AMBIENT_OCCLUSION;
    for (unsigned type = 1; type <= aiTextureType_UNKNOWN; type++) {
        const unsigned bit = 1u << type;
        if (aiGetMaterialTextureCount(m, (enum aiTextureType)type) > 0 &&
            !((k->types_read | meaningless) & bit))
            k->types_unread |= bit;
    }
    for (unsigned i = 0; i < m->mNumProperties; i++) {
        const struct aiMaterialProperty *p = m->mProperties[i];
        k->has_own_parameters |= strncmp(p->mKey.data, "$raw.3dsMax|main|", 17) == 0;
    }
    k->types_read = 0;
}

static material read_material(importer *k, unsigned index) {
    const struct aiMaterial *from = k->file->mMaterials[index];
    material m = lobe_fallback_material(k->options);
    if (is_fallback(k, index)) return m;
    vec3 diffuse = read_color(from, "$clr.diffuse", m.base_color);
    m.base_color = clamp_color(read_color(from, "$clr.base", diffuse));
    m.base_map = read_map(k, from, aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE, AS_COLOR);
    m.normal_map = read_map(k, from, aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, AS_VALUES);
    m.metallic_map = read_map(k, from, aiTextureType_METALNESS, aiTextureType_METALNESS, AS_VALUES);
    m.roughness_map = read_map(k, from, aiTextureType_DIFFUSE_ROUGHNESS,
                               aiTextureType_DIFFUSE_ROUGHNESS, AS_VALUES);
    m.metallic = share_or(from, "$mat.metallicFactor", &m.metallic_map, m.metallic);
    m.roughness = share_or(from, "$mat.roughnessFactor", &m.roughness_map, m.roughness);
    m.anisotropy = clampf(read_float(from, MATKEY_ANISOTROPY, 0.0f), -0.99f, 0.99f);
    vec3 emission = read_color(from, "$clr.emissive", v3_all(0.0f));
    m.emission = v3_scale(emission, fmaxf(read_float(from, "$mat.emissiveIntensity", 1.0f), 0.0f));
    if (v3_max(m.emission) > 0.0f)
        m.emission_map =
            read_map(k, from, aiTextureType_EMISSIVE, aiTextureType_EMISSION_COLOR, AS_COLOR);
    read_opacity(k, from, &m);
    note_unread(k, from);
    return m;
}

/* Each once. */
static void warn_of_materials(const importer *k) {
    warnings *w = &k->scene->warnings;
    for (unsigned type = 1; type <= aiTextureType_UNKNOWN; type++)
        if (k->types_unread >> type & 1)
            lobe_warn(w, "%s: its materials have %s pictures; they are ignored", k->path,
                      aiTextureTypeToString((enum aiTextureType)type));
    if (k->has_turned_picture)
        lobe_warn(w, "%s: has pictures that are turned; they are shown as they are", k->path);
    if (k->has_other_set)
        lobe_warn(w, "%s: has pictures by a second set of texture coordinates; the first is taken",
                  k->path);
    if (k->has_projection)
        lobe_warn(w, "%s: has pictures that are projected; they are shown by texture coordinates",
                  k->path);
    if (k->has_own_parameters)
        lobe_warn(w, "%s: its materials have parameters of one program alone; they are ignored",
                  k->path);
}

/* ---- Meshes ------------------------------------------------------------------------ */

static vec3 vector_of(struct aiVector3D v) {
    return v3(v.x, v.y, v.z);
}

static vertex read_vertex(const struct aiMesh *mesh, unsigned i) {
    vertex v = {.position = vector_of(mesh->mVertices[i]), .handedness = 1.0f};
    if (mesh->mNormals) v.normal = vector_of(mesh->mNormals[i]);
    if (mesh->mTextureCoords[0]) {
        v.u = mesh->mTextureCoords[0][i].x;
        /* rows from the top; only now: tangents are made while v still points up, as normal maps
           expect */
        v.v = 1.0f - mesh->mTextureCoords[0][i].y;
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
    char words[WORDS_ROOM] = "";
    lobe_add_word(words, mesh->mNormals != NULL, "normals");
    lobe_add_word(words, mesh->mColors[0] != NULL, "colours");
    lobe_add_word(words, mesh->mTextureCoords[0] != NULL, "texture coordinates");
    lobe_scene_note(k->scene, (lobe_scene_item){.part = LOBE_SCENE_MESH,
                                                .name = mesh->mName.data,
                                                .about = words,
                                                .count = mesh->mNumFaces,
                                                .uses = 1});
    k->has_colors |= mesh->mColors[0] != NULL;
    if (m >= k->scene->material_count) m = k->first_material;
    for (unsigned i = 0; i < mesh->mNumVertices; i++)
        lobe_scene_add_vertex(k->scene, read_vertex(mesh, i));
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        k->has_lines |= face->mNumIndices != 3;
        if (face->mNumIndices != 3) continue;
        lobe_scene_add_triangle(k->scene, first + face->mIndices[0], first + face->mIndices[1],
                                first + face->mIndices[2], m);
    }
}

static void read_scene(importer *k) {
    k->first_material = k->scene->material_count;
    for (unsigned i = 0; i < k->file->mNumMaterials; i++) {
        struct aiString name = {0};
        aiGetMaterialString(k->file->mMaterials[i], AI_MATKEY_NAME, &name);
        lobe_scene_note(k->scene,
                        (lobe_scene_item){.part = LOBE_SCENE_MATERIAL,
                                          .name = is_fallback(k, i) ? NO_MATERIAL : name.data});
        lobe_scene_add_material(
            k->scene, k->is_obj ? lobe_obj_material(&k->obj, name.data, &k->textures, k->options)
                                : read_material(k, i));
    }
    if (k->is_obj)
        lobe_obj_warn(&k->obj);
    else
        warn_of_materials(k);
    if (k->file->mNumMaterials == 0)
        lobe_scene_add_material(k->scene, lobe_fallback_material(k->options));
    for (unsigned i = 0; i < k->file->mNumMeshes; i++) read_mesh(k, k->file->mMeshes[i]);
    uint64_t dropped = k->scene->info.dropped_triangles;
    if (k->has_colors)
        lobe_warn(&k->scene->warnings, "%s: has colours of vertices; they are ignored", k->path);
    if (k->has_lines)
        lobe_warn(&k->scene->warnings, "%s: has points or lines; they are left out", k->path);
    if (dropped)
        lobe_warn(&k->scene->warnings,
                  "%s: %llu triangles without area or with a coordinate that "
                  "is not finite; they are left out",
                  k->path, (unsigned long long)dropped);
}

lobe_render_result lobe_scene_import(lobe_scene *s, const char *path,
                                     const lobe_scene_options *options) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: no such file and no built-in scene; list the built-in ones to see "
                         "their names",
                         path);
    char magic[4] = "";
    const int is_glb = fread(magic, 1, 4, file) == 4 && memcmp(magic, "glTF", 4) == 0;
    fclose(file);
    if (is_glb || lobe_path_ends(path, ".gltf") || lobe_path_ends(path, ".glb"))
        return lobe_scene_import_gltf(s, path, options);
    const unsigned steps = aiProcess_Triangulate | aiProcess_GenSmoothNormals |
                           aiProcess_CalcTangentSpace | aiProcess_PreTransformVertices |
                           aiProcess_SortByPType | aiProcess_JoinIdenticalVertices;
    importer k = {.scene = s, .options = options, .path = path, .obj = {.scene = s, .path = path}};
    k.is_obj = lobe_path_ends(path, ".obj");
    k.file = k.is_obj ? lobe_obj_read(&k.obj, aiProcess_ValidateDataStructure)
                      : aiImportFile(path, aiProcess_ValidateDataStructure);
    /* it is ours alone until it is let go of */
    struct aiScene *own = (struct aiScene *)(uintptr_t)k.file;
    lobe_render_result result = own ? lobe_import_pose(s, own, path, options) : LOBE_RENDER_OK;
    if (own && result == LOBE_RENDER_OK) {
        lobe_import_cameras(s, own);
        lobe_import_lights(s, own);
        k.file = aiApplyPostProcessing(own, steps);
    }
    if (!k.file)
        result = lobe_fail(LOBE_RENDER_BAD_INPUT,
                           "%s: cannot be read as a scene (%.200s); is it damaged?", path,
                           aiGetErrorString());
    if (result == LOBE_RENDER_OK) {
        k.textures = (texture_reader){.scene = s, .file = k.file, .path = path};
        read_scene(&k);
        lobe_import_textures_end(&k.textures);
    }
    aiReleaseImport(k.file);
    lobe_obj_free(&k.obj);
    return result;
}
