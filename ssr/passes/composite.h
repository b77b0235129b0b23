/* ssr/passes/composite.h: what the screen does not show comes from the environment. */
#ifndef LOBE_SSR_COMPOSITE_H
#define LOBE_SSR_COMPOSITE_H

#include "kernel/arc.h"
#include "kernel/fresnel.h"

#include "reproject.h"
#include "surface.h"

/* The angle of (x, y), in [-pi, pi]. */
K_FN real ssr_angle(real y, real x) {
    real angle = k_angle(y, k_abs(x));
    return k_select(x < R(0.0), k_sign(y) * K_PI - angle, angle);
}

/* The direction in which a mirror would look, world. */
K_FN v3 ssr_mirrored(ssr_surface s) {
    return ssr_to_world(s, v3_of(-s.to_viewer.x, -s.to_viewer.y, s.to_viewer.z));
}

/* Where a direction of the world lies in the picture of the environment, in pixels. */
K_FN ssr_between ssr_environment_place(v3 d, kint width, kint height) {
    real u = R(0.5) + R(0.5) * K_INV_PI * ssr_angle(d.z, d.x);
    real across = k_sqrt(d.x * d.x + d.z * d.z);
    real v = K_INV_PI * ssr_angle(across, d.y);
    return ssr_between_of(u * k_from_int(width), v * k_from_int(height));
}

/* Without Fresnel. */
K_FN v3 ssr_radiance(ssr_reflected reflection, v3 fallback) {
    return v3_add(reflection.color, v3_scale(fallback, R(1.0) - reflection.opacity));
}

/* Of one channel, by Schlick; what is not a reflectance is 0, and above 1 is 1. */
K_FN real ssr_reflectance(real f0, real cosine) {
    return fresnel_schlick(k_saturate(k_select(ssr_is_finite(f0), f0, R(0.0))), cosine);
}

K_FN v3 ssr_with_fresnel(v3 light, v3 f0, real cosine) {
    return v3_of(light.x * ssr_reflectance(f0.x, cosine), light.y * ssr_reflectance(f0.y, cosine),
                 light.z * ssr_reflectance(f0.z, cosine));
}

#endif
