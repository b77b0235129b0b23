/* ssr/passes/accumulate.h: how much of the history a pixel keeps. */
#ifndef LOBE_SSR_ACCUMULATE_H
#define LOBE_SSR_ACCUMULATE_H

#include "camera.h"
#include "reproject.h"

/* The share of the new frame: 1 - accumulation, and more the faster (pixels a frame) the surface and what
 * it reflects move. */
K_FN real ssr_new_share(real accumulation, real surface_speed, real reflected_speed,
                        real rejection) {
    real share = R(1.0) - k_saturate(accumulation);
    real moves = k_saturate((surface_speed + reflected_speed) * rejection);
    return share + (R(1.0) - share) * moves;
}

/* Whether what was at z in the last frame is the surface that is expected there. */
K_FN bool ssr_is_same_surface(real expected_z, real z) {
    return k_abs(expected_z - z) <= R(0.05) * expected_z;
}

K_FN real ssr_clamp(real x, real low, real high) {
    return k_min(k_max(x, low), high);
}

/* Pixels a frame. */
K_FN real ssr_speed(real motion_x, real motion_y, real width, real height) {
    real x = motion_x * width;
    real y = motion_y * height;
    return k_sqrt(x * x + y * y);
}

/* Where a surface was on the screen, in pixels. */
K_FN ssr_place ssr_pixel_before(real px, real py, ssr_camera now, real motion_x, real motion_y) {
    ssr_place p;
    p.x = px - motion_x * now.width;
    p.y = py - motion_y * now.height;
    return p;
}

/* Distance along the axis of the last camera at which the surface of a pixel is expected. */
K_FN real ssr_expected_z(ssr_camera now, ssr_camera last, real px, real py, real z) {
    return ssr_project(last, v3_add(now.eye, ssr_view_vector(now, px, py, z))).z;
}

/* The same where the surface moves itself; 0: not known. */
K_FN real ssr_moved_z(real z, real motion_z) {
    real was = z - motion_z;
    return k_select(ssr_is_finite(was), was, R(0.0));
}

/* Holds what the pixels around have in common. */
K_STRUCT(ssr_range) {
    ssr_reflected low;
    ssr_reflected high;
};

K_FN ssr_range ssr_no_range(void) {
    ssr_range r;
    r.low.color = v3_of(K_HUGE, K_HUGE, K_HUGE);
    r.low.opacity = K_HUGE;
    r.high.color = v3_of(-K_HUGE, -K_HUGE, -K_HUGE);
    r.high.opacity = -K_HUGE;
    return r;
}

K_FN ssr_range ssr_widen(ssr_range r, ssr_reflected l) {
    ssr_range w;
    w.low.color = v3_of(k_min(r.low.color.x, l.color.x), k_min(r.low.color.y, l.color.y),
                        k_min(r.low.color.z, l.color.z));
    w.low.opacity = k_min(r.low.opacity, l.opacity);
    w.high.color = v3_of(k_max(r.high.color.x, l.color.x), k_max(r.high.color.y, l.color.y),
                         k_max(r.high.color.z, l.color.z));
    w.high.opacity = k_max(r.high.opacity, l.opacity);
    return w;
}

K_FN ssr_reflected ssr_held(ssr_reflected l, ssr_range r) {
    ssr_reflected h;
    h.color = v3_of(ssr_clamp(l.color.x, r.low.color.x, r.high.color.x),
                    ssr_clamp(l.color.y, r.low.color.y, r.high.color.y),
                    ssr_clamp(l.color.z, r.low.color.z, r.high.color.z));
    h.opacity = ssr_clamp(l.opacity, r.low.opacity, r.high.opacity);
    return h;
}

K_FN ssr_reflected ssr_add_reflected(ssr_reflected sum, ssr_reflected l, real share) {
    ssr_reflected s;
    s.color = v3_add(sum.color, v3_scale(l.color, share));
    s.opacity = sum.opacity + share * l.opacity;
    return s;
}

/* `share` of the new. */
K_FN ssr_reflected ssr_blend(ssr_reflected old, ssr_reflected fresh, real share) {
    return ssr_add_reflected(ssr_add_reflected(ssr_no_reflected(), fresh, share), old,
                             R(1.0) - share);
}

#endif
