/* kernel/beckmann.h: the Smith-Beckmann model: what does not depend on how one samples it.
 *
 * i = wi, o = wo, A = diag(alpha_x, alpha_y, 1). Slopes are Gaussian; in the stretched space of A they
 * have unit roughness, and what is seen of them depends on one number alone,
 *     c(v) = v_z/b_v,   b_v = sqrt(ax^2 vx^2 + ay^2 vy^2): the cotangent of the stretched angle.
 *
 *   D(m)  = exp(-((mx/ax)^2 + (my/ay)^2)/mz^2) / (pi ax ay mz^4)             (Walter et al. 2007)
 *   V(i)  = i_z erfc(-c) + b_i exp(-c^2)/sqrt(pi) = 2 * visible area, either sign of i_z
 *                                                                           (Tokuyoshi 2021)
 *   Dv(m) = 2 <i,m> D(m)/V(i),   p(o) = D(m)/(2 V(i))        as for every Smith model
 *   V(v)  = 2 (v_z + X(v)) for v_z > 0, with X = b exp(-c^2) defect(c)/(2 sqrt(pi)) = v_z Lambda(v):
 *           nothing cancels and nothing is divided by a cosine (defect: kernel/erf.h)
 *   V(i)  = exp(-c^2) b_i defect(-c)/sqrt(pi) for i_z <= 0: D and V both underflow far below the
 *           horizon; `visible` is V without the exponential, and a pair keeps D without it. */
#ifndef K_BECKMANN_H
#define K_BECKMANN_H

#include "erf.h"
#include "facet.h"

#define BECKMANN_ALPHA_MIN R(1e-4)
#define BECKMANN_ALPHA_MAX R(1e4)

/* A shading point: what every sampler and density needs of (i, alpha). */
K_STRUCT(beckmann_base) {
    v3 wi;
    real ax;
    real ay;
    v3 i_std;          /* A i/|A i| */
    real t_i;          /* |A i| */
    real rho2;         /* i_std.x^2 + i_std.y^2 */
    real b;            /* b_i */
    real c;            /* i_z/b_i */
    real shift;        /* c^2 for i_z < 0, else 0: what the exponents leave out */
    real visible;      /* V(i) exp(shift) */
    real density_bias; /* density / what is sampled; 1 but for the previous normalisation */
    v3 plane;          /* the geometric normal */
    real floor_share;  /* how much of a density ignores shadowing, for the methods that follow it */
    kint separable;
    kint tilted; /* the plane is not the shading plane */
    kint valid;
    kint mirror;
};

K_FN real beckmann_alpha_floor(real alpha) {
    return k_min(k_max(alpha, BECKMANN_ALPHA_MIN), BECKMANN_ALPHA_MAX);
}

/* b, c and X = v_z Lambda of a direction above the surface, or of one below mirrored to above. */
K_STRUCT(beckmann_hidden) {
    real b;
    real c;
    real defect;
    real x;
};

K_FN beckmann_hidden beckmann_hidden_of(v3 v, real ax, real ay) {
    real bx = ax * v.x;
    real by = ay * v.y;
    beckmann_hidden h;
    h.b = k_sqrt(k_max(bx * bx + by * by, K_TINY));
    h.c = k_abs(v.z) / h.b;
    h.defect = k_erfcx_defect(h.c);
    h.x = R(0.5) * K_INV_SQRT_PI * h.b * (k_exp_minus_square(h.c) * h.defect);
    return h;
}

K_FN beckmann_base beckmann_base_of(v3 wi, real alpha_x, real alpha_y, facet_options options) {
    bool usable = facet_inputs_usable(wi, alpha_x, alpha_y, options.plane);
    beckmann_base g;
    g.wi = v3_select(usable, wi, v3_of(R(0.0), R(0.0), R(1.0)));
    g.ax = beckmann_alpha_floor(k_select(usable, alpha_x, R(1.0)));
    g.ay = beckmann_alpha_floor(k_select(usable, alpha_y, R(1.0)));
    v3 stretched = v3_of(g.ax * g.wi.x, g.ay * g.wi.y, g.wi.z);
    g.t_i = k_sqrt(v3_dot(stretched, stretched));
    g.i_std = v3_scale(stretched, R(1.0) / g.t_i);
    g.rho2 = g.i_std.x * g.i_std.x + g.i_std.y * g.i_std.y;
    beckmann_hidden h = beckmann_hidden_of(g.wi, g.ax, g.ay);
    bool below = g.wi.z < R(0.0);
    real above = R(2.0) * (k_abs(g.wi.z) + h.x);
    g.b = h.b;
    g.c = k_select(below, -h.c, h.c);
    g.shift = k_select(below, h.c * h.c, R(0.0));
    g.visible = k_select(below, K_INV_SQRT_PI * h.b * h.defect, above);
    g.density_bias = k_select(k_and(k_is(options.previous), below), R(2.0) * h.x / above, R(1.0));
    g.plane = options.plane;
    g.tilted = k_flag(facet_is_tilted(options.plane));
    g.floor_share = k_saturate(options.floor_share);
    g.separable = options.separable;
    /* straight from below nothing is visible */
    g.valid = k_flag(k_and(usable, g.visible > R(1e6) * K_TINY));
    g.visible = k_select(k_is(g.valid), g.visible, R(1.0));
    g.mirror =
        k_flag(k_and(usable, k_and(alpha_x < BECKMANN_ALPHA_MIN, alpha_y < BECKMANN_ALPHA_MIN)));
    return g;
}

/* D of a unit m without its exponential: exp(-exponent) sec^4/(pi ax ay). */
K_FN real beckmann_d_of(real exponent, v3 m, real ax, real ay) {
    real inv_z2 = R(1.0) / k_max(m.z * m.z, K_TINY);
    real inv_cos2 = v3_dot(m, m) * inv_z2;
    real d = k_exp(-exponent) * inv_cos2 * inv_cos2 / (K_PI * ax * ay);
    return k_select(m.z > R(0.0), d, R(0.0));
}

/* D(m), and its exponent: the squared length of the slope in the stretched space. */
K_FN real beckmann_exponent(v3 m, real ax, real ay) {
    real x = m.x / ax;
    real y = m.y / ay;
    return (x * x + y * y) / k_max(m.z * m.z, K_TINY);
}

K_FN real beckmann_d(v3 m, real ax, real ay) {
    return beckmann_d_of(beckmann_exponent(m, ax, ay), m, ax, ay);
}

/* The exponent x^2 + y^2 - shift of the slope x along i at depth t and y across, t = c - x for i_z < 0 and
 * -x else: c^2 goes out without a difference. */
K_FN real beckmann_exponent_at(beckmann_base g, real t, real y) {
    return t * (t + R(2.0) * k_max(-g.c, R(0.0))) + y * y;
}

/* D exp(shift) of a normal that faces i; from below t = i.m/(b m_z). */
K_FN real beckmann_d_shifted(beckmann_base g, v3 m, real cos_im) {
    real inv_z = R(1.0) / k_max(m.z, k_sqrt(K_TINY));
    real y = (g.wi.x * g.ax * (m.y / g.ay) - g.wi.y * g.ay * (m.x / g.ax)) * inv_z / g.b;
    real behind = beckmann_exponent_at(g, k_max(cos_im, R(0.0)) * inv_z / g.b, y);
    real exponent = k_select(g.wi.z < R(0.0), behind, beckmann_exponent(m, g.ax, g.ay));
    return beckmann_d_of(exponent, m, g.ax, g.ay);
}

/* Lambda of a direction above the surface */
K_FN real beckmann_lambda(v3 v, real ax, real ay) {
    return beckmann_hidden_of(v, ax, ay).x / k_max(v.z, K_TINY);
}

/* G1 of o; 0 from below */
K_FN real beckmann_g1_out(v3 wo, real ax, real ay) {
    real x = beckmann_hidden_of(wo, ax, ay).x;
    return k_select(wo.z > R(0.0), wo.z / (wo.z + x), R(0.0));
}

/* G1 of i, normalised for either side: 2|i_z|/V(i). Above 1 for i_z < 0: it is a normaliser there. */
K_FN real beckmann_g1_in(beckmann_base g) {
    return k_min(R(2.0) * k_abs(g.wi.z) / g.visible * k_exp(g.shift), K_HUGE);
}

/* G2(i,o)/G1(i) for o above the surface */
K_FN real beckmann_shadowing(beckmann_base g, v3 wo) {
    real x_o = beckmann_hidden_of(wo, g.ax, g.ay).x;
    real separable = wo.z / (wo.z + x_o);
    /* from behind height correlation has no meaning: its limit i_z -> 0 is 1 */
    real seen = R(0.5) * g.visible * wo.z;
    real correlated = k_select(g.wi.z > R(0.0), seen / (seen + g.wi.z * x_o), R(1.0));
    return k_select(k_is(g.separable), separable, correlated);
}

/* f cos of a pair that leaves the surface; 0 of any other */
K_FN real beckmann_f_cos(beckmann_base g, facet_pair pair) {
    real value = pair.d * beckmann_shadowing(g, pair.wo) / (R(2.0) * g.visible);
    return k_select(k_and(k_is(g.valid), pair.leaves), k_usable(value), R(0.0));
}

/* The pair of a given o; i.m is half the length of i + o, which keeps its digits where i.o is near -1.
 * Straight back (o = -i) has no half vector: it does not leave. */
K_FN facet_pair beckmann_pair_of_wo(beckmann_base g, v3 wo) {
    v3 h = v3_add(g.wi, wo);
    real h2 = v3_dot(h, h);
    real inv = R(1.0) / k_sqrt(k_max(h2, K_TINY));
    real side = k_sign(h.z);
    facet_pair pair;
    pair.wo = wo;
    pair.m = v3_scale(h, inv * side);
    pair.cos_im = R(0.5) * h2 * inv * side;
    pair.d = beckmann_d_shifted(g, pair.m, pair.cos_im);
    pair.leaves = k_and(facet_leaves(wo, g.plane),
                        k_and(h.z > R(0.0), k_and(h2 > K_TINY, pair.cos_im > R(0.0))));
    return pair;
}

/* A pair of a given m, i.m and D exp(shift): o is i reflected about m, wherever that lies. */
K_FN facet_pair beckmann_pair_about(beckmann_base g, v3 m, real cos_im, real d) {
    facet_pair pair;
    pair.m = m;
    pair.cos_im = cos_im;
    pair.wo = v3_sub(v3_scale(m, R(2.0) * cos_im), g.wi);
    pair.d = d;
    pair.leaves = k_and(facet_leaves(pair.wo, g.plane), k_and(m.z > R(0.0), cos_im > R(0.0)));
    return pair;
}

K_FN facet_pair beckmann_pair_of_m(beckmann_base g, v3 m) {
    real cos_im = v3_dot(g.wi, m);
    return beckmann_pair_about(g, m, cos_im, beckmann_d_shifted(g, m, cos_im));
}

/* A slope of unit roughness (x, y) in the frame of the shading point; m is along (-ax x, -ay y, 1). */
K_FN v3 beckmann_normal_of_slopes(beckmann_base g, real x, real y) {
    return v3_normalize(v3_of(-g.ax * x, -g.ay * y, R(1.0)));
}

K_FN facet_eval beckmann_eval(beckmann_base g, facet_pair pair) {
    facet_eval e;
    e.d = k_usable(beckmann_d(pair.m, g.ax, g.ay));
    e.g1_i = beckmann_g1_in(g);
    e.g1_o = k_usable(beckmann_g1_out(pair.wo, g.ax, g.ay));
    e.g2 = k_select(pair.leaves, k_usable(e.g1_i * beckmann_shadowing(g, pair.wo)), R(0.0));
    e.f_cos = beckmann_f_cos(g, pair);
    return e;
}

/* Of the visible normals' density: 1 but for the previous normalisation. */
K_FN real beckmann_vndf_integral(beckmann_base g) {
    return g.density_bias;
}

/* A draw from its pair and the two densities of the method there. */
K_FN facet_draw beckmann_draw_of(beckmann_base g, facet_pair pair, real pdf_m, real pdf) {
    facet_draw draw;
    bool valid = k_and(k_is(g.valid), k_and(pair.leaves, k_usable(pdf) > R(0.0)));
    draw.m = pair.m;
    draw.wo = pair.wo;
    draw.cos_im = pair.cos_im;
    draw.pdf_m = k_select(k_is(g.valid), k_usable(pdf_m), R(0.0));
    draw.pdf = k_select(valid, pdf, R(0.0));
    draw.weight = k_select(valid, k_usable(beckmann_f_cos(g, pair) / pdf), R(0.0));
    return draw;
}

#endif
