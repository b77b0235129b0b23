/* Where a camera looks. */
#include <math.h>

#include "lobe/ssr.h"

static lobe_vec3_f32 cross(lobe_vec3_f32 a, lobe_vec3_f32 b) {
    return (lobe_vec3_f32){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static lobe_vec3_f32 unit_or(lobe_vec3_f32 a, lobe_vec3_f32 fallback) {
    const float length2 = a.x * a.x + a.y * a.y + a.z * a.z;
    if (!(length2 > 1e-30f && length2 < 1e30f)) return fallback;
    const float inverse = 1.0f / sqrtf(length2);
    return (lobe_vec3_f32){a.x * inverse, a.y * inverse, a.z * inverse};
}

lobe_ssr_camera lobe_ssr_look_at(lobe_vec3_f32 eye, lobe_vec3_f32 target, lobe_vec3_f32 up,
                                 float vertical_degrees, float aspect, float near_z, float far_z) {
    lobe_ssr_camera c = {.eye = eye, .near_z = near_z, .far_z = far_z};
    const lobe_vec3_f32 to = {target.x - eye.x, target.y - eye.y, target.z - eye.z};
    c.forward = unit_or(to, (lobe_vec3_f32){0.0f, 0.0f, -1.0f});
    /* where `up` is along the view: any axis that is not */
    const lobe_vec3_f32 axis = fabsf(c.forward.y) < 0.9f ? (lobe_vec3_f32){0.0f, 1.0f, 0.0f}
                                                         : (lobe_vec3_f32){1.0f, 0.0f, 0.0f};
    const lobe_vec3_f32 other = unit_or(cross(c.forward, axis), axis);
    c.right = unit_or(cross(c.forward, up), other);
    c.up = cross(c.right, c.forward);
    c.tan_y = tanf(0.5f * vertical_degrees * 0.01745329252f);
    c.tan_x = c.tan_y * aspect;
    return c;
}
