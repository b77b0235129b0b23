/* kernel/facet.h: what every microfacet reflection model shares: the pair of directions about a
 * microfacet normal, the draw, and the choices of a shading point.
 *
 * A model is a family (a distribution and a masking: `ggx`, ...) of five functions,
 *     FAMILY_base  FAMILY_base_of(v3 wi, real alpha_x, real alpha_y, facet_options options)
 *     facet_pair   FAMILY_pair_of_wo(FAMILY_base g, v3 wo),  FAMILY_pair_of_m(FAMILY_base g, v3 m)
 *     facet_eval   FAMILY_eval(FAMILY_base g, facet_pair pair)
 *     real         FAMILY_vndf_integral(FAMILY_base g)
 * and of samplers over it (docs/adding-a-sampler.md). */
#ifndef K_FACET_H
#define K_FACET_H

#include "vec.h"

/* The cosine of the tilt of the geometric plane from which on a model for two planes is worth its price: a table of
 * nodes, and an ellipse. */
#define FACET_TABLE_TILT_COSINE R(0.95)
#define FACET_ELLIPSE_TILT_COSINE R(0.985)

/* Choices that hold for all draws and densities at a shading point. */
K_STRUCT(facet_options) {
    v3 plane; /* geometric normal, unit, in the shading frame; z: none but the shading plane */
    real floor_share; /* in [0, 1]: how much of the density ignores shadowing (horizon sampling) */
    kint separable;   /* G2 = G1 G1; else height-correlated */
    kint previous;    /* the biased normalisation before Tokuyoshi 2021, for comparison */
};

/* A pair of directions seen from the microsurface. */
K_STRUCT(facet_pair) {
    v3 m;
    v3 wo;
    real cos_im;
    real d;
    bool leaves; /* m faces i, and o is above the surface and above the geometric plane */
};

/* What a draw gives. */
K_STRUCT(facet_draw) {
    v3 m;
    v3 wo;
    real cos_im;
    real pdf_m;
    real pdf;
    real weight;
};

/* What there is to know of a pair besides the densities of a sampler. */
K_STRUCT(facet_eval) {
    real d;
    real g1_i;
    real g1_o;
    real g2;    /* 0 where the pair does not leave, like f_cos */
    real f_cos; /* f |o_z| without Fresnel */
};

/* No plane but the shading plane; a quarter of a density may ignore shadowing. */
K_FN facet_options facet_options_of(bool separable, bool previous) {
    facet_options o;
    o.plane = v3_of(R(0.0), R(0.0), R(1.0));
    o.floor_share = R(0.25);
    o.separable = k_flag(separable);
    o.previous = k_flag(previous);
    return o;
}

K_FN bool facet_is_tilted(v3 plane) {
    return k_or(plane.x != R(0.0), k_or(plane.y != R(0.0), plane.z < R(0.0)));
}

/* Roughness from 0 on, i and the plane of length 1, i on the front of a tilted plane. */
K_FN bool facet_inputs_usable(v3 wi, real ax, real ay, v3 plane) {
    real wi2 = v3_dot(wi, wi);
    real plane2 = v3_dot(plane, plane);
    bool faces = k_or(!facet_is_tilted(plane), v3_dot(wi, plane) > R(0.0));
    return k_and(
        ax >= R(0.0),
        k_and(ay >= R(0.0),
              k_and(k_is_finite(ax),
                    k_and(k_is_finite(ay),
                          k_and(wi2 > R(0.98),
                                k_and(wi2 < R(1.02),
                                      k_and(plane2 > R(0.98), k_and(plane2 < R(1.02), faces))))))));
}

K_FN bool facet_leaves(v3 wo, v3 plane) {
    return k_and(wo.z > R(0.0), k_or(!facet_is_tilted(plane), v3_dot(wo, plane) > R(0.0)));
}

/* The draw of a mirror: all of the light goes one way. */
K_FN facet_draw facet_mirror_draw(v3 wi, v3 plane) {
    facet_draw d;
    d.m = v3_of(R(0.0), R(0.0), R(1.0));
    d.wo = v3_of(-wi.x, -wi.y, wi.z);
    d.cos_im = wi.z;
    d.pdf = k_select(facet_leaves(d.wo, plane), R(1.0), R(0.0));
    d.pdf_m = d.pdf;
    d.weight = d.pdf;
    return d;
}

K_FN facet_draw facet_select(bool condition, facet_draw yes, facet_draw no) {
    facet_draw d;
    d.m = v3_select(condition, yes.m, no.m);
    d.wo = v3_select(condition, yes.wo, no.wo);
    d.cos_im = k_select(condition, yes.cos_im, no.cos_im);
    d.pdf_m = k_select(condition, yes.pdf_m, no.pdf_m);
    d.pdf = k_select(condition, yes.pdf, no.pdf);
    d.weight = k_select(condition, yes.weight, no.weight);
    return d;
}

/* What a model gives: the draw of its sampler, or the mirror's, or nothing. */
K_FN facet_draw facet_draw_of(facet_draw drawn, v3 wi, v3 plane, bool valid, bool mirror) {
    v3 none = v3_of(R(0.0), R(0.0), R(0.0));
    facet_draw d = facet_select(mirror, facet_mirror_draw(wi, plane), drawn);
    d.m = v3_select(valid, d.m, none);
    d.wo = v3_select(valid, d.wo, none);
    d.cos_im = k_select(valid, d.cos_im, R(0.0));
    d.pdf_m = k_select(valid, d.pdf_m, R(0.0));
    d.pdf = k_select(valid, d.pdf, R(0.0));
    d.weight = k_select(valid, d.weight, R(0.0));
    return d;
}

/* The direction of a vector in the plane, and its length there; +x where it has none. */
K_STRUCT(facet_azimuth) {
    real x;
    real y;
    real rho;
};

K_FN facet_azimuth facet_azimuth_of(v3 v) {
    real rho2 = v.x * v.x + v.y * v.y;
    bool off_normal = rho2 > K_TINY;
    facet_azimuth a;
    a.rho = k_select(off_normal, k_sqrt(k_max(rho2, K_TINY)), R(0.0));
    real inv_rho = R(1.0) / k_max(a.rho, K_TINY);
    a.x = k_select(off_normal, v.x * inv_rho, R(1.0));
    a.y = k_select(off_normal, v.y * inv_rho, R(0.0));
    return a;
}

#endif
