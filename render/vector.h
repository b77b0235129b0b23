/* Three-vectors, colours and frames, in float. */
#ifndef LOBE_RENDER_VECTOR_H
#define LOBE_RENDER_VECTOR_H

#include "lobe/types.h"
#include "number.h"

typedef lobe_vec3_f32 vec3;

static inline vec3 v3(float x, float y, float z) {
    return (vec3){x, y, z};
}

static inline vec3 v3_all(float s) {
    return (vec3){s, s, s};
}

static inline vec3 v3_add(vec3 a, vec3 b) {
    return (vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline vec3 v3_sub(vec3 a, vec3 b) {
    return (vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline vec3 v3_mul(vec3 a, vec3 b) {
    return (vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static inline vec3 v3_scale(vec3 a, float s) {
    return (vec3){a.x * s, a.y * s, a.z * s};
}

static inline vec3 v3_lerp(vec3 a, vec3 b, float t) {
    return v3_add(v3_scale(a, 1.0f - t), v3_scale(b, t));
}

static inline vec3 v3_neg(vec3 a) {
    return (vec3){-a.x, -a.y, -a.z};
}

static inline float v3_dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3 v3_cross(vec3 a, vec3 b) {
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline float v3_length(vec3 a) {
    return sqrtf(v3_dot(a, a));
}

/* The unit vector along a; `fallback` where a has no direction. */
static inline vec3 v3_normalize_or(vec3 a, vec3 fallback) {
    float squared = v3_dot(a, a);
    if (!(squared > 1e-30f) || !(squared < 1e30f)) return fallback;
    return v3_scale(a, 1.0f / sqrtf(squared));
}

static inline float v3_max(vec3 a) {
    return maxf(a.x, maxf(a.y, a.z));
}

static inline int v3_is_finite(vec3 a) {
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/* Relative luminance (ITU-R BT.709). */
static inline float v3_luminance(vec3 a) {
    return 0.2126f * a.x + 0.7152f * a.y + 0.0722f * a.z;
}

typedef struct frame {
    vec3 x, y, z;
} frame;

/* Some unit vector across the unit vector z, continuous but for one point (Duff et al. 2017). */
static inline vec3 v3_across(vec3 z) {
    float sign = copysignf(1.0f, z.z);
    float a = -1.0f / (sign + z.z);
    return (vec3){1.0f + sign * z.x * z.x * a, sign * z.x * z.y * a, -sign * z.x};
}

/* The frame of z (unit) whose x is as near to `x` as it can be. */
static inline frame frame_of(vec3 z, vec3 x) {
    vec3 tangent = v3_normalize_or(v3_sub(x, v3_scale(z, v3_dot(x, z))), v3_across(z));
    return (frame){tangent, v3_cross(z, tangent), z};
}

static inline vec3 frame_to_local(const frame *f, vec3 a) {
    return (vec3){v3_dot(a, f->x), v3_dot(a, f->y), v3_dot(a, f->z)};
}

static inline vec3 frame_to_world(const frame *f, vec3 a) {
    return v3_add(v3_add(v3_scale(f->x, a.x), v3_scale(f->y, a.y)), v3_scale(f->z, a.z));
}

#endif
