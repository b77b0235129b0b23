/* kernel/ggx_horizon_point.h: what the four horizon samplers share: the useful normals of a base, and
 * the way between a point of their ellipse and the pair of directions that belongs to it.
 *
 * A point is (v, s, e): s = |y|^2 = 1 - v, e = y/|y|. With p_y the density in dy/pi,
 *     p(o) = D(m)/(4 L_i a b) * spread,   spread = p_y z/(m.i_std),   L_i = t_i = |A i|,
 *     o_z = t_i L v/|A m|^2   (i_z > 0),
 * positive by construction. spread = 1/nu where p_y is the exact density 1 + (k.y)/z.
 *
 * m.i and m_z of the stretched normal vanish at the rim of what is seen, each as a difference. Their
 * product does not: 2 (m.i) m_z = L v + c |A m|^2. The smaller one is taken from it. */
#ifndef K_GGX_HORIZON_POINT_H
#define K_GGX_HORIZON_POINT_H

#include "ggx_horizon_frame.h"

/* The density stays what it is there on the last of the way to the horizon, where one draw in 10^12
 * ends: v is divided by, and cubed, in float. */
#define GGX_HORIZON_V_MIN R(1e-12)

K_STRUCT(ggx_horizon_set) {
    ggx_base g;
    kint front;     /* i_z > 0 */
    real c;         /* max(i_std.z, 0) */
    real lambda;    /* L */
    real rise;      /* t_i L */
    real pdf_scale; /* p = pdf_scale D spread */
    real share;     /* weight = share G2/G1(i) / spread */
};

/* L and a b of the reflections above the surface, or of another cone that the sampler stays in */
K_FN ggx_horizon_set ggx_horizon_set_of(ggx_base g, real lambda, real ab, real i_z) {
    real four_t_ab = R(4.0) * g.t_i * ab;
    real inv = R(1.0) / (four_t_ab * g.density_bias);
    ggx_horizon_set s;
    s.g = g;
    s.front = k_flag(i_z > R(0.0));
    s.c = k_max(i_z, R(0.0));
    s.lambda = lambda;
    s.rise = g.t_i * lambda;
    s.pdf_scale = g.density_bias * g.density_bias * inv;
    s.share = four_t_ab * four_t_ab * g.value_scale * inv;
    return s;
}

/* With no second plane every draw leaves; with one there is no closed form. */
K_FN real ggx_horizon_set_acceptance(ggx_horizon_set s) {
    return k_select(k_is(s.g.tilted), R(-1.0), R(1.0));
}

/* z^2 = v + g1 y1^2 + g2 y2^2 */
K_FN real ggx_horizon_z(ggx_horizon_frame f, real v, real s, ggx_horizon_angle e) {
    return k_sqrt(v + s * (f.g1 * e.c * e.c + f.g2 * e.s * e.s));
}

/* What z^2 - (k.y)^2 has besides v, for one direction of y: g less k^2, nothing from behind. */
K_FN real ggx_horizon_slack(ggx_horizon_set s, real g, real k2) {
    return k_select(k_is(s.front), k_max(g - k2, R(0.0)), R(0.0));
}

/* p_y z/(m.i_std), held where it overflows; a draw and its density hold it alike */
K_FN real ggx_horizon_spread(real p_y, real z, real im) {
    return p_y * z / k_max(im, R(1e-7) * z);
}

/* Where a point of the ellipse leads. */
K_STRUCT(ggx_horizon_arrival) {
    facet_pair pair;
    real z;
    real im; /* i_std . m, m stretched */
};

/* h: the stretched normal, of length 1, h.n = z; im = i_std.h; h^T Q h = L v. */
K_FN ggx_horizon_arrival ggx_horizon_arrive(ggx_horizon_set s, v3 h, real z, real im, real v) {
    ggx_base g = s.g;
    v3 am = ggx_stretch(h, g.ax, g.ay);
    real product = R(0.5) * (s.lambda * v + s.c * v3_dot(am, am));
    real larger = k_max(k_max(h.z, im), K_TINY);
    real smaller = product / larger;
    am.z = k_select(h.z < R(0.25) * larger, smaller, h.z);
    im = k_select(im < R(0.25) * larger, smaller, im);
    real am2 = v3_dot(am, am);
    real inv = R(1.0) / k_sqrt(am2);

    ggx_horizon_arrival to;
    to.z = z;
    to.im = im;
    to.pair.m = v3_scale(am, inv);
    to.pair.cos_im = g.t_i * im * inv;
    to.pair.d = ggx_d_stretched(g, am2);
    /* by the m that came out, not by the formula: that keeps wo a unit vector to the last digits;
     * near the horizon, where it cancels, by what is left of v */
    v3 wo = v3_sub(v3_scale(to.pair.m, R(2.0) * v3_dot(g.wi, to.pair.m)), g.wi);
    wo.z = k_select(k_and(k_is(s.front), wo.z < R(0.0625)), s.rise * v * inv * inv, wo.z);
    to.pair.wo = wo;
    to.pair.leaves = facet_leaves(wo, g.plane);
    return to;
}

/* v in (0, 1], rest = 1 - v, e of length 1. */
K_FN ggx_horizon_arrival ggx_horizon_arrive_in(ggx_horizon_set s, ggx_horizon_frame f, real v,
                                               real rest, ggx_horizon_angle e) {
    real radius = k_sqrt(rest);
    real y1 = radius * e.c;
    real y2 = radius * e.s;
    real z = ggx_horizon_z(f, v, rest, e);
    v3 h = v3_combine(f.e1, f.a * y1, f.e2, f.b * y2, f.n, z);
    return ggx_horizon_arrive(s, h, z, f.nu * (z + f.k1 * y1 + f.k2 * y2), v);
}

/* D cancels from the weight: it is made of the shadowing and the spread alone. */
K_FN facet_draw ggx_horizon_draw_of(ggx_horizon_set s, facet_pair pair, real spread) {
    real pdf = s.pdf_scale * pair.d * spread;
    real weight = s.share * ggx_shadowing(s.g, pair.wo) / spread;
    return ggx_weighted_draw(s.g, pair, R(4.0) * pair.cos_im * pdf, pdf, weight);
}

K_FN bool ggx_horizon_holds(facet_pair pair) {
    return k_and(pair.wo.z > R(0.0), k_and(pair.m.z > R(0.0), pair.cos_im > R(0.0)));
}

/* How far inside the ellipse a pair lies; without meaning where nothing is drawn. above: wo over the plane
 * whose ellipse it is. */
K_STRUCT(ggx_horizon_height) {
    v3 w; /* A^-1 m */
    real v;
    real rest; /* 1 - v */
    real im;
};

K_FN ggx_horizon_height ggx_horizon_height_of(ggx_horizon_set s, facet_pair pair, real above) {
    ggx_horizon_height p;
    p.w = v3_of(pair.m.x * s.g.inv_ax, pair.m.y * s.g.inv_ay, pair.m.z);
    real am2 = R(1.0) / k_max(v3_dot(p.w, p.w), K_TINY);
    real am = k_sqrt(am2);
    p.im = pair.cos_im * am / s.g.t_i;
    real from_wo = above * am2 / s.rise;
    real from_m = R(2.0) * p.im * pair.m.z * am / s.lambda;
    p.v = k_min(k_max(k_select(k_is(s.front), from_wo, from_m), GGX_HORIZON_V_MIN), R(1.0));
    p.rest = R(1.0) - p.v;
    return p;
}

/* The direction of (y1, y2). */
K_FN ggx_horizon_angle ggx_horizon_angle_of(real y1, real y2) {
    real y_y = y1 * y1 + y2 * y2;
    real inv = R(1.0) / k_sqrt(k_max(y_y, K_TINY));
    bool off_centre = y_y > K_TINY;
    ggx_horizon_angle e;
    e.c = k_select(off_centre, y1 * inv, R(1.0));
    e.s = k_select(off_centre, y2 * inv, R(0.0));
    return e;
}

/* Where in the ellipse it lies. */
K_STRUCT(ggx_horizon_point) {
    real v;
    real rest; /* 1 - v */
    ggx_horizon_angle e;
    real z;
    real im;
};

K_FN ggx_horizon_point ggx_horizon_point_of(ggx_horizon_set s, ggx_horizon_frame f,
                                            facet_pair pair) {
    ggx_horizon_height at = ggx_horizon_height_of(s, pair, pair.wo.z);
    ggx_horizon_point p;
    p.v = at.v;
    p.rest = at.rest;
    p.im = at.im;
    p.e = ggx_horizon_angle_of(f.b * v3_dot(at.w, f.e1), f.a * v3_dot(at.w, f.e2));
    p.z = ggx_horizon_z(f, p.v, p.rest, p.e);
    return p;
}

K_FN real ggx_horizon_density(ggx_horizon_set s, facet_pair pair, real spread) {
    return k_select(ggx_horizon_holds(pair), s.pdf_scale * pair.d * spread, R(0.0));
}

/* from the density over directions to that over the sphere of normals */
K_FN real ggx_horizon_density_m(facet_pair pair, real pdf) {
    return R(4.0) * k_max(pair.cos_im, R(0.0)) * pdf;
}

#endif
