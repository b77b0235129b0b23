/* What a hit says of the geometry, in the world: the one place that knows instances. */
#ifndef LOBE_RENDER_HIT_H
#define LOBE_RENDER_HIT_H

#include "scene.h"

typedef struct hit_geometry {
    const triangle *triangle;
    vec3 position;
    vec3 face;            /* unit; counter-clockwise corners face it */
    vec3 normal, tangent; /* means of those at the corners, of any length; 0 where there are none */
    float handedness;
    float area; /* twice that of the triangle */
} hit_geometry;

static inline vec3 hit_mean(const vec3 a, const vec3 b, const vec3 c, float u, float v) {
    return v3_add(v3_scale(a, 1.0f - u - v), v3_add(v3_scale(b, u), v3_scale(c, v)));
}

static inline void hit_place(hit_geometry *g, const instance *i, vec3 edge, vec3 other) {
    const vec3 face = v3_cross(lobe_instance_direction(i->to_world, edge),
                               lobe_instance_direction(i->to_world, other));
    g->face = v3_scale(face, i->sign); /* a reflection turns what was counter-clockwise */
    g->position = lobe_instance_point(i, g->position);
    g->normal = lobe_instance_direction(i->normals, g->normal);
    g->tangent = lobe_instance_direction(i->to_world, g->tangent);
    g->handedness *= i->sign;
}

static inline hit_geometry hit_geometry_of(const lobe_scene *s, const ray_hit *hit) {
    const triangle *t = &s->triangles[hit->triangle];
    const vertex *a = &s->vertices[t->vertex[0]], *b = &s->vertices[t->vertex[1]],
                 *c = &s->vertices[t->vertex[2]];
    const float u = hit->u, v = hit->v;
    const vec3 edge = v3_sub(b->position, a->position), other = v3_sub(c->position, a->position);
    hit_geometry g = {.triangle = t,
                      .position = hit_mean(a->position, b->position, c->position, u, v),
                      .face = v3_cross(edge, other),
                      .normal = hit_mean(a->normal, b->normal, c->normal, u, v),
                      .tangent = hit_mean(a->tangent, b->tangent, c->tangent, u, v),
                      .handedness = a->handedness};
    if (hit->instance != NO_INSTANCE) hit_place(&g, &s->instances[hit->instance], edge, other);
    g.area = v3_length(g.face);
    g.face = v3_normalize_or(g.face, v3(0.0f, 1.0f, 0.0f));
    return g;
}

#endif
