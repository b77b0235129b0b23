/* kernel/ggx.h: the Smith-GGX model: what does not depend on how one samples it.
 *
 * i = wi, o = wo, A = diag(alpha_x, alpha_y, 1), t_v = |A v|, i_std = A i / t_i: the direction in the
 * stretched space where the microsurface is a hemisphere (Heitz 2018).
 *
 *   D(m)  = 1 / (pi ax ay (mx^2/ax^2 + my^2/ay^2 + mz^2)^2)                  (Walter et al. 2007)
 *   V(i)  = i_z + t_i = 2 * visible area, valid for either sign of i_z        (Tokuyoshi 2021)
 *   Dv(m) = 2 <i,m> D(m) / V(i)                          density of the visible normals
 *   p(o)  = Dv(m) / (4 <i,m>) = D(m) / (2 V(i))          <i,m> cancels and is never computed
 *   f cos = D(m) / (2 V(i)) * G2/G1(i)                   F = 1
 *
 * G2/G1 is written so that nothing cancels and nothing is divided by a cosine. */
#ifndef K_GGX_H
#define K_GGX_H

#include "facet.h"

#define GGX_ALPHA_MIN R(1e-4)
#define GGX_ALPHA_MAX R(1e4)

/* A shading point: what every sampler and density needs of (i, alpha). */
K_STRUCT(ggx_base) {
    v3 wi;
    real ax;
    real ay;
    real inv_ax;
    real inv_ay;
    v3 i_std;
    real t_i;
    real rho2;         /* i_std.x^2 + i_std.y^2 */
    real one_plus_z;   /* 1 + i_std.z and 1 - i_std.z, */
    real one_minus_z;  /* each without cancellation */
    real visible;      /* V(i) */
    real d_peak;       /* 1/(pi ax ay): D of the normal */
    real value_scale;  /* 1/(2 V(i)): f cos = D * shadowing * value_scale */
    real density_bias; /* density / what is sampled; 1 but for the previous normalisation */
    v3 plane;          /* the geometric normal */
    real floor_share;  /* how much of a density ignores shadowing, for the methods that follow it */
    kint separable;
    kint tilted; /* the plane is not the shading plane */
    kint valid;
    kint mirror;
};

K_FN real ggx_alpha_floor(real alpha) {
    return k_min(k_max(alpha, GGX_ALPHA_MIN), GGX_ALPHA_MAX);
}

K_FN v3 ggx_stretch(v3 v, real ax, real ay) {
    return v3_of(ax * v.x, ay * v.y, v.z);
}

K_FN ggx_base ggx_base_of(v3 wi, real alpha_x, real alpha_y, facet_options options) {
    bool usable = facet_inputs_usable(wi, alpha_x, alpha_y, options.plane);
    ggx_base g;
    g.wi = v3_select(usable, wi, v3_of(R(0.0), R(0.0), R(1.0)));
    g.ax = ggx_alpha_floor(k_select(usable, alpha_x, R(1.0)));
    g.ay = ggx_alpha_floor(k_select(usable, alpha_y, R(1.0)));
    /* Divisions are what a draw waits for: two here serve six quotients. */
    real inv_area = R(1.0) / (g.ax * g.ay);
    g.inv_ax = g.ay * inv_area;
    g.inv_ay = g.ax * inv_area;
    g.d_peak = K_INV_PI * inv_area;
    v3 stretched = ggx_stretch(g.wi, g.ax, g.ay);
    real z = stretched.z;
    real xy2 = stretched.x * stretched.x + stretched.y * stretched.y;
    g.t_i = k_sqrt(xy2 + z * z);
    real height = g.t_i + k_abs(z);
    real inv = R(1.0) / (g.t_i * height);
    g.i_std = v3_scale(stretched, height * inv);
    g.rho2 = g.i_std.x * g.i_std.x + g.i_std.y * g.i_std.y;
    real larger = R(1.0) + k_abs(g.i_std.z);
    real smaller = xy2 * inv;
    g.one_plus_z = k_select(z < R(0.0), smaller, larger);
    g.one_minus_z = k_select(z < R(0.0), larger, smaller);
    g.visible = g.t_i * g.one_plus_z;
    g.density_bias = k_select(k_and(k_is(options.previous), z < R(0.0)),
                              smaller * (g.t_i * g.t_i * inv), R(1.0));
    g.plane = options.plane;
    g.tilted = k_flag(facet_is_tilted(options.plane));
    g.floor_share = k_saturate(options.floor_share);
    g.separable = options.separable;
    /* straight from below nothing is visible */
    g.valid = k_flag(k_and(usable, g.visible > R(1e6) * K_TINY));
    g.visible = k_select(k_is(g.valid), g.visible, R(1.0));
    g.value_scale = R(0.5) / g.visible;
    g.mirror = k_flag(k_and(usable, k_and(alpha_x < GGX_ALPHA_MIN, alpha_y < GGX_ALPHA_MIN)));
    return g;
}

/* D of a unit m */
K_FN real ggx_d(ggx_base g, v3 m) {
    real x = m.x * g.inv_ax;
    real y = m.y * g.inv_ay;
    real e = x * x + y * y + m.z * m.z;
    return k_select(m.z > R(0.0), g.d_peak / (e * e), R(0.0));
}

/* D of the normal along A h (h any length): |A h|^2/|h|^2 is all it takes */
K_FN real ggx_d_stretched(ggx_base g, real ah2_over_h2) {
    return ah2_over_h2 * ah2_over_h2 * g.d_peak;
}

K_FN real ggx_t(v3 v, real ax, real ay) {
    v3 a = ggx_stretch(v, ax, ay);
    return k_sqrt(v3_dot(a, a));
}

/* Lambda of a direction above the surface; without the cancellation of (sqrt(1 + x) - 1)/2 */
K_FN real ggx_lambda(v3 v, real ax, real ay) {
    real x = ax * v.x;
    real y = ay * v.y;
    real tan2 = (x * x + y * y) / (v.z * v.z);
    return R(0.5) * tan2 / (R(1.0) + k_sqrt(R(1.0) + tan2));
}

/* G1 of o: 2 o_z/(o_z + t_o); 0 from below */
K_FN real ggx_g1_out(v3 wo, real ax, real ay) {
    return k_select(wo.z > R(0.0), R(2.0) * wo.z / (wo.z + ggx_t(wo, ax, ay)), R(0.0));
}

/* G1 of i, normalised for either side: 2|i_z|/V(i). Above 1 for i_z < 0: it is a normaliser there. */
K_FN real ggx_g1_in(ggx_base g) {
    return R(2.0) * k_abs(g.wi.z) / g.visible;
}

/* G2(i,o)/G1(i) for o above the surface */
K_FN real ggx_shadowing(ggx_base g, v3 wo) {
    real t_o = ggx_t(wo, g.ax, g.ay);
    /* from behind height correlation has no meaning: its limit i_z -> 0 */
    real i_z = k_max(g.wi.z, R(0.0));
    bool separable = k_is(g.separable);
    real top = k_select(separable, R(2.0), i_z + g.t_i);
    real bottom = k_select(separable, wo.z + t_o, g.t_i * wo.z + t_o * i_z);
    return wo.z * top / bottom;
}

/* f cos of a pair that leaves the surface; 0 of any other */
K_FN real ggx_f_cos(ggx_base g, facet_pair pair) {
    real value = pair.d * ggx_shadowing(g, pair.wo) * g.value_scale;
    return k_select(k_and(k_is(g.valid), pair.leaves), k_usable(value), R(0.0));
}

/* The pair of a given o. Straight back (o = -i) has no half vector: it does not leave. */
K_FN facet_pair ggx_pair_of_wo(ggx_base g, v3 wo) {
    v3 h = v3_add(g.wi, wo);
    real h2 = v3_dot(h, h);
    real safe_h2 = k_max(h2, K_TINY);
    real inv = R(1.0) / k_sqrt(safe_h2);
    real side = k_sign(h.z);
    v3 w = v3_of(h.x * g.inv_ax, h.y * g.inv_ay, h.z);
    facet_pair pair;
    pair.wo = wo;
    pair.m = v3_scale(h, inv * side);
    /* by the length of h: near straight back i.h is a difference of larger numbers */
    pair.cos_im = R(0.5) * h2 * inv * side;
    pair.d = ggx_d_stretched(g, safe_h2 / k_max(v3_dot(w, w), K_TINY));
    pair.leaves = k_and(facet_leaves(wo, g.plane),
                        k_and(h.z > R(0.0), k_and(h2 > K_TINY, pair.cos_im > R(0.0))));
    return pair;
}

/* The pair of a given m: o is i reflected about it, wherever that lies. */
K_FN facet_pair ggx_pair_of_m(ggx_base g, v3 m) {
    facet_pair pair;
    pair.m = m;
    pair.cos_im = v3_dot(g.wi, m);
    pair.wo = v3_sub(v3_scale(m, R(2.0) * pair.cos_im), g.wi);
    pair.d = ggx_d(g, m);
    pair.leaves = k_and(facet_leaves(pair.wo, g.plane), k_and(m.z > R(0.0), pair.cos_im > R(0.0)));
    return pair;
}

/* The pair of a normal drawn in the stretched space: m along A h, h of any length. i.m is taken of the
 * m that came out, not of h: that keeps o a unit vector to the last digits where h is short. */
K_FN facet_pair ggx_pair_of_stretched(ggx_base g, v3 h) {
    v3 ah = ggx_stretch(h, g.ax, g.ay);
    real h2 = v3_dot(h, h);
    real ah2 = k_max(v3_dot(ah, ah), K_TINY);
    facet_pair pair;
    pair.m = v3_scale(ah, R(1.0) / k_sqrt(ah2));
    pair.cos_im = v3_dot(g.wi, pair.m);
    pair.wo = v3_sub(v3_scale(pair.m, R(2.0) * pair.cos_im), g.wi);
    real d = ggx_d_stretched(g, ah2 / k_max(h2, K_TINY));
    pair.d = k_select(h.z >= R(0.0), d, R(0.0));
    pair.leaves = k_and(facet_leaves(pair.wo, g.plane), k_and(pair.cos_im > R(0.0), h2 > K_TINY));
    return pair;
}

K_FN facet_eval ggx_eval(ggx_base g, facet_pair pair) {
    facet_eval e;
    e.d = k_usable(k_select(pair.m.z > R(0.0), pair.d, R(0.0)));
    e.g1_i = ggx_g1_in(g);
    e.g1_o = k_usable(ggx_g1_out(pair.wo, g.ax, g.ay));
    e.g2 = k_select(pair.leaves, k_usable(e.g1_i * ggx_shadowing(g, pair.wo)), R(0.0));
    e.f_cos = ggx_f_cos(g, pair);
    return e;
}

/* Of the visible normals' density: 1 but for the previous normalisation. */
K_FN real ggx_vndf_integral(ggx_base g) {
    return g.density_bias;
}

/* A draw from its pair, the two densities of the method there, and f cos / pdf. */
K_FN facet_draw ggx_weighted_draw(ggx_base g, facet_pair pair, real pdf_m, real pdf, real weight) {
    facet_draw draw;
    bool valid = k_and(k_is(g.valid), k_and(pair.leaves, k_usable(pdf) > R(0.0)));
    draw.m = pair.m;
    draw.wo = pair.wo;
    draw.cos_im = pair.cos_im;
    draw.pdf_m = k_select(k_is(g.valid), k_usable(pdf_m), R(0.0));
    draw.pdf = k_select(valid, pdf, R(0.0));
    draw.weight = k_select(valid, k_usable(weight), R(0.0));
    return draw;
}

K_FN facet_draw ggx_draw_of(ggx_base g, facet_pair pair, real pdf_m, real pdf) {
    return ggx_weighted_draw(g, pair, pdf_m, pdf, ggx_f_cos(g, pair) / pdf);
}

#endif
