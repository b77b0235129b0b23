/* ssr/passes/surface.h: what a frame holds at a pixel: a surface seen from the front, in its own frame. */
#ifndef LOBE_SSR_SURFACE_H
#define LOBE_SSR_SURFACE_H

#include "camera.h"
#include "finite.h"

K_STRUCT(ssr_surface) {
    v3 x; /* the shading frame, world */
    v3 y;
    v3 z;
    v3 to_viewer; /* in the frame, unit */
    real alpha_x;
    real alpha_y;
    real distance;
    kint seen; /* 0: none there, or not from the front */
};

/* 0: no surface there. */
K_FN real ssr_usable_z(real z, real near_z, real far_z) {
    return k_select(k_and(z > R(0.0), k_is_below(z, far_z)), k_max(z, near_z), R(0.0));
}

K_FN real ssr_usable_motion(real motion, real other) {
    return k_select(k_and(ssr_is_finite(motion), ssr_is_finite(other)), motion, R(0.0));
}

K_FN v3 v3_cross(v3 a, v3 b) {
    return v3_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* Some unit vector across a unit vector; continuous but for one point (Duff et al. 2017). */
K_FN v3 ssr_across(v3 z) {
    real side = k_sign(z.z);
    real a = R(-1.0) / (side + z.z);
    return v3_of(R(1.0) + side * z.x * z.x * a, side * z.x * z.y * a, -side * z.x);
}

K_FN v3 ssr_to_frame(ssr_surface s, v3 d) {
    return v3_of(v3_dot(d, s.x), v3_dot(d, s.y), v3_dot(d, s.z));
}

K_FN v3 ssr_to_world(ssr_surface s, v3 d) {
    return v3_combine(s.x, d.x, s.y, d.y, s.z, d.z);
}

/* What the surface of a pixel is made of. */
K_STRUCT(ssr_material) {
    v3 normal;  /* world, any length but 0 */
    v3 tangent; /* world, any length: where there is anisotropy */
    real roughness;
    real anisotropy;
};

K_FN ssr_material ssr_material_of(v3 normal, real roughness) {
    ssr_material m;
    m.normal = normal;
    m.roughness = roughness;
    m.tangent = v3_of(R(0.0), R(0.0), R(0.0));
    m.anisotropy = R(0.0);
    return m;
}

/* Turns the frame's x to the tangent, where that makes a difference, and sets the roughness along both. */
K_FN ssr_surface ssr_brushed(ssr_surface s, ssr_material m, real alpha) {
    v3 across = v3_sub(m.tangent, v3_scale(s.z, v3_dot(m.tangent, s.z)));
    real length2 = v3_dot(across, across);
    bool known = k_and(ssr_is_finite(m.anisotropy), k_abs(m.anisotropy) > R(0.0));
    bool turns = k_and(known, k_and(length2 > R(1e-12), k_is_below(length2, R(1e12))));
    real a = k_min(k_max(k_select(turns, m.anisotropy, R(0.0)), R(-1.0)), R(1.0));
    ssr_surface b = s;
    b.x = v3_select(turns, v3_normalize(v3_select(turns, across, s.x)), s.x);
    b.y = v3_cross(s.z, b.x);
    b.alpha_x = alpha * (R(1.0) + a);
    b.alpha_y = alpha * (R(1.0) - a);
    return b;
}

/* Pixel position (px, py), usable z. What is not finite is not seen. */
K_FN ssr_surface ssr_surface_of(ssr_camera c, real px, real py, real z, ssr_material m) {
    real length2 = v3_dot(m.normal, m.normal);
    bool there = k_and(k_and(z > R(0.0), ssr_is_finite(m.roughness)),
                       k_and(length2 > R(1e-12), k_is_below(length2, R(1e12))));
    v3 up = v3_of(R(0.0), R(0.0), R(1.0));
    v3 view = ssr_view_vector(c, px, py, k_select(there, z, R(1.0)));
    real r = k_saturate(k_select(there, m.roughness, R(0.0)));
    ssr_surface s;
    s.z = v3_normalize(v3_select(there, m.normal, up));
    s.x = ssr_across(s.z);
    s = ssr_brushed(s, m, r * r);
    s.distance = k_sqrt(v3_dot(view, view));
    bool far = k_and(s.distance > R(0.0), ssr_is_finite(s.distance));
    s.to_viewer = ssr_to_frame(s, v3_scale(view, R(-1.0) / k_select(far, s.distance, R(1.0))));
    s.seen = k_flag(k_and(k_and(there, far), s.to_viewer.z > R(0.0)));
    return s;
}

#endif
