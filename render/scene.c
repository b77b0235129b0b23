#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "framing.h"
#include "inventory.h"

/* Room for one more element of a growing array; 0: no memory. */
static int grow(void **array, uint32_t count, uint32_t *room, size_t size) {
    if (count < *room) return 1;
    if (*room > UINT32_MAX / 2) return 0;
    uint32_t larger = *room ? 2 * *room : 64;
    void *moved = realloc(*array, larger * size);
    if (!moved) return 0;
    *array = moved;
    *room = larger;
    return 1;
}

/* Append `item` and give its index; 0 and a note where memory is short. */
#define APPEND(scene, array, noun, item)                                                           \
    do {                                                                                           \
        if (!grow((void **)&(scene)->array, (scene)->noun##_count, &(scene)->noun##_room,          \
                  sizeof *(scene)->array)) {                                                       \
            (scene)->out_of_memory = 1;                                                            \
            return 0;                                                                              \
        }                                                                                          \
        (scene)->array[(scene)->noun##_count] = (item);                                            \
        return (scene)->noun##_count++;                                                            \
    } while (0)

uint32_t lobe_scene_add_material(lobe_scene *s, material m) {
    APPEND(s, materials, material, m);
}

uint32_t lobe_scene_add_vertex(lobe_scene *s, vertex v) {
    APPEND(s, vertices, vertex, v);
}

uint32_t lobe_scene_add_lamp(lobe_scene *s, lamp l) {
    APPEND(s, lamps, lamp, l);
}

static uint32_t append_shape(lobe_scene *s, shape range) {
    APPEND(s, shapes, shape, range);
}

static uint32_t append_instance(lobe_scene *s, instance i) {
    APPEND(s, instances, instance, i);
}

static uint32_t append_triangle(lobe_scene *s, triangle t) {
    APPEND(s, triangles, triangle, t);
}

static uint32_t append_texture(lobe_scene *s, texture t) {
    APPEND(s, textures, texture, t);
}

static uint32_t append_camera(lobe_scene *s, camera c) {
    APPEND(s, cameras, camera, c);
}

int lobe_scene_add_texture(lobe_scene *s, texture t) {
    return (int)append_texture(s, t);
}

void lobe_scene_add_camera(lobe_scene *s, const char *name, vec3 position, vec3 target, vec3 up,
                           float vertical_degrees) {
    camera c = {
        .position = position, .target = target, .up = up, .vertical_degrees = vertical_degrees};
    snprintf(c.name, sizeof c.name, "%s", name);
    append_camera(s, c);
}

static float area_of(vec3 a, vec3 b, vec3 c) {
    return 0.5f * v3_length(v3_cross(v3_sub(b, a), v3_sub(c, a)));
}

uint32_t lobe_scene_add_shape(lobe_scene *s, uint32_t first) {
    return append_shape(s, (shape){first, s->triangle_count - first});
}

/* What a determinant may be, so that the inverse keeps a float's digits and range. */
static const double DETERMINANT_MIN = 1e-24, DETERMINANT_MAX = 1e24;

int lobe_scene_add_instance(lobe_scene *s, uint32_t shape, const affine *to_world) {
    const normal_transform turn = lobe_affine_normals(to_world);
    if (!lobe_affine_is_finite(to_world) || !(turn.determinant > DETERMINANT_MIN) ||
        !(turn.determinant < DETERMINANT_MAX))
        return 0;
    instance i = {.shape = shape, .sign = (float)turn.sign};
    for (int k = 0; k < 12; k++) i.to_world[k] = (float)to_world->m[k % 3][k / 3];
    for (int k = 0; k < 9; k++) i.normals[k] = (float)turn.cofactors.m[k % 3][k / 3];
    append_instance(s, i);
    return 1;
}

/* A triangle that has no area or is not finite would poison the tree: dropped and counted. */
void lobe_scene_add_triangle(lobe_scene *s, uint32_t a, uint32_t b, uint32_t c, uint32_t material) {
    uint32_t n = s->vertex_count;
    int usable = a < n && b < n && c < n;
    if (usable) {
        float area =
            area_of(s->vertices[a].position, s->vertices[b].position, s->vertices[c].position);
        usable = isfinite(area) && area > 0.0f;
    }
    if (usable)
        append_triangle(s, (triangle){{a, b, c}, material, -1});
    else
        s->info.dropped_triangles++;
}

material lobe_default_material(void) {
    return (material){.base_color = {0.8f, 0.8f, 0.8f},
                      .roughness = 0.5f,
                      .stretch_x = 1.0f,
                      .alpha = 1.0f,
                      .clearcoat_normal_scale = 1.0f,
                      .specular = 1.0f,
                      .specular_color = {1.0f, 1.0f, 1.0f},
                      .ior = COAT_IOR,
                      .normal_scale = 1.0f,
                      .base_map = lobe_texture_map(NO_TEXTURE),
                      .normal_map = lobe_texture_map(NO_TEXTURE),
                      .opacity_map = lobe_texture_map(NO_TEXTURE),
                      .roughness_map = lobe_texture_map(NO_TEXTURE),
                      .metallic_map = lobe_texture_map(NO_TEXTURE),
                      .emission_map = lobe_texture_map(NO_TEXTURE),
                      .stretch_map = lobe_texture_map(NO_TEXTURE),
                      .transmission_map = lobe_texture_map(NO_TEXTURE),
                      .specular_map = lobe_texture_map(NO_TEXTURE),
                      .specular_color_map = lobe_texture_map(NO_TEXTURE),
                      .clearcoat_map = lobe_texture_map(NO_TEXTURE),
                      .clearcoat_roughness_map = lobe_texture_map(NO_TEXTURE),
                      .clearcoat_normal_map = lobe_texture_map(NO_TEXTURE)};
}

material lobe_fallback_material(const lobe_scene_options *o) {
    material m = lobe_default_material();
    m.base_color = v3(o->default_base_color[0], o->default_base_color[1], o->default_base_color[2]);
    m.metallic = o->default_metallic;
    m.roughness = o->default_roughness;
    return m;
}

lobe_scene_options lobe_scene_default_options(void) {
    return (lobe_scene_options){.default_base_color = {0.8f, 0.8f, 0.8f},
                                .default_roughness = 0.5f,
                                .frame_time = (double)NAN};
}

void lobe_scene_free(lobe_scene *s) {
    if (!s) return;
    lobe_tracer_free(s->tracer);
    for (uint32_t i = 0; i < s->texture_count; i++) lobe_texture_free(&s->textures[i]);
    if (s->has_sky) lobe_environment_free(&s->sky);
    lobe_alias_free(&s->light_table);
    lobe_light_tree_free(&s->light_tree);
    lobe_inventory_free(&s->inventory);
    free(s->vertices);
    free(s->triangles);
    free(s->shapes);
    free(s->instances);
    free(s->materials);
    free(s->textures);
    free(s->cameras);
    free(s->lamps);
    free(s->lights);
    free(s->light_areas);
    free(s);
}

/* What varies over a triangle (a texture, the opacity) is left to the paths that meet it. */
int lobe_is_even_light(const material *m) {
    return v3_max(m->emission) > 0.0f && m->emission_map.texture == NO_TEXTURE &&
           m->alpha_mode == ALPHA_OPAQUE && !m->is_unlit;
}

/* Over pi, as that of triangles; a directional lamp shines on the disk of the scene. */
static double power_of_lamp(const lobe_scene *s, const lamp *l) {
    const double intensity = (double)v3_luminance(l->intensity);
    if (l->kind == LAMP_POINT) return 4.0 * intensity;
    if (l->kind == LAMP_SPOT) return 2.0 * (1.0 - (double)l->cos_outer) * intensity;
    const double radius = 0.5 * (double)v3_length(v3_sub(s->high, s->low));
    return radius * radius * intensity;
}

/* Sums of powers stay finite, whatever a file says. */
static const double POWER_MAX = 1e60;

/* The first triangle that lies in the world. */
static uint32_t world_of(const lobe_scene *s) {
    const shape *last = s->shape_count ? &s->shapes[s->shape_count - 1] : NULL;
    return last ? last->first + last->count : 0;
}

static size_t count_lights(const lobe_scene *s) {
    size_t count = 0;
    for (uint32_t i = world_of(s); i < s->triangle_count; i++)
        count += (size_t)lobe_is_even_light(&s->materials[s->triangles[i].material]);
    return count;
}

static light_bounds bounds_of_triangle(const lobe_scene *s, const triangle *t) {
    const vec3 a = s->vertices[t->vertex[0]].position, b = s->vertices[t->vertex[1]].position,
               c = s->vertices[t->vertex[2]].position;
    const vec3 normal = v3_cross(v3_sub(b, a), v3_sub(c, a));
    return (light_bounds){
        .low = v3(minf(a.x, minf(b.x, c.x)), minf(a.y, minf(b.y, c.y)), minf(a.z, minf(b.z, c.z))),
        .high = v3(maxf(a.x, maxf(b.x, c.x)), maxf(a.y, maxf(b.y, c.y)), maxf(a.z, maxf(b.z, c.z))),
        .axis = v3_normalize_or(normal, v3(0.0f, 1.0f, 0.0f)),
        .beyond = 0.5f * LOBE_PI,
        .two_sided = 1};
}

static light_bounds bounds_of_lamp(const lamp *l) {
    const int is_spot = l->kind == LAMP_SPOT;
    return (light_bounds){.low = l->position,
                          .high = l->position,
                          .axis = v3_normalize_or(l->direction, v3(0.0f, 1.0f, 0.0f)),
                          .spread = is_spot ? 0.0f : LOBE_PI,
                          .beyond =
                              is_spot ? acosf(clampf(l->cos_outer, -1.0f, 1.0f)) : 0.5f * LOBE_PI};
}

/* 0: no memory. */
static int plant_light_tree(lobe_scene *s) {
    const uint32_t count = s->light_count + s->lamp_count;
    if (!s->light_table.shares) return 1;
    light_bounds *lights = malloc(((size_t)count + 1) * sizeof *lights);
    for (uint32_t i = 0; lights && i < count; i++) {
        const lamp *l = i < s->light_count ? NULL : &s->lamps[i - s->light_count];
        lights[i] = l ? bounds_of_lamp(l) : bounds_of_triangle(s, &s->triangles[s->lights[i]]);
        const int is_far = l && l->kind == LAMP_DIRECTIONAL;
        if (is_far) s->far_share += s->light_table.shares[i];
        lights[i].power = is_far ? 0.0f : s->light_table.shares[i];
    }
    const int is_good = lights && lobe_light_tree_create(&s->light_tree, lights, count);
    free(lights);
    if (!s->light_tree.nodes) s->far_share = 1.0f;
    return is_good;
}

static int collect_lights(lobe_scene *s) {
    const size_t count = count_lights(s);
    s->lights = malloc((count + 1) * sizeof *s->lights);
    s->light_areas = malloc((count + 1) * sizeof *s->light_areas);
    double *powers = malloc((count + s->lamp_count + 1) * sizeof *powers);
    int ok = s->lights && s->light_areas && powers;
    for (uint32_t i = world_of(s); ok && i < s->triangle_count; i++) {
        triangle *t = &s->triangles[i];
        const material *m = &s->materials[t->material];
        if (!lobe_is_even_light(m)) continue;
        float area = area_of(s->vertices[t->vertex[0]].position, s->vertices[t->vertex[1]].position,
                             s->vertices[t->vertex[2]].position);
        t->light = (int32_t)s->light_count;
        s->lights[s->light_count] = i;
        s->light_areas[s->light_count] = area;
        powers[s->light_count++] =
            fmin((double)area * (double)v3_luminance(m->emission), POWER_MAX);
    }
    for (uint32_t i = 0; ok && i < s->lamp_count; i++)
        powers[s->light_count + i] = fmin(power_of_lamp(s, &s->lamps[i]), POWER_MAX);
    ok = ok && lobe_alias_create(&s->light_table, powers, s->light_count + s->lamp_count) &&
         plant_light_tree(s);
    free(powers);
    return ok;
}

static int is_scene_opaque(const lobe_scene *s) {
    for (uint32_t i = 0; i < s->material_count; i++)
        if (s->materials[i].alpha_mode != ALPHA_OPAQUE) return 0;
    return 1;
}

typedef struct bounds {
    vec3 low, high;
} bounds;

static const bounds nowhere = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void enclose(bounds *b, vec3 p) {
    b->low = v3(fminf(b->low.x, p.x), fminf(b->low.y, p.y), fminf(b->low.z, p.z));
    b->high = v3(fmaxf(b->high.x, p.x), fmaxf(b->high.y, p.y), fmaxf(b->high.z, p.z));
}

static bounds bounds_of(const lobe_scene *s, uint32_t first, uint32_t end) {
    bounds b = nowhere;
    for (uint32_t i = first; i < end; i++)
        for (int k = 0; k < 3; k++) enclose(&b, s->vertices[s->triangles[i].vertex[k]].position);
    return b;
}

/* The corners of a shape's box, moved. */
static void enclose_instance(bounds *b, const bounds *box, const instance *i) {
    for (int corner = 0; corner < 8; corner++) {
        const vec3 p = {corner & 1 ? box->high.x : box->low.x,
                        corner & 2 ? box->high.y : box->low.y,
                        corner & 4 ? box->high.z : box->low.z};
        enclose(b, lobe_instance_point(i, p));
    }
}

/* 0: no memory. */
static int find_bounds(lobe_scene *s) {
    bounds all = bounds_of(s, world_of(s), s->triangle_count);
    bounds *boxes = malloc(((size_t)s->shape_count + 1) * sizeof *boxes);
    if (!boxes) return 0;
    for (uint32_t i = 0; i < s->shape_count; i++)
        boxes[i] = bounds_of(s, s->shapes[i].first, s->shapes[i].first + s->shapes[i].count);
    for (uint32_t i = 0; i < s->instance_count; i++)
        enclose_instance(&all, &boxes[s->instances[i].shape], &s->instances[i]);
    free(boxes);
    s->low = all.low;
    s->high = all.high;
    return 1;
}

static void add_ground(lobe_scene *s) {
    float size = 20.0f * fmaxf(v3_length(v3_sub(s->high, s->low)), 1e-6f), y = s->low.y;
    material grey = lobe_default_material();
    grey.base_color = v3_all(0.4f);
    grey.roughness = 0.9f;
    uint32_t m = lobe_scene_add_material(s, grey), first = s->vertex_count;
    for (int k = 0; k < 4; k++) {
        vec3 place = {k == 1 || k == 2 ? size : -size, y, k < 2 ? size : -size};
        lobe_scene_add_vertex(
            s, (vertex){.position = place, .normal = {0.0f, 1.0f, 0.0f}, .handedness = 1.0f});
    }
    lobe_scene_add_triangle(s, first, first + 1, first + 2, m);
    lobe_scene_add_triangle(s, first, first + 2, first + 3, m);
}

/* The panorama of the options, or a sky for a scene that brings no light at all. */
static lobe_render_result light_the_scene(lobe_scene *s, const lobe_scene_options *options) {
    image picture;
    if (options->environment) {
        size_t repaired = 0;
        lobe_render_result result = lobe_image_read(options->environment, &picture, &repaired);
        if (result != LOBE_RENDER_OK) return result;
        if (repaired)
            lobe_warn(&s->warnings, "%s: %zu values below 0 or not finite; they count as 0",
                      options->environment, repaired);
        if (s->has_sky) lobe_environment_free(&s->sky);
    } else if (s->has_sky || s->light_table.cells) {
        return LOBE_RENDER_OK;
    } else if (!lobe_environment_sky(&picture)) {
        return lobe_fail_memory(s->name);
    }
    s->has_sky = 1;
    if (!lobe_environment_create(&s->sky, picture, options->environment_rotation))
        return lobe_fail_memory(s->name);
    return LOBE_RENDER_OK;
}

static void fill_info(lobe_scene *s) {
    s->info.triangles = s->triangle_count;
    s->info.instances = s->instance_count;
    s->info.placed_triangles = s->triangle_count - world_of(s);
    for (uint32_t i = 0; i < s->instance_count; i++)
        s->info.placed_triangles += s->shapes[s->instances[i].shape].count;
    s->info.emissive_triangles = s->light_count;
    s->info.vertices = s->vertex_count;
    s->info.materials = s->material_count;
    s->info.textures = s->texture_count;
    s->info.warnings = s->warnings.count;
    s->info.geometry_bytes = s->vertex_count * sizeof *s->vertices +
                             s->triangle_count * sizeof *s->triangles +
                             s->instance_count * sizeof *s->instances;
    for (uint32_t i = 0; i < s->texture_count; i++)
        s->info.texture_bytes += lobe_texture_bytes(&s->textures[i]);
    s->info.low = s->low;
    s->info.high = s->high;
    s->info.lamps = s->lamp_count;
    s->info.tree_bytes = lobe_tracer_bytes(s->tracer, &s->info.tree_peak_bytes);
}

enum { AVERAGED_MAPS_MAX = 8 };

/* The textures that are averaged over a footprint. Not those of directions: the mean of normals is another surface. Nor the
 * colour of what is cut out by its alpha: what is not there has a colour too. */
static int averaged_maps(const material *m, const texture_map *maps[AVERAGED_MAPS_MAX]) {
    const texture_map *const all[] = {&m->roughness_map,
                                      &m->metallic_map,
                                      &m->emission_map,
                                      &m->transmission_map,
                                      &m->specular_color_map,
                                      &m->clearcoat_map,
                                      &m->clearcoat_roughness_map,
                                      &m->base_map};
    const int last = m->alpha_mode == ALPHA_OPAQUE;
    int count = 0;
    for (int i = 0; i < AVERAGED_MAPS_MAX - !last; i++)
        if (all[i]->texture != NO_TEXTURE) maps[count++] = all[i];
    return count;
}

void lobe_material_settle(material *m) {
    m->tint = lobe_coat_tint(m->ior, m->specular, m->specular_color);
    m->has_direction = m->normal_map.texture != NO_TEXTURE || m->anisotropy != 0.0f ||
                       m->stretch > 0.0f || m->clearcoat > 0.0f;
    m->is_packed = memcmp(&m->roughness_map, &m->metallic_map, sizeof m->roughness_map) == 0;
    m->is_matte = m->metallic == 0.0f && m->specular == 0.0f && m->transmission == 0.0f &&
                  m->clearcoat == 0.0f;
    const texture_map *maps[AVERAGED_MAPS_MAX];
    m->is_averaged = averaged_maps(m, maps) > 0;
}

static int add_levels(lobe_scene *s) {
    const texture_map *maps[AVERAGED_MAPS_MAX];
    for (uint32_t i = 0; i < s->material_count; i++) {
        const int count = averaged_maps(&s->materials[i], maps);
        for (int k = 0; k < count; k++)
            if (maps[k]->levels != LEVELS_NONE &&
                !lobe_texture_add_levels(&s->textures[maps[k]->texture]))
                return 0;
    }
    return 1;
}

static int has_anisotropy(const lobe_scene *s) {
    for (uint32_t i = 0; i < s->material_count; i++)
        if (s->materials[i].anisotropy != 0.0f || s->materials[i].stretch > 0.0f) return 1;
    return 0;
}

static lobe_render_result build_tree(lobe_scene *s, const lobe_scene_options *options) {
    if (s->out_of_memory) return lobe_fail_memory(s->name);
    const tracer_scene traced = {.vertices = s->vertices,
                                 .indices = s->triangles,
                                 .vertex_count = s->vertex_count,
                                 .vertex_stride = sizeof *s->vertices,
                                 .triangle_count = s->triangle_count,
                                 .index_stride = sizeof *s->triangles,
                                 .shapes = s->shapes,
                                 .instances = s->instances,
                                 .shape_count = s->shape_count,
                                 .instance_count = s->instance_count,
                                 .progress = options->progress,
                                 .progress_user = options->progress_user,
                                 .cancel = options->cancel};
    s->tracer = lobe_tracer_create(&traced);
    if (s->tracer) return LOBE_RENDER_OK;
    if (options->cancel && *options->cancel)
        return lobe_fail(LOBE_RENDER_INTERRUPTED,
                         "%s: interrupted while it was prepared; nothing "
                         "is rendered yet",
                         s->name);
    return lobe_fail_memory(s->name);
}

/* Arrays that grew have room to spare. */
static void shrink(lobe_scene *s) {
    vertex *vertices = realloc(s->vertices, (size_t)s->vertex_count * sizeof *vertices);
    if (vertices) s->vertices = vertices;
    if (vertices) s->vertex_room = s->vertex_count;
    triangle *triangles = realloc(s->triangles, (size_t)s->triangle_count * sizeof *triangles);
    if (triangles) s->triangles = triangles;
    if (triangles) s->triangle_room = s->triangle_count;
}

static void warn_of_time(lobe_scene *s, const lobe_scene_options *options) {
    s->frame_time = options->frame_time;
    if (isfinite(options->frame_time) && !s->is_animated)
        lobe_warn(&s->warnings, "%s: is not animated; --frame-time is without effect", s->name);
}

/* From triangles and materials to something that can be rendered. */
static lobe_render_result finish(lobe_scene *s, const lobe_scene_options *options, int is_file) {
    if (s->out_of_memory) return lobe_fail_memory(s->name);
    if (s->triangle_count == 0)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: no triangle that can be seen; is it the right file?", s->name);
    if (!find_bounds(s)) return lobe_fail_memory(s->name);
    warn_of_time(s, options);
    s->info.cameras = is_file ? s->camera_count : 0;
    if (s->camera_count == 0) lobe_scene_frame_automatically(s);
    if (options->ground && is_file) add_ground(s);
    shrink(s);
    if (!collect_lights(s)) return lobe_fail_memory(s->name);
    s->is_opaque = is_scene_opaque(s);
    lobe_render_result result = light_the_scene(s, options);
    if (result != LOBE_RENDER_OK) return result;
    lobe_scene_note_all(s);
    result = build_tree(s, options);
    if (result != LOBE_RENDER_OK) return result;
    s->has_anisotropy = has_anisotropy(s);
    for (uint32_t i = 0; i < s->material_count; i++) lobe_material_settle(&s->materials[i]);
    if (!add_levels(s)) return lobe_fail_memory(s->name);
    if (s->warnings.failed) return LOBE_RENDER_BAD_INPUT;
    fill_info(s);
    return LOBE_RENDER_OK;
}

static int is_unit(float x) {
    return x >= 0.0f && x <= 1.0f;
}

static lobe_render_result check_options(const lobe_scene_options *o) {
    const float *c = o->default_base_color;
    if (!is_unit(c[0]) || !is_unit(c[1]) || !is_unit(c[2]) || !is_unit(o->default_metallic) ||
        !is_unit(o->default_roughness))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "default material: a value is out of range; use 0 to 1");
    if (!isfinite(o->environment_rotation))
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "environment rotation: not a number; use degrees");
    return LOBE_RENDER_OK;
}

static int file_exists(const char *path) {
    FILE *file = fopen(path, "rb");
    if (file) fclose(file);
    return file != NULL;
}

lobe_render_result lobe_scene_load(const char *source, lobe_scene_options options,
                                   lobe_scene **scene) {
    *scene = NULL;
    lobe_render_result result = check_options(&options);
    if (result != LOBE_RENDER_OK) return result;
    lobe_scene *s = calloc(1, sizeof *s);
    if (!s) return lobe_fail_memory(source);
    s->warnings = (warnings){options.warning, options.warning_user, options.strict, 0, 0};
    snprintf(s->name, sizeof s->name, "%s", source);
    int is_file = file_exists(source) || !lobe_scene_build(s, source);
    if (is_file) result = lobe_scene_import(s, source, &options);
    if (result == LOBE_RENDER_OK) result = finish(s, &options, is_file);
    if (result == LOBE_RENDER_OK)
        *scene = s;
    else
        lobe_scene_free(s);
    return result;
}

lobe_scene_info lobe_scene_get_info(const lobe_scene *scene) {
    return scene->info;
}

const char *lobe_scene_camera_name(const lobe_scene *scene, size_t index) {
    return index < scene->info.cameras ? scene->cameras[index].name : NULL;
}
