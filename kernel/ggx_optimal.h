/* kernel/ggx_optimal.h: the smallest spherical cap of any axis that holds every reflection which
 * leaves the surface (docs/optimal-caps.md). A cap holds them all iff S - lambda Q is positive
 * semidefinite (S-lemma); at the optimum one scalar f is left:
 *
 *   c(f) = q0 - d f^2/2,   a(f) = u1 e1 + (u2 + d f) e2 + (mu1 - c(f)) i,   kappa = c/|a|,
 *
 * mu1 <= mu2 the eigenvalues of A^2 across i, e1, e2 their directions, d = mu2 - mu1. Every f gives a
 * valid cap, so a rough root costs area and never exactness. All of it is multiplied by i_z, which
 * keeps it finite at grazing incidence, and f is scaled by sqrt(mu2): it then lies in [-sqrt(2),
 * sqrt(2)] where roughness is at most 1. For i_z <= 0 the cap of the visible normals is optimal. */
#ifndef K_GGX_OPTIMAL_H
#define K_GGX_OPTIMAL_H

#include "ggx_cap.h"

/* Halley steps: area within 1.001 of the optimum (tests/kernel/optimal_template.h). */
#define GGX_OPTIMAL_STEPS 5

K_STRUCT(ggx_optimal) {
    ggx_base g;
    ggx_visible visible;
    v3 axis;
    v3 across_x;
    v3 across_y;
    real w;     /* 1 - kappa */
    kint tilts; /* else: the cap of the visible normals, about z */
};

/* What the cap's free scalar needs: everything in the frame (e1, e2, i_std). */
K_STRUCT(ggx_optimal_frame) {
    real mu1;
    real mu2;
    real gap; /* mu2 - mu1 */
    real u1;  /* times i_z */
    real u2;  /* times i_z, >= 0 */
    real q0;
    v3 e1;
    v3 e2;
};

/* A^2 restricted to the plane across i_std, diagonalised. In the basis t1 = (-y, x, 0), t2 = i x t1
 * (x, y the azimuth of i_std) every entry is a sum of positive terms or a product. */
K_FN ggx_optimal_frame ggx_optimal_frame_of(ggx_base g) {
    facet_azimuth azimuth = facet_azimuth_of(g.i_std);
    real rho = azimuth.rho;
    real x = azimuth.x;
    real y = azimuth.y;
    real z = g.i_std.z;
    real ax2 = g.ax * g.ax;
    real ay2 = g.ay * g.ay;
    real difference = (g.ax - g.ay) * (g.ax + g.ay);
    real along = ax2 * x * x + ay2 * y * y;
    real m11 = ax2 * y * y + ay2 * x * x;
    real m22 = z * z * along + rho * rho;
    real m12 = z * x * y * difference;
    real half_gap = R(0.5) * (m11 - m22);
    real radius = k_sqrt(half_gap * half_gap + m12 * m12);
    real det = g.i_std.x * g.i_std.x * ay2 + g.i_std.y * g.i_std.y * ax2 + z * z * ax2 * ay2;

    ggx_optimal_frame q;
    q.mu2 = R(0.5) * (m11 + m22) + radius;
    q.mu1 = k_min(det / q.mu2, q.mu2);
    q.gap = R(2.0) * radius;
    q.q0 = R(0.5) * (q.mu1 + rho * rho * along + z * z) - R(1.0);

    /* half of the angle whose cosine and sine are half_gap/radius and m12/radius */
    bool turned = radius > K_TINY;
    real inv_radius = R(1.0) / k_max(radius, K_TINY);
    real cos_double = k_select(turned, half_gap * inv_radius, R(1.0));
    real sin_double = k_select(turned, m12 * inv_radius, R(0.0));
    real larger = k_sqrt(R(0.5) * (R(1.0) + k_abs(cos_double)));
    real smaller = R(0.5) * k_abs(sin_double) / larger;
    real c = k_select(cos_double < R(0.0), smaller, larger);
    real s = k_sign(sin_double) * k_select(cos_double < R(0.0), larger, smaller);
    v3 t1 = v3_of(-y, x, R(0.0));
    v3 t2 = v3_of(-z * x, -z * y, rho);
    real along_t1 = z * rho * x * y * difference;
    real along_t2 = rho * (rho * rho + z * z * along);
    real u2 = c * along_t1 + s * along_t2;
    real flip = k_sign(u2);
    q.e1 = v3_sub(v3_scale(t2, c), v3_scale(t1, s));
    q.e2 = v3_scale(v3_add(v3_scale(t1, c), v3_scale(t2, s)), flip);
    q.u1 = c * along_t2 - s * along_t1;
    q.u2 = flip * u2;
    return q;
}

/* The best f: the root of mu2 d f^3 + 3 u2 d f^2 + 2 (mu1 (mu1 - q0) + u^2 + d q0) f + 2 q0 u2, on the
 * side where q0 f <= 0, by Halley's steps from the root of its lower part. */
K_FN real ggx_optimal_root(ggx_optimal_frame q, real z) {
    real scale = k_sqrt(q.mu2);
    real side = R(-1.0) * k_sign(q.q0 - K_TINY); /* +1 for q0 <= 0 */
    real d = z * q.gap;
    real c3 = z * d;
    real c2 = side * R(3.0) * q.u2 * d / scale;
    real c1 =
        R(2.0) * (z * z * (q.mu1 * (q.mu1 - q.q0) + q.gap * q.q0) + q.u1 * q.u1 + q.u2 * q.u2);
    real c0 = R(-2.0) * k_abs(q.q0) * z * q.u2 * scale;
    real disc = k_sqrt(k_max(c1 * c1 - R(4.0) * c2 * c0, R(0.0)));
    real rising = R(-2.0) * c0 / k_max(c1 + disc, K_TINY);
    real falling = (disc - c1) / k_max(R(2.0) * c2, K_TINY);
    real top = k_select(side < R(0.0), q.u2 * scale / k_max(d, K_TINY), R(1.41421356237309505));
    real f = k_min(top, k_select(c1 < R(0.0), falling, rising));
    for (int step = 0; step < GGX_OPTIMAL_STEPS; ++step) {
        real p = ((c3 * f + c2) * f + c1) * f + c0;
        real p1 = (R(3.0) * c3 * f + R(2.0) * c2) * f + c1;
        real p2 = R(6.0) * c3 * f + R(2.0) * c2;
        real bottom = R(2.0) * p1 * p1 - p * p2;
        real change = R(2.0) * p * p1 / k_select(k_abs(bottom) > K_TINY, bottom, R(1.0));
        f = k_min(k_max(f - change, R(0.0)), top);
    }
    return side * f / scale;
}

/* c(f) i_z, and |a(f)| i_z */
K_FN real ggx_optimal_c(ggx_optimal_frame q, real z, real f) {
    return z * (q.q0 - R(0.5) * q.gap * f * f);
}

K_FN v3 ggx_optimal_axis(ggx_optimal_frame q, v3 i, real f) {
    real z = i.z;
    real along_i = z * q.mu1 - ggx_optimal_c(q, z, f);
    return v3_combine(q.e1, q.u1, q.e2, q.u2 + z * q.gap * f, i, along_i);
}

/* Any orthonormal pair across a unit axis (Duff et al. 2017); its seam is at axis.z = 0. */
K_FN ggx_optimal ggx_optimal_with_axis(ggx_base g, v3 axis, real w) {
    real side = k_sign(axis.z);
    real b = R(-1.0) / (side + axis.z);
    real xy = axis.x * axis.y * b;
    ggx_optimal s;
    s.g = g;
    s.visible = ggx_visible_of(g, w);
    s.axis = axis;
    s.w = w;
    s.across_x = v3_of(R(1.0) + side * axis.x * axis.x * b, side * xy, -side * axis.x);
    s.across_y = v3_of(xy, side + axis.y * axis.y * b, -axis.y);
    return s;
}

K_FN ggx_optimal ggx_optimal_prepare(ggx_base g) {
    ggx_optimal_frame q = ggx_optimal_frame_of(g);
    real z = k_max(g.i_std.z, R(0.0));
    real f = ggx_optimal_root(q, z);
    v3 a = ggx_optimal_axis(q, v3_of(g.i_std.x, g.i_std.y, z), f);
    real inv_norm = R(1.0) / k_sqrt(k_max(v3_dot(a, a), K_TINY));
    real w = R(1.0) - ggx_optimal_c(q, z, f) * inv_norm;
    /* from behind, and where rounding spoils a grazing case: the cap of the visible normals */
    bool tilts = k_and(g.i_std.z > R(0.0), k_and(w > R(0.0), w < g.one_plus_z));
    v3 axis = v3_select(tilts, v3_scale(a, inv_norm), v3_of(R(0.0), R(0.0), R(1.0)));
    ggx_optimal s = ggx_optimal_with_axis(g, axis, k_select(tilts, w, g.one_plus_z));
    s.tilts = k_flag(tilts);
    return s;
}

K_FN real ggx_optimal_pdf(ggx_optimal s, facet_pair pair) {
    return ggx_visible_pdf(s.visible, pair);
}

K_FN real ggx_optimal_pdf_m(ggx_optimal s, facet_pair pair) {
    real depth = R(1.0) - v3_dot(s.axis, ggx_stretched_out(s.g, pair.m));
    return k_select(k_or(pair.leaves, depth <= s.w), ggx_visible_pdf_m(s.visible, pair), R(0.0));
}

K_FN real ggx_optimal_acceptance(ggx_optimal s) {
    return ggx_visible_acceptance(s.g, s.visible);
}

K_FN v3 ggx_optimal_half_vector(ggx_optimal s, real u1, real u2) {
    k_sincos phi = k_sincos_2pi(u1);
    real depth = u2 * s.w;
    real radius = k_sqrt(depth * (R(2.0) - depth));
    v3 o =
        v3_combine(s.across_x, radius * phi.c, s.across_y, radius * phi.s, s.axis, R(1.0) - depth);
    return v3_add(s.g.i_std, o);
}

K_FN facet_draw ggx_optimal_draw(ggx_optimal s, real u1, real u2, real u3) {
    /* from behind the cap is small and opposite to i: there only the form about z does not cancel */
    v3 about_z = ggx_cap_half_vector(ggx_cap_of(s.g, R(0.0)), u1, u2);
    v3 h = v3_select(k_is(s.tilts), ggx_optimal_half_vector(s, u1, u2), about_z);
    return ggx_visible_draw(s.g, s.visible, ggx_pair_of_stretched(s.g, h));
}

/* Worst errors of a draw in float, 2 10^7 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side).
 * wo:  1.7e-05 at wi (0x1.f82b86p-1, -0x1.52018cp-3, 0x1.c9158p-5),
 *      alpha (0x1.b9e8ep+0, 0x1.9c9b14p-7) u (0x1.f5028p-2, 0x1.f27ae4p-1)
 * pdf: 1.2e-06 relative at wi (-0x1.511b14p-1, -0x1.61bc56p-1, -0x1.31c6b8p-2),
 *      alpha (0x1.185daep-5, 0x1.185daep-5) u (0x1.bbf3fep-1, 0x1.55ba56p-2) */

#endif
