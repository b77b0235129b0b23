/* kernel/ggx_ellipsoid.h: visible normals as points of a projected ellipsoid (Heitz 2018): a point of
 * the unit disk, squeezed to the part of the hemisphere that i sees, lifted back. Valid for either
 * sign of i_z. The basis across i is arbitrary at normal incidence, so the map (u, i) -> m has a seam
 * there; the caps have none. */
#ifndef K_GGX_ELLIPSOID_H
#define K_GGX_ELLIPSOID_H

#include "ggx_visible.h"
#include "trig.h"

K_STRUCT(ggx_ellipsoid) {
    ggx_base g;
    real azimuth_x; /* direction of i_std in the plane */
    real azimuth_y;
    real rho;
};

K_FN ggx_ellipsoid ggx_ellipsoid_prepare(ggx_base g) {
    ggx_ellipsoid s;
    bool off_normal = g.rho2 > K_TINY;
    s.g = g;
    s.rho = k_select(off_normal, k_sqrt(k_max(g.rho2, K_TINY)), R(0.0));
    real inv_rho = R(1.0) / k_max(s.rho, K_TINY);
    s.azimuth_x = k_select(off_normal, g.i_std.x * inv_rho, R(0.0));
    s.azimuth_y = k_select(off_normal, g.i_std.y * inv_rho, R(-1.0));
    return s;
}

K_FN real ggx_ellipsoid_pdf(ggx_ellipsoid s, ggx_pair pair) {
    return ggx_visible_pdf(s.g, pair, s.g.one_plus_z);
}

K_FN real ggx_ellipsoid_pdf_m(ggx_ellipsoid s, ggx_pair pair) {
    return ggx_visible_pdf_m(s.g, pair, s.g.one_plus_z);
}

K_FN real ggx_ellipsoid_acceptance(ggx_ellipsoid s) {
    return ggx_visible_acceptance(s.g, s.g.one_plus_z);
}

K_FN ggx_draw ggx_ellipsoid_draw(ggx_ellipsoid s, real u1, real u2, real u3) {
    real radius = k_sqrt(u1);
    k_sincos phi = k_sincos_2pi(u2);
    real x = radius * phi.c;
    real t = radius * phi.s;
    real half_width = k_sqrt(R(1.0) - x * x);
    /* the two gaps half_width -+ t: the smaller one by their product 1 - u1, so that the height
     * above the disk is a product of positive numbers, exact at the rim */
    real wide = half_width + k_abs(t);
    real narrow = (R(1.0) - u1) / wide;
    real above = k_select(t < R(0.0), wide, narrow);
    real below = k_select(t < R(0.0), narrow, wide);
    real squeeze = R(0.5) * s.g.one_plus_z;
    real rest = R(0.5) * s.g.one_minus_z;
    real y = rest * half_width + squeeze * t;
    real i_h = k_sqrt(squeeze * above * (R(2.0) * rest * half_width + squeeze * below));
    v3 across_x = v3_of(-s.azimuth_y, s.azimuth_x, R(0.0));
    v3 across_y = v3_of(-s.g.i_std.z * s.azimuth_x, -s.g.i_std.z * s.azimuth_y, s.rho);
    v3 h = v3_combine(across_x, x, across_y, y, s.g.i_std, i_h);
    h.z = k_max(h.z, R(0.0));
    return ggx_visible_draw(s.g, ggx_pair_of_stretched(s.g, h), s.g.one_plus_z);
}

#endif
