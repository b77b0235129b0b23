/* kernel/ggx_cap.h: spherical caps about z, for `caps` and `bounded` (Dupuy & Benyoub 2023): a
 * hemispherical mirror reflects a parallel beam evenly over the sphere, so uniform reflections o_std
 * in z >= -k i_std.z give visible normals along i_std + o_std.
 *
 * Everything is written with 1 - k and w = 1 + k i_z, so that neither end of the cap cancels:
 * h_z = (1 - u2) w + (1 - k) i_z,  1 - z = u2 w,  1 + z = (1 - u2) w + (1 - k i_z). */
#ifndef K_GGX_CAP_H
#define K_GGX_CAP_H

#include "ggx_visible.h"
#include "trig.h"

K_STRUCT(ggx_cap) {
    ggx_base g;
    ggx_visible visible;
    real spare; /* (1 - k) i_std.z: what is cut off the cap of the visible normals */
    real w;     /* 1 + k i_std.z: height of the cap */
    real rest;  /* 1 - k i_std.z: what the cap leaves of the sphere's height 2 */
};

/* one_minus_k in [0, 1]; 0 for i_z <= 0 */
K_FN ggx_cap ggx_cap_of(ggx_base g, real one_minus_k) {
    ggx_cap s;
    s.g = g;
    s.spare = one_minus_k * g.i_std.z;
    s.w = g.one_plus_z - s.spare;
    s.rest = g.one_minus_z + s.spare;
    s.visible = ggx_visible_of(g, s.w);
    return s;
}

K_FN real ggx_cap_pdf(ggx_cap s, facet_pair pair) {
    return ggx_visible_pdf(s.visible, pair);
}

/* A normal whose reflection leaves lies in the cap by construction; the others may not. */
K_FN real ggx_cap_pdf_m(ggx_cap s, facet_pair pair) {
    real depth = R(1.0) - ggx_stretched_out(s.g, pair.m).z;
    return k_select(k_or(pair.leaves, depth <= s.w), ggx_visible_pdf_m(s.visible, pair), R(0.0));
}

K_FN real ggx_cap_acceptance(ggx_cap s) {
    return ggx_visible_acceptance(s.g, s.visible);
}

/* The stretched normal, of any length. */
K_FN v3 ggx_cap_half_vector(ggx_cap s, real u1, real u2) {
    k_sincos phi = k_sincos_2pi(u1);
    real depth = u2 * s.w;
    real rise = (R(1.0) - u2) * s.w;
    real radius = k_sqrt(depth * (rise + s.rest));
    return v3_of(s.g.i_std.x + radius * phi.c, s.g.i_std.y + radius * phi.s, rise + s.spare);
}

K_FN facet_draw ggx_cap_draw(ggx_cap s, real u1, real u2) {
    v3 h = ggx_cap_half_vector(s, u1, u2);
    return ggx_visible_draw(s.g, s.visible, ggx_pair_of_stretched(s.g, h));
}

#endif
