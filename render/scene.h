/* The scene: triangles, materials, textures, lights and cameras, and how to put them together. */
#ifndef LOBE_RENDER_SCENE_H
#define LOBE_RENDER_SCENE_H

#include "affine.h"
#include "environment.h"
#include "light_tree.h"
#include "material.h"
#include "lobe/render.h"
#include "message.h"
#include "texture.h"
#include "trace.h"

/* How much of a surface is there: all of it, what reaches the cutoff, or a share of the light. */
typedef enum alpha_mode { ALPHA_OPAQUE, ALPHA_MASK, ALPHA_BLEND } alpha_mode;

/* glTF 2.0 metallic-roughness; factors multiply the textures. */
typedef struct material {
    vec3 base_color;
    vec3 emission;
    float metallic;
    float roughness;  /* perceptual */
    float anisotropy; /* -1 to 1: alpha_x/alpha_y = (1 + a)/(1 - a) */
    float stretch; /* KHR_materials_anisotropy, 0 to 1, in place of anisotropy where it is not 0 */
    float stretch_x, stretch_y; /* its direction in the tangent plane, unit */
    float alpha, alpha_cutoff;
    alpha_mode alpha_mode;
    int is_unlit; /* shows its base colour, reflects nothing */
    float clearcoat, clearcoat_roughness, clearcoat_normal_scale; /* KHR_materials_clearcoat */
    float specular; /* KHR_materials_specular: how much of its reflection a dielectric keeps, */
    vec3 specular_color; /* and what colour, from 0 on, that has straight ahead */
    float transmission, ior;
    float thickness; /* 0: a thin wall; else a solid, whatever the number */
    vec3 absorption; /* of the inside, per unit of length */
    float normal_scale;
    /* roughness is the green, metallic the blue, opacity the alpha, in place of that of the base */
    texture_map base_map, opacity_map, normal_map, roughness_map, metallic_map, emission_map,
        stretch_map, transmission_map, specular_map, specular_color_map, clearcoat_map,
        clearcoat_roughness_map, clearcoat_normal_map;
    /* what follows from all above: lobe_material_settle */
    coat_tint tint;    /* where no texture varies it */
    int has_direction; /* it looks different when it is turned about its normal: it needs a tangent */
    int is_packed;     /* roughness and metallic lie in one picture, at one place */
    int is_matte;      /* a base without a coat, and nothing else */
    int is_averaged;   /* it has a texture of which means over a footprint are taken */
} material;

typedef struct vertex {
    vec3 position, normal, tangent; /* normal, tangent: 0 where there is none */
    float u, v, handedness;
    float u1, v1;          /* the second set of texture coordinates */
    uint16_t darkening[4]; /* 65535 (1 - colour and alpha): 0 leaves the material's alone */
} vertex;

typedef struct triangle {
    uint32_t vertex[3];
    uint32_t material;
    int32_t light; /* its number among the emissive triangles, or -1 */
} triangle;

/* Light from a place or a direction without extent (KHR_lights_punctual). */
typedef enum lamp_kind { LAMP_POINT, LAMP_SPOT, LAMP_DIRECTIONAL } lamp_kind;

typedef struct lamp {
    lamp_kind kind;
    vec3 position, direction; /* direction: unit, in which it shines */
    vec3 intensity;           /* radiant intensity; of directional ones, irradiance */
    float cos_inner, cos_outer;
    float range; /* where it ends; 0: nowhere */
} lamp;

typedef struct camera {
    char name[64];
    vec3 position, target, up;
    float vertical_degrees;
} camera;

/* inventory.h */
typedef struct inventory_row {
    lobe_scene_item item;
    char *name, *about; /* by malloc */
} inventory_row;

typedef struct inventory {
    inventory_row *rows;
    size_t count, room;
} inventory;

struct lobe_scene {
    char name[256];
    vertex *vertices;
    triangle *triangles;
    material *materials;
    texture *textures;
    camera *cameras;
    lamp *lamps;
    shape *shapes; /* the first triangles; the others lie in the world */
    instance *instances;
    uint32_t vertex_count, triangle_count, material_count, texture_count, camera_count, lamp_count,
        shape_count, instance_count;
    uint32_t vertex_room, triangle_room, material_room, texture_room, camera_room, lamp_room,
        shape_room, instance_room;
    int out_of_memory;
    uint32_t *lights; /* emissive triangles */
    float *light_areas;
    uint32_t light_count;
    alias_table light_table; /* of them, then of the lamps */
    light_tree light_tree;   /* of the same, but for directional lamps: */
    float far_share;         /* their part of all power */
    int is_opaque;           /* every triangle */
    environment sky;
    int has_sky;
    tracer *tracer;
    vec3 low, high; /* bounds */
    int has_anisotropy;
    int is_framed;     /* the camera is not of the file */
    int is_animated;   /* the file */
    double frame_time; /* NaN: at rest */
    lobe_scene_info info;
    inventory inventory;
    warnings warnings;
};

/* Building. Indices are those of the scene; failures of memory are kept in out_of_memory. */
uint32_t lobe_scene_add_material(lobe_scene *s, material m);
uint32_t lobe_scene_add_vertex(lobe_scene *s, vertex v);
uint32_t lobe_scene_add_lamp(lobe_scene *s, lamp l);
void lobe_scene_add_triangle(lobe_scene *s, uint32_t a, uint32_t b, uint32_t c, uint32_t material);

/* A shape of the triangles from `first` on. All shapes come before the triangles of the world. */
uint32_t lobe_scene_add_shape(lobe_scene *s, uint32_t first);

/* 0: the transform cannot be inverted in float; then nothing is added. */
int lobe_scene_add_instance(lobe_scene *s, uint32_t shape, const affine *to_world);

/* Whether triangles of this material are lights that can be drawn. They have to lie in the world. */
int lobe_is_even_light(const material *m);

int lobe_scene_add_texture(lobe_scene *s, texture t);
void lobe_scene_add_camera(lobe_scene *s, const char *name, vec3 position, vec3 target, vec3 up,
                           float vertical_degrees);
material lobe_default_material(void);

/* One file a way in: a built-in (0: there is none of this name) or a file. */
int lobe_scene_build(lobe_scene *s, const char *name);
lobe_render_result lobe_scene_import(lobe_scene *s, const char *path,
                                     const lobe_scene_options *options);
lobe_render_result lobe_scene_import_gltf(lobe_scene *s, const char *path,
                                          const lobe_scene_options *options);

void lobe_material_settle(material *m);

/* What a file without materials gets, from the options. */
material lobe_fallback_material(const lobe_scene_options *options);

#endif
