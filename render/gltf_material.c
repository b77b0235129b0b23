#include "gltf_material.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import_texture.h"
#include "inventory.h"

/* Indices of a picture in the scene, as a colour and as raw values; UNREAD: not yet. */
enum { UNREAD = -2 };
typedef struct picture {
    int as_values, as_color;
    int is_missing; /* and that was said */
} picture;

typedef struct material_reader {
    lobe_scene *scene;
    gltf_reader *reader;
    picture *pictures; /* of each image; the last one is for textures without */
} material_reader;

static float unit(double x) {
    return clampf((float)x, 0.0f, 1.0f);
}

static float finite_or(double x, float fallback) {
    return isfinite((float)x) ? (float)x : fallback;
}

/* ---- Textures ------------------------------------------------------------------------------------ */

static int read_picture(material_reader *k, size_t index, texture *t, int is_srgb) {
    const gltf_model *m = k->reader->model;
    if (index == m->image_count) return 0;
    const gltf_image *image = &m->images[index];
    gltf_bytes bytes = image->bytes;
    if (image->view >= 0)
        return lobe_gltf_view_bytes(k->reader, image->view, &bytes) == LOBE_RENDER_OK &&
               lobe_texture_read_memory(t, bytes.data, bytes.size, is_srgb);
    if (bytes.size > 0) return lobe_texture_read_memory(t, bytes.data, bytes.size, is_srgb);
    /* tinygltf misses some names: see what lies beside under the name as it is */
    return image->uri[0] && lobe_import_texture_beside(k->reader->path, image->uri, t, is_srgb);
}

/* Say once that a picture is missing. */
static void miss_picture(material_reader *k, size_t index) {
    const gltf_model *m = k->reader->model;
    char name[40] = "without a picture";
    if (k->pictures[index].is_missing) return;
    k->pictures[index].is_missing = 1;
    if (index < m->image_count) snprintf(name, sizeof name, "of image %zu", index);
    const int has_uri = index < m->image_count && m->images[index].uri[0];
    lobe_import_missing_texture(k->scene, k->reader->path, has_uri ? m->images[index].uri : name);
}

static void note_picture(const material_reader *k, size_t index) {
    const gltf_model *m = k->reader->model;
    if (index >= m->image_count) return;
    const gltf_image *image = &m->images[index];
    lobe_scene_note(k->scene,
                    (lobe_scene_item){.part = LOBE_SCENE_TEXTURE,
                                      .name = image->uri[0] && strncmp(image->uri, "data:", 5) != 0
                                                  ? image->uri
                                                  : image->name});
}

/* Index in the scene of what a texture of the file shows. */
static int read_source(material_reader *k, int texture_index, int is_srgb) {
    const gltf_model *m = k->reader->model;
    const int image = texture_index >= 0 && (size_t)texture_index < m->texture_count
                          ? m->textures[texture_index].image
                          : -1;
    const size_t index =
        image >= 0 && (size_t)image < m->image_count ? (size_t)image : m->image_count;
    picture *p = &k->pictures[index];
    int *known = is_srgb ? &p->as_color : &p->as_values;
    if (*known != UNREAD) return *known;
    texture t;
    if (read_picture(k, index, &t, is_srgb)) {
        note_picture(k, index);
        return *known = lobe_scene_add_texture(k->scene, t);
    }
    miss_picture(k, index);
    return *known = lobe_import_magenta(k->scene, is_srgb);
}

static texture_wrap wrap_of(int gltf_wrap) {
    return gltf_wrap == GLTF_CLAMP ? WRAP_CLAMP
                                   : (gltf_wrap == GLTF_MIRROR ? WRAP_MIRROR : WRAP_REPEAT);
}

/* Where the set lies in the vertex: the first free place. A third set finds none. */
static int place_of_set(material_reader *k, material_needs *needs, int set) {
    for (int i = 0; i < 2; i++) {
        if (needs->uv_sets[i] < 0) needs->uv_sets[i] = set;
        if (needs->uv_sets[i] == set) return i;
    }
    lobe_warn(
        &k->scene->warnings,
        "%s: material with more than two sets of texture coordinates; the first ones are used",
        k->reader->path);
    return 0;
}

/* KHR_texture_transform: scale, then rotate counter-clockwise (v points down), then move. */
static void set_transform(texture_map *map, const gltf_texture_use *use) {
    const float sine = sinf((float)use->rotation), cosine = cosf((float)use->rotation);
    const float x = (float)use->scale[0], y = (float)use->scale[1];
    map->u[0] = cosine * x;
    map->u[1] = sine * y;
    map->u[2] = (float)use->offset[0];
    map->v[0] = -sine * x;
    map->v[1] = cosine * y;
    map->v[2] = (float)use->offset[1];
}

static void set_small_filter(texture_map *map, int filter) {
    map->is_nearest_small = filter == GLTF_NEAREST || filter == GLTF_NEAREST_MIPMAP_NEAREST ||
                            filter == GLTF_NEAREST_MIPMAP_LINEAR;
    map->levels = LEVELS_BLENDED;
    if (filter == GLTF_NEAREST || filter == GLTF_BILINEAR) map->levels = LEVELS_NONE;
    if (filter == GLTF_NEAREST_MIPMAP_NEAREST || filter == GLTF_LINEAR_MIPMAP_NEAREST)
        map->levels = LEVELS_NEAREST;
}

static texture_map read_map(material_reader *k, const gltf_texture_use *use, int is_srgb,
                            material_needs *needs) {
    const gltf_model *m = k->reader->model;
    texture_map map = lobe_texture_map(NO_TEXTURE);
    if (use->texture < 0) return map;
    map.texture = read_source(k, use->texture, is_srgb);
    map.uv_set = place_of_set(k, needs, use->uv_set);
    set_transform(&map, use);
    if ((size_t)use->texture >= m->texture_count) return map;
    const gltf_texture *t = &m->textures[use->texture];
    map.wrap_u = wrap_of(t->wrap_u);
    map.wrap_v = wrap_of(t->wrap_v);
    map.is_nearest = t->filter == GLTF_NEAREST;
    set_small_filter(&map, t->small_filter);
    return map;
}

/* ---- Materials ----------------------------------------------------------------------------------- */

static vec3 emission_of(const gltf_material *from) {
    const float strength = fmaxf(finite_or(from->emissive_strength, 1.0f), 0.0f);
    const vec3 color = {unit(from->emission[0]), unit(from->emission[1]), unit(from->emission[2])};
    return v3_scale(color, strength);
}

/* 0 stands for an infinite index, an old way to say what is reflected. */
static float index_of(double ior) {
    const float largest = 1000.0f;
    if (ior == 0.0) return largest;
    return fminf(fmaxf(finite_or(ior, COAT_IOR), 1.0f), largest);
}

/* color = exp(-absorption distance). Black takes what a float can hold. */
static float absorption_of(double color, double distance) {
    if (!(distance > 0.0) || !(color < 1.0)) return 0.0f;
    return (float)fmin(-log(fmax(color, 1e-30)) / distance, 1e30);
}

static void read_specular(material_reader *k, const gltf_material *from, material_needs *needs,
                          material *m) {
    const double *color = from->specular_color;
    m->specular = unit(from->specular);
    m->specular_color =
        v3(fmaxf(finite_or(color[0], 1.0f), 0.0f), fmaxf(finite_or(color[1], 1.0f), 0.0f),
           fmaxf(finite_or(color[2], 1.0f), 0.0f));
    if (!(m->specular > 0.0f)) return;
    m->specular_map = read_map(k, &from->specular_share, 0, needs);
    m->specular_color_map = read_map(k, &from->specular_tint, 1, needs);
}

static void read_clearcoat(material_reader *k, const gltf_material *from, material_needs *needs,
                           material *m) {
    m->clearcoat = unit(from->clearcoat);
    if (!(m->clearcoat > 0.0f)) return;
    m->clearcoat_roughness = unit(from->clearcoat_roughness);
    m->clearcoat_normal_scale = finite_or(from->clearcoat_normal_scale, 1.0f);
    m->clearcoat_normal_map = read_map(k, &from->clearcoat_normal, 0, needs);
    m->clearcoat_map = read_map(k, &from->clearcoat_share, 0, needs);
    m->clearcoat_roughness_map = read_map(k, &from->clearcoat_rough, 0, needs);
}

static void read_glass(material_reader *k, const gltf_material *from, material_needs *needs,
                       material *m) {
    const double *color = from->attenuation_color, distance = from->attenuation_distance;
    m->ior = index_of(from->ior);
    m->transmission = unit(from->transmission);
    if (!(m->transmission > 0.0f)) return;
    if (m->specular < 1.0f || v3_max(m->specular_color) != 1.0f ||
        m->specular_map.texture != NO_TEXTURE || m->specular_color_map.texture != NO_TEXTURE)
        lobe_warn(&k->scene->warnings,
                  "%s: KHR_materials_specular of a material that transmits; what does not "
                  "transmit has it, the glass has not",
                  k->reader->path);
    m->transmission_map = read_map(k, &from->transmissive, 0, needs);
    m->thickness = fmaxf(finite_or(from->thickness, 0.0f), 0.0f);
    m->absorption = v3(absorption_of(color[0], distance), absorption_of(color[1], distance),
                       absorption_of(color[2], distance));
}

static material read_material(material_reader *k, const gltf_material *from,
                              material_needs *needs) {
    material m = lobe_default_material();
    /* the normal map first: its coordinates make the tangents */
    m.normal_map = read_map(k, &from->normal, 0, needs);
    m.base_map = read_map(k, &from->base, 1, needs);
    m.roughness_map = m.metallic_map = read_map(k, &from->surface, 0, needs);
    m.base_color =
        v3(unit(from->base_color[0]), unit(from->base_color[1]), unit(from->base_color[2]));
    m.metallic = unit(from->metallic);
    m.roughness = unit(from->roughness);
    m.normal_scale = finite_or(from->normal_scale, 1.0f);
    m.is_unlit = from->is_unlit;
    m.emission = emission_of(from);
    if (v3_max(m.emission) > 0.0f) m.emission_map = read_map(k, &from->emissive, 1, needs);
    m.alpha = unit(from->base_color[3]);
    m.alpha_cutoff = finite_or(from->alpha_cutoff, 0.5f);
    m.alpha_mode = from->alpha == GLTF_MASK    ? ALPHA_MASK
                   : from->alpha == GLTF_BLEND ? ALPHA_BLEND
                                               : ALPHA_OPAQUE;
    m.stretch = unit(from->anisotropy);
    m.stretch_x = cosf(finite_or(from->anisotropy_rotation, 0.0f));
    m.stretch_y = sinf(finite_or(from->anisotropy_rotation, 0.0f));
    if (m.stretch > 0.0f) m.stretch_map = read_map(k, &from->anisotropic, 0, needs);
    read_clearcoat(k, from, needs, &m);
    read_specular(k, from, needs, &m);
    read_glass(k, from, needs, &m);
    /* tangents are along the first set, if nothing asks for another one */
    if (m.stretch > 0.0f && needs->uv_sets[0] < 0) needs->uv_sets[0] = 0;
    return m;
}

lobe_render_result lobe_gltf_read_materials(lobe_scene *s, gltf_reader *r,
                                            const lobe_scene_options *options,
                                            material_needs **needs) {
    const gltf_model *m = r->model;
    material_reader k = {s, r, malloc((m->image_count + 1) * sizeof *k.pictures)};
    *needs = malloc((m->material_count + 1) * sizeof **needs);
    if (!k.pictures || !*needs) {
        free(k.pictures);
        return lobe_fail_memory(r->path);
    }
    for (size_t i = 0; i <= m->image_count; i++) k.pictures[i] = (picture){UNREAD, UNREAD, 0};
    for (size_t i = 0; i <= m->material_count; i++) {
        material_needs *n = &(*needs)[i];
        *n = (material_needs){0, {-1, -1}};
        const int is_named = i < m->material_count;
        lobe_scene_note(s,
                        (lobe_scene_item){.part = LOBE_SCENE_MATERIAL,
                                          .name = is_named ? m->materials[i].name : NO_MATERIAL});
        n->material = lobe_scene_add_material(s, is_named ? read_material(&k, &m->materials[i], n)
                                                          : lobe_fallback_material(options));
    }
    free(k.pictures);
    return LOBE_RENDER_OK;
}
