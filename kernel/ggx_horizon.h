/* kernel/ggx_horizon.h: reflections that leave, more of them where shadowing lets more light through.
 *
 * Over the useful ellipse G2/G1(i) is v/(v + eta) up to a constant: nearly a function of the radius,
 * since o_z |A m|^2 is one. The density follows (1 - delta) G + delta, delta = g.floor_share: delta = 1
 * is uniform, 0 follows shadowing down to the horizon. At the horizon (v = 0)
 *     eta = 2 (m.i) X/L,   X = |(c_x m_x - m_z i_x, c_y m_y - m_z i_y)|,
 * taken at the four ends of the axes.
 *
 * Radius: a rational quadratic with the end densities q0 (horizon) and q1 (centre),
 *     D = P v^2 + gamma v s + s^2,   q(v) = (P^2 q1 v^2 + 2 P v s + q0 s^2)/D^2,
 * inverted in closed form. Angle: at that radius the density that is wanted is known at the four ends,
 * G+- for each axis; a shift (kernel/ggx_horizon_shift.h) followed by a stretch of the axes by
 * sqrt(S1), sqrt(S2) passes through all four.
 *
 * The map is continuous in i but for two directions of an anisotropic surface, where the ellipse is a
 * circle and its axes lie differently on every way there: i in the plane of the narrower axis at
 * tan^2(theta) = (ay^2 - ax^2)(1 + ay^2)/ax^2. The limits of o are up to 0.7 apart
 * (tests/kernel/test_horizon_map.c). */
#ifndef K_GGX_HORIZON_H
#define K_GGX_HORIZON_H

#include "ggx_horizon_point.h"
#include "ggx_horizon_shift.h"

/* What the odd part of the angle's density is held to, and the smallest mean eta of an axis. */
#define GGX_HORIZON_LEAN R(0.99)
#define GGX_HORIZON_ETA_MIN R(1e-6)

K_STRUCT(ggx_horizon) {
    ggx_horizon_set set;
    ggx_horizon_frame f;
    real level;  /* delta */
    real slack1; /* g - k^2 of the axes: 0 where wi is behind */
    real slack2;
    real eta1p; /* at +e1, -e1, +e2, -e2 */
    real eta1m;
    real eta2p;
    real eta2m;
    real p;
    real q0;
    real q1;
    real gamma;
};

/* eta at the ends of one axis, divided by q, and their harmonic mean as the radius sees it */
K_STRUCT(ggx_horizon_ends) {
    real plus;
    real minus;
    real mean_top;
    real mean_bottom;
};

/* e, reach, g, k of one axis. W(m) = (c_x m_x - m_z i_x, c_y m_y - m_z i_y) is linear, and
 * W(n) = -L (n_x, n_y). */
K_FN ggx_horizon_ends ggx_horizon_ends_of(ggx_horizon_frame f, ggx_useful u, v3 e, real reach,
                                          real g, real k) {
    real z = k_sqrt(g);
    real along_x = reach * (u.cx * e.x - e.z * u.i.x);
    real along_y = reach * (u.cy * e.y - e.z * u.i.y);
    real up_x = z * f.lambda * f.n.x;
    real up_y = z * f.lambda * f.n.y;
    real plus = k_sqrt(k_square(along_x - up_x) + k_square(along_y - up_y));
    real minus = k_sqrt(k_square(along_x + up_x) + k_square(along_y + up_y));
    ggx_horizon_ends ends;
    ends.plus = k_max(z + k, R(0.0)) * plus;
    ends.minus = k_max(z - k, R(0.0)) * minus;
    ends.mean_top = R(2.0) * z * plus * minus;
    ends.mean_bottom = k_max(plus + minus, R(1e-9));
    return ends;
}

/* The radius' mean of v/(v + eta), eta between h1 and h2 round the ellipse, by Gauss's three nodes x_j in
 * [0, 1] with v = x^2: sum of 2 w_j x_j^3/r_j, over one denominator. */
K_FN real ggx_horizon_mean_shadowing(real h1, real h2) {
    real a = R(0.012701665379258311482);
    real b = R(0.25);
    real c = R(0.78729833462074168852);
    real ra = k_sqrt((a + (R(1.0) - a) * h1) * (a + (R(1.0) - a) * h2));
    real rb = k_sqrt((b + (R(1.0) - b) * h1) * (b + (R(1.0) - b) * h2));
    real rc = k_sqrt((c + (R(1.0) - c) * h1) * (c + (R(1.0) - c) * h2));
    real sum = R(0.00079527713407360018548) * rb * rc + R(0.11111111111111111111) * ra * rc +
               R(0.3880936117548152887) * ra * rb;
    return sum / (ra * rb * rc);
}

/* eta at m = n, times L */
K_FN real ggx_horizon_eta_centre(ggx_base g, ggx_horizon_frame f, real c) {
    v3 aan = ggx_stretch(ggx_stretch(f.n, g.ax, g.ay), g.ax, g.ay);
    v3 w = v3_sub(v3_scale(aan, R(2.0) * f.nu), v3_scale(g.i_std, v3_dot(f.n, aan)));
    return c * k_sqrt(v3_dot(w, w));
}

K_FN ggx_horizon ggx_horizon_prepare(ggx_base g) {
    ggx_useful u = ggx_useful_of(g);
    ggx_horizon s;
    ggx_horizon_frame f = ggx_horizon_frame_of(u);
    s.f = f;
    s.set = ggx_horizon_set_of(g, f.lambda, f.a * f.b, u.i.z);
    ggx_horizon_ends x1 = ggx_horizon_ends_of(f, u, f.e1, f.a, f.g1, f.k1);
    ggx_horizon_ends x2 = ggx_horizon_ends_of(f, u, f.e2, f.b, f.g2, f.k2);
    real eta_centre = ggx_horizon_eta_centre(g, f, u.c);
    real centre = f.lambda + eta_centre;
    real inv_all = R(1.0) / (centre * x1.mean_bottom * x2.mean_bottom);
    /* at grazing incidence and from behind there is no shadowing to follow, but rounding */
    real per_end = R(2.0) * f.nu * inv_all * x1.mean_bottom * x2.mean_bottom;
    bool follows = u.c > R(1e-7);
    real q = k_select(follows, per_end, R(0.0));
    real q_inv = k_select(follows, per_end * centre * inv_all, R(0.0));
    s.eta1p = q * x1.plus;
    s.eta1m = q * x1.minus;
    s.eta2p = q * x2.plus;
    s.eta2m = q * x2.minus;
    real h1 = k_max(q_inv * x1.mean_top * x2.mean_bottom, GGX_HORIZON_ETA_MIN);
    real h2 = k_max(q_inv * x2.mean_top * x1.mean_bottom, GGX_HORIZON_ETA_MIN);
    s.level = g.floor_share;
    s.slack1 = ggx_horizon_slack(s.set, f.g1, f.k1 * f.k1);
    s.slack2 = ggx_horizon_slack(s.set, f.g2, f.k2 * f.k2);
    real mean_g = ggx_horizon_mean_shadowing(h1, h2);
    real mean = (R(1.0) - s.level) * mean_g + s.level;
    real mean_h = k_sqrt(h1 * h2);
    real steep = mean_h * mean_g * mean_g;
    real inv = R(1.0) / (mean * steep);
    /* sqrt(min/max) = min/sqrt(min max) */
    real uneven = R(1.0) - k_min(h1, h2) * (inv * mean * mean_g * mean_g);
    real even = k_max(R(1.0) - k_square(k_square(uneven)), R(0.1));
    s.q1 = inv * steep;
    s.q0 = s.level * s.q1;
    s.p = R(0.5) * even * mean * mean * inv;
    s.gamma = s.q0 + s.p * s.q1;
    return s;
}

/* The density that is wanted at one radius, at the two ends of an axis: its sum, the odd part of it, and
 * 1 - odd^2. */
K_STRUCT(ggx_horizon_axis) {
    real sum;
    real odd;
    real room;
};

/* (1 +- h) (v + delta s eta)/(v + s eta), h = k_r/z, the smaller of z +- k_r by their product z^2 - k_r^2 */
K_FN ggx_horizon_axis ggx_horizon_axis_of(real k_r, real z, real product, real v, real level,
                                          real shade_p, real shade_m) {
    real all_p = v + shade_p;
    real all_m = v + shade_m;
    real larger = z + k_abs(k_r);
    real larger2 = larger * larger;
    bool to_plus = k_r > R(0.0);
    real plus = k_select(to_plus, larger2, product) * (v + level * shade_p) * all_m;
    real minus = k_select(to_plus, product, larger2) * (v + level * shade_m) * all_p;
    real both = plus + minus;
    real inv_both = R(1.0) / both;
    real share_p = plus * inv_both;
    real share_m = minus * inv_both;
    ggx_horizon_axis axis;
    axis.sum = both / (z * larger * all_p * all_m);
    axis.odd = k_min(k_max(share_p - share_m, -GGX_HORIZON_LEAN), GGX_HORIZON_LEAN);
    axis.room = k_max(R(4.0) * share_p * share_m, R(1.0) - GGX_HORIZON_LEAN * GGX_HORIZON_LEAN);
    return axis;
}

/* The shift, and the stretch of the axes. */
K_STRUCT(ggx_horizon_lean) {
    ggx_horizon_shift d;
    real sum1;
    real sum2;
};

/* d1 = o1 sqrt((1 - o2^2)/(1 - o1^2 o2^2)): then the ends of both axes have the odd parts o1, o2 */
K_FN ggx_horizon_lean ggx_horizon_lean_of(ggx_horizon s, real v, real rest) {
    ggx_horizon_frame f = s.f;
    real radius = k_sqrt(rest);
    real z1 = k_sqrt(v + rest * f.g1);
    real z2 = k_sqrt(v + rest * f.g2);
    ggx_horizon_axis a1 = ggx_horizon_axis_of(f.k1 * radius, z1, v + rest * s.slack1, v, s.level,
                                              rest * s.eta1p, rest * s.eta1m);
    ggx_horizon_axis a2 = ggx_horizon_axis_of(f.k2 * radius, z2, v + rest * s.slack2, v, s.level,
                                              rest * s.eta2p, rest * s.eta2m);
    /* 1 - o1^2 o2^2 */
    real inv = R(1.0) / (a1.room + a2.room - a1.room * a2.room);
    ggx_horizon_lean lean;
    lean.sum1 = a1.sum;
    lean.sum2 = a2.sum;
    lean.d.d1 = a1.odd * k_sqrt(a2.room * inv);
    lean.d.d2 = a2.odd * k_sqrt(a1.room * inv);
    lean.d.room = a1.room * a2.room * inv;
    return lean;
}

K_FN real ggx_horizon_radial(ggx_horizon s, real v, real rest) {
    real top = (s.p * s.p * s.q1 * v + R(2.0) * s.p * rest) * v + s.q0 * rest * rest;
    real bottom = (s.p * v + s.gamma * rest) * v + rest * rest;
    return top / (bottom * bottom);
}

K_FN real ggx_horizon_pdf(ggx_horizon s, facet_pair pair) {
    ggx_horizon_point p = ggx_horizon_point_of(s.set, s.f, pair);
    ggx_horizon_lean lean = ggx_horizon_lean_of(s, p.v, p.rest);
    real root1 = k_sqrt(lean.sum1);
    real root2 = k_sqrt(lean.sum2);
    /* e before the stretch of the axes */
    real f1 = p.e.c * root2;
    real f2 = p.e.s * root1;
    real angular = root1 * root2 / (f1 * f1 + f2 * f2) * ggx_horizon_shift_density(lean.d, f1, f2);
    real p_y = ggx_horizon_radial(s, p.v, p.rest) * angular;
    return ggx_horizon_density(s.set, pair, ggx_horizon_spread(p_y, p.z, p.im));
}

K_FN real ggx_horizon_pdf_m(ggx_horizon s, facet_pair pair) {
    return ggx_horizon_density_m(pair, ggx_horizon_pdf(s, pair));
}

K_FN real ggx_horizon_acceptance(ggx_horizon s) {
    return ggx_horizon_set_acceptance(s.set);
}

K_FN facet_draw ggx_horizon_draw(ggx_horizon s, real u1, real u2, real u3) {
    ggx_horizon_angle e0 = ggx_horizon_turned(s.f, u1);
    /* the share of the disk outside the radius is u */
    real u = R(1.0) - u2;
    real b = s.q0 - u * s.gamma;
    real root = k_sqrt(b * b + R(4.0) * s.p * u2 * u);
    real outer = k_select(b < R(0.0), root - b, R(2.0) * u);
    real inner = k_select(b < R(0.0), R(2.0) * s.p * u2, b + root);
    real inv_both = R(1.0) / (outer + inner);
    real v = outer * inv_both;
    real rest = inner * inv_both;

    ggx_horizon_lean lean = ggx_horizon_lean_of(s, v, rest);
    real root1 = k_sqrt(lean.sum1);
    real root2 = k_sqrt(lean.sum2);
    real f1 = e0.c + lean.d.d1;
    real f2 = e0.s + lean.d.d2;
    real e1 = f1 * root1;
    real e2 = f2 * root2;
    real e_e = e1 * e1 + e2 * e2;
    real inv = R(1.0) / k_sqrt(e_e);
    ggx_horizon_angle e;
    e.c = e1 * inv;
    e.s = e2 * inv;
    real angular =
        e_e / (root1 * root2 * (f1 * f1 + f2 * f2)) * ggx_horizon_shift_density(lean.d, f1, f2);
    real p_y = ggx_horizon_radial(s, v, rest) * angular;
    ggx_horizon_arrival to = ggx_horizon_arrive_in(s.set, s.f, v, rest, e);
    return ggx_horizon_draw_of(s.set, to.pair, ggx_horizon_spread(p_y, to.z, to.im));
}

/* Worst errors of a draw in float, 4 10^6 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side). The density is
 * worst from behind where i.m -> 0: it is divided by that.
 * wo:  0.00014 at wi (0x1.e00ea4p-6, 0x1.725deep-1, -0x1.61322p-1),
 *      alpha (0x1.c3014ap-3, 0x1.db0e0cp-7) u (0x1.5fa188p-2, 0x1.eca4d2p-1)
 * pdf: 0.00022 relative at wi (0x1.3511ecp-4, 0x1.d9c9a6p-4, -0x1.fb17fcp-1),
 *      alpha (0x1.cceec8p-7, 0x1.cceec8p-7) u (0x1.48efp-1, 0x1.e95ffp-1) */

#endif
