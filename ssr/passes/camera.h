/* ssr/passes/camera.h: a pinhole camera: world, pixels and depth. Device depth is reversed: 1 on the near
 * plane, 0 on the far one, d = n (f - z)/(z (f - n)) at the distance z along the camera's axis. Pixel
 * (0, 0) is the left one of the top row, its centre lies at (0.5, 0.5). */
#ifndef LOBE_SSR_CAMERA_H
#define LOBE_SSR_CAMERA_H

#include "kernel/vec.h"

K_STRUCT(ssr_camera) {
    v3 eye;
    v3 right; /* right, up and forward: an orthonormal frame */
    v3 up;
    v3 forward;
    real tan_x; /* tangents of half the angles of view */
    real tan_y;
    real near_z;
    real far_z;
    real width; /* pixels */
    real height;
};

K_FN real ssr_depth_of(ssr_camera c, real z) {
    return c.near_z * (c.far_z - z) / (z * (c.far_z - c.near_z));
}

K_FN real ssr_z_of(ssr_camera c, real depth) {
    return c.near_z * c.far_z / (depth * (c.far_z - c.near_z) + c.near_z);
}

/* World to camera axes. */
K_FN v3 ssr_axes_of(ssr_camera c, v3 direction) {
    return v3_of(v3_dot(direction, c.right), v3_dot(direction, c.up), v3_dot(direction, c.forward));
}

/* The vector from the eye to the place at a pixel position and z. */
K_FN v3 ssr_view_vector(ssr_camera c, real px, real py, real z) {
    real x = (R(2.0) * px / c.width - R(1.0)) * c.tan_x * z;
    real y = (R(1.0) - R(2.0) * py / c.height) * c.tan_y * z;
    return v3_combine(c.right, x, c.up, y, c.forward, z);
}

/* Pixel position and z of a place; z is 0 where it is not in front of the near plane. */
K_FN v3 ssr_project(ssr_camera c, v3 place) {
    v3 a = ssr_axes_of(c, v3_sub(place, c.eye));
    bool front = a.z >= c.near_z;
    real inverse = R(1.0) / k_select(front, a.z, R(1.0));
    real px = R(0.5) * c.width * (a.x * inverse / c.tan_x + R(1.0));
    real py = R(0.5) * c.height * (R(1.0) - a.y * inverse / c.tan_y);
    return v3_of(k_select(front, px, R(-1.0)), k_select(front, py, R(-1.0)),
                 k_select(front, a.z, R(0.0)));
}

K_FN bool ssr_on_screen(ssr_camera c, real px, real py) {
    return k_and(k_and(px >= R(0.0), px < c.width), k_and(py >= R(0.0), py < c.height));
}

#endif
