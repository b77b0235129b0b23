/* The one place that knows Embree: nearest hit and visibility. */
#ifndef LOBE_RENDER_TRACE_H
#define LOBE_RENDER_TRACE_H

#include <signal.h>
#include <stddef.h>
#include <stdint.h>

#include "vector.h"

typedef struct tracer tracer;

#define NO_INSTANCE UINT32_MAX

typedef struct ray_hit {
    uint32_t triangle, instance; /* NO_INSTANCE: the triangle lies in the world */
    float distance, u, v;
} ray_hit;

/* Triangles in a space of their own, which instances show. */
typedef struct shape {
    uint32_t first, count; /* triangles */
} shape;

/* Columns of transforms. None of its members leaves padding. */
typedef struct instance {
    float to_world[12];
    float normals[9]; /* how normals turn; their length is of no meaning */
    float sign;       /* of the determinant */
    uint32_t shape;
} instance;

static inline vec3 lobe_instance_direction(const float columns[9], vec3 d) {
    return v3_add(v3_add(v3_scale(v3(columns[0], columns[1], columns[2]), d.x),
                         v3_scale(v3(columns[3], columns[4], columns[5]), d.y)),
                  v3_scale(v3(columns[6], columns[7], columns[8]), d.z));
}

static inline vec3 lobe_instance_point(const instance *i, vec3 p) {
    const float *t = i->to_world;
    return v3_add(lobe_instance_direction(t, p), v3(t[9], t[10], t[11]));
}

/* What is traced; it must outlive the tracer. Triangles that are no part of a shape lie in the world, and come last. */
typedef struct tracer_scene {
    const void *vertices; /* positions at the start of elements of vertex_stride bytes */
    const void *indices;  /* likewise */
    uint32_t vertex_count, vertex_stride, triangle_count, index_stride;
    const shape *shapes;
    const instance *instances;
    uint32_t shape_count, instance_count;
    void (*progress)(void *user, double fraction); /* of the tree; NULL: none */
    void *progress_user;
    const volatile sig_atomic_t *cancel; /* NULL: none */
} tracer_scene;

/* NULL: failed, or cancelled. */
tracer *lobe_tracer_create(const tracer_scene *scene);
void lobe_tracer_free(tracer *t);

/* Of the trees, now and at most so far. */
uint64_t lobe_tracer_bytes(const tracer *t, uint64_t *most);

/* The first surface between two distances. */
int lobe_tracer_nearest(const tracer *t, vec3 origin, vec3 direction, float from, float to,
                        ray_hit *hit);
int lobe_tracer_blocked(const tracer *t, vec3 origin, vec3 direction, float distance);

/* A ray to trace once more. */
typedef struct logged_ray {
    vec3 origin, direction;
    float from;
    float to; /* negative: whether something is nearer than -to; else the nearest */
} logged_ray;

/* Nothing but the ray caster, ray by ray; how many met something. */
uint64_t lobe_tracer_replay(const tracer *t, const logged_ray *rays, size_t count);

#endif
