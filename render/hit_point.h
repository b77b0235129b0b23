/* A surface that a ray met, ready to shade. */
#ifndef LOBE_RENDER_HIT_POINT_H
#define LOBE_RENDER_HIT_POINT_H

#include "scene.h"

typedef struct hit_point {
    vec3 position, geometric; /* geometric: toward the viewer */
    frame shading, smooth;    /* smooth: without normal map, as the triangle faces */
    float distance, handedness;
    const triangle *triangle;
    const material *material;
    float u[2], v[2];
    float footprint[2]; /* for textures, in the planes of u and v */
    float turn;         /* -1: the tangent frame is left-handed */
    int is_back;        /* the triangle faces away */
    vec3 darkening;     /* of the base colour, by the colours of the vertices */
    vec3 emission;
} hit_point;

/* `direction`: of the ray; `width`: of its cone there (cone.h). */
void lobe_hit_point_find(const lobe_scene *s, const ray_hit *hit, vec3 direction, float width,
                         hit_point *h);

/* The share of light that a surface takes: the rest passes. */
float lobe_hit_opacity(const lobe_scene *s, const ray_hit *hit);

/* What the metallic-roughness part of a material says at a point. */
typedef struct hit_looks {
    vec3 base_color;
    float metallic, roughness, anisotropy;
    float transmission;
} hit_looks;

/* A stretched surface turns its frame. */
hit_looks lobe_hit_looks(const lobe_scene *s, hit_point *h);

/* Of the coat. */
coat_tint lobe_hit_tint(const lobe_scene *s, const hit_point *h);

/* A value of a texture; `missing` where there is none. */
static inline vec3 hit_map(const lobe_scene *s, const texture_map *map, const hit_point *h,
                           vec3 missing) {
    if (map->texture == NO_TEXTURE) return missing;
    const int set = map->uv_set;
    return lobe_texture_at(&s->textures[map->texture], map, h->u[set], h->v[set],
                           h->footprint[set]);
}

/* Of directions, which are not averaged. */
static inline vec3 hit_directions(const lobe_scene *s, const texture_map *map, const hit_point *h,
                                  vec3 missing) {
    if (map->texture == NO_TEXTURE) return missing;
    const int set = map->uv_set;
    return lobe_texture_at(&s->textures[map->texture], map, h->u[set], h->v[set], 0.0f);
}

/* The normal that a normal map says, in world space. */
vec3 lobe_hit_normal(const lobe_scene *s, const hit_point *h, const texture_map *map, float scale);

/* A place off the surface, on the side of the viewer or beyond, so that a ray does not meet it again. */
vec3 lobe_hit_lift(const hit_point *h, int is_beyond);

/* Whether the far side is another medium. */
static inline int is_solid(const material *m) {
    return m->transmission > 0.0f && m->thickness > 0.0f;
}

#endif
