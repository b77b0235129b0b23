/* The one place that knows Embree: nearest hit and visibility. */
#ifndef LOBE_RENDER_TRACE_H
#define LOBE_RENDER_TRACE_H

#include <stddef.h>
#include <stdint.h>

#include "vector.h"

typedef struct tracer tracer;

typedef struct ray_hit {
    uint32_t triangle;
    float distance, u, v;
} ray_hit;

/* `vertices`: positions at the start of elements of `stride` bytes; indices likewise. NULL: failed. */
tracer *lobe_tracer_create(const void *vertices, uint32_t vertex_count, uint32_t vertex_stride,
                           const void *indices, uint32_t triangle_count, uint32_t index_stride);
void lobe_tracer_free(tracer *t);

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
