/* kernel/ggx_horizon_uniform.h: uniform over the useful normals within half a per cent, in closed form
 * and continuous: a shift of the angle (kernel/ggx_horizon_shift.h) stands for the odd part
 * h = (k.y)/z of the density. Along k it is h exactly, and everywhere for roughness 1 or at i_z = 0. */
#ifndef K_GGX_HORIZON_UNIFORM_H
#define K_GGX_HORIZON_UNIFORM_H

#include "ggx_horizon_disk.h"
#include "ggx_horizon_point.h"
#include "ggx_horizon_shift.h"

/* |d|^2 at most: the density nowhere falls below (1 - |d|)/(1 + |d|) of its other end. */
#define GGX_HORIZON_UNIFORM_LIMIT R(0.98)

K_STRUCT(ggx_horizon_uniform) {
    ggx_horizon_set set;
    ggx_horizon_disk f;
    ggx_horizon_back back;
    real squeeze; /* of z^2 along k: k^T G k/|k|^2 */
    real slack;   /* squeeze - |k|^2 */
    real limit;   /* of s/z^2 */
};

/* In the ellipse of a form; i_z > 0 but for the shading plane seen from behind. */
K_FN ggx_horizon_uniform ggx_horizon_uniform_of(ggx_base g, ggx_horizon_form q, ggx_horizon_eigen e,
                                                v3 i, real i_z) {
    ggx_horizon_shape shape = ggx_horizon_shape_of(q, e);
    ggx_horizon_disk f = ggx_horizon_disk_of_shape(shape, e, i);
    real k_k = f.k1 * f.k1 + f.k2 * f.k2;
    real inv = R(1.0) / k_max(k_k, K_TINY);
    real along = (f.g11 * f.k1 + R(2.0) * f.g12 * f.k2) * f.k1 + f.g22 * f.k2 * f.k2;
    ggx_horizon_uniform s;
    s.f = f;
    s.back = ggx_horizon_back_of_shape(shape);
    s.set = ggx_horizon_set_of(g, f.lambda, f.ab, i_z);
    s.squeeze = along * inv;
    s.slack = ggx_horizon_slack(s.set, s.squeeze, k_k);
    s.limit = GGX_HORIZON_UNIFORM_LIMIT * inv;
    return s;
}

K_FN ggx_horizon_uniform ggx_horizon_uniform_prepare(ggx_base g) {
    ggx_useful u = ggx_useful_of(g);
    return ggx_horizon_uniform_of(g, ggx_horizon_form_of(u), ggx_horizon_eigen_of(u), u.i, u.i.z);
}

/* d = k sqrt(s/(v + s squeeze)), shortened to the limit */
K_FN ggx_horizon_shift ggx_horizon_uniform_shift(ggx_horizon_uniform s, real v, real rest) {
    real inv = R(1.0) / (v + rest * s.squeeze);
    real reach = k_sqrt(k_min(rest * inv, s.limit));
    ggx_horizon_shift d;
    d.d1 = s.f.k1 * reach;
    d.d2 = s.f.k2 * reach;
    d.room = k_max((v + rest * s.slack) * inv, R(1.0) - GGX_HORIZON_UNIFORM_LIMIT);
    return d;
}

/* The spread of a pair whose wo is this far above the plane. */
K_FN real ggx_horizon_uniform_spread(ggx_horizon_uniform s, facet_pair pair, real above) {
    ggx_horizon_height at = ggx_horizon_height_of(s.set, pair, above);
    ggx_horizon_angle e = ggx_horizon_angle_of(v3_dot(at.w, s.back.d1), v3_dot(at.w, s.back.d2));
    ggx_horizon_shift d = ggx_horizon_uniform_shift(s, at.v, at.rest);
    real z = ggx_horizon_disk_z(s.f, at.v, at.rest, e);
    return ggx_horizon_spread(ggx_horizon_shift_density(d, e.c, e.s), z, at.im);
}

K_FN real ggx_horizon_uniform_pdf(ggx_horizon_uniform s, facet_pair pair) {
    return ggx_horizon_density(s.set, pair, ggx_horizon_uniform_spread(s, pair, pair.wo.z));
}

K_FN real ggx_horizon_uniform_pdf_m(ggx_horizon_uniform s, facet_pair pair) {
    return ggx_horizon_density_m(pair, ggx_horizon_uniform_pdf(s, pair));
}

K_FN real ggx_horizon_uniform_acceptance(ggx_horizon_uniform s) {
    return ggx_horizon_set_acceptance(s.set);
}

/* A stretched normal of the ellipse. */
K_STRUCT(ggx_horizon_shifted) {
    v3 h;
    real z;  /* h.n */
    real im; /* h.i */
    real p_y;
};

K_FN ggx_horizon_shifted ggx_horizon_uniform_normal(ggx_horizon_uniform s, real u1, real u2) {
    k_sincos phi = k_sincos_2pi(u1);
    real v = R(1.0) - u2;
    ggx_horizon_shift d = ggx_horizon_uniform_shift(s, v, u2);
    real f1 = phi.c + d.d1;
    real f2 = phi.s + d.d2;
    real inv = R(1.0) / k_sqrt(f1 * f1 + f2 * f2);
    ggx_horizon_angle e;
    e.c = f1 * inv;
    e.s = f2 * inv;
    real radius = k_sqrt(u2);
    ggx_horizon_shifted m;
    m.z = ggx_horizon_disk_z(s.f, v, u2, e);
    m.h = v3_combine(s.f.f1, radius * e.c, s.f.f2, radius * e.s, s.f.n, m.z);
    m.im = s.f.nu * (m.z + radius * (s.f.k1 * e.c + s.f.k2 * e.s));
    m.p_y = ggx_horizon_shift_density(d, e.c, e.s);
    return m;
}

K_FN facet_draw ggx_horizon_uniform_draw(ggx_horizon_uniform s, real u1, real u2, real u3) {
    ggx_horizon_shifted m = ggx_horizon_uniform_normal(s, u1, u2);
    ggx_horizon_arrival to = ggx_horizon_arrive(s.set, m.h, m.z, m.im, R(1.0) - u2);
    return ggx_horizon_draw_of(s.set, to.pair, ggx_horizon_spread(m.p_y, m.z, to.im));
}

/* Worst errors of a draw in float, 4 10^6 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side). The density is
 * worst from behind where i.m -> 0: it is divided by that.
 * wo:  0.00018 at wi (-0x1.688c28p-7, -0x1.18157ap-2, -0x1.ec7184p-1),
 *      alpha (0x1.7a66ap-3, 0x1.47d03ap-7) u (0x1.1ce658p-3, 0x1.bb3718p-1)
 * pdf: 0.00035 relative at wi (0x1.3511ecp-4, 0x1.d9c9a6p-4, -0x1.fb17fcp-1),
 *      alpha (0x1.cceec8p-7, 0x1.cceec8p-7) u (0x1.48efp-1, 0x1.e95ffp-1) */

#endif
