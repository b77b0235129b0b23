/* kernel/facet.h: what every microfacet reflection model shares: the pair of directions about a
 * microfacet normal, the draw, and the choices of a shading point.
 *
 * A model is a family (a distribution and a masking: `ggx`, ...) of five functions,
 *     FAMILY_base  FAMILY_base_of(v3 wi, real alpha_x, real alpha_y, facet_options options)
 *     facet_pair   FAMILY_pair_of_wo(FAMILY_base g, v3 wo),  FAMILY_pair_of_m(FAMILY_base g, v3 m)
 *     facet_eval   FAMILY_eval(FAMILY_base g, facet_pair pair)
 * and of samplers over it (docs/adding-a-sampler.md). */
#ifndef K_FACET_H
#define K_FACET_H

#include "vec.h"

/* Choices that hold for all draws and densities at a shading point. */
K_STRUCT(facet_options) {
    v3 plane; /* geometric normal, unit, in the shading frame; z: none but the shading plane */
    real floor_share; /* in [0, 1]: how much of the density ignores shadowing (horizon sampling) */
    bool separable;   /* G2 = G1 G1; else height-correlated */
    bool previous;    /* the biased normalisation before Tokuyoshi 2021, for comparison */
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
    o.separable = separable;
    o.previous = previous;
    return o;
}

K_FN bool facet_is_tilted(v3 plane) {
    return plane.x != R(0.0) || plane.y != R(0.0) || plane.z < R(0.0);
}

/* Roughness from 0 on, i and the plane of length 1, i on the front of a tilted plane. */
K_FN bool facet_inputs_usable(v3 wi, real ax, real ay, v3 plane) {
    real wi2 = v3_dot(wi, wi);
    real plane2 = v3_dot(plane, plane);
    bool faces = !facet_is_tilted(plane) || v3_dot(wi, plane) > R(0.0);
    return ax >= R(0.0) && ay >= R(0.0) && k_is_finite(ax) && k_is_finite(ay) && wi2 > R(0.98) &&
           wi2 < R(1.02) && plane2 > R(0.98) && plane2 < R(1.02) && faces;
}

K_FN bool facet_leaves(v3 wo, v3 plane) {
    return wo.z > R(0.0) && v3_dot(wo, plane) > R(0.0);
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
