/* kernel/beckmann_vcavity_family.h: V-cavities with the Beckmann distribution (Tokuyoshi 2021, section 2).
 *
 * From below i sees no slope whose stretched part along i is less than a = -c(i) (kernel/beckmann.h): pairs
 * keep D exp(a^2), and H goes without its exp(-a^2) too: neither vanishes where the lobe is. */
#ifndef K_BECKMANN_VCAVITY_FAMILY_H
#define K_BECKMANN_VCAVITY_FAMILY_H

#include "beckmann.h"
#include "beckmann_vcavity_hit.h"
#include "vcavity.h"

/* A shading point: what every sampler and density needs of (i, alpha). */
K_STRUCT(beckmann_vcavity_base) {
    v3 wi;
    real ax;
    real ay;
    v3 plane;
    beckmann_base beckmann;
    vcavity_base cavity;
    real a;            /* from above 0 */
    real masked_share; /* the share of facets that are partly masked; from above 1 */
    kint tilted;
    kint valid;
    kint mirror;
};

K_FN beckmann_vcavity_base beckmann_vcavity_base_of(v3 wi, real alpha_x, real alpha_y,
                                                    facet_options options) {
    beckmann_vcavity_base g;
    g.beckmann = beckmann_base_of(wi, alpha_x, alpha_y, options);
    g.wi = g.beckmann.wi;
    g.ax = g.beckmann.ax;
    g.ay = g.beckmann.ay;
    g.plane = g.beckmann.plane;
    g.tilted = g.beckmann.tilted;
    g.mirror = g.beckmann.mirror;
    g.a = k_max(-g.beckmann.c, R(0.0));
    beckmann_vcavity_hit hit = beckmann_vcavity_hit_of(g.a);
    /* straight from below nothing is visible */
    g.valid = k_flag(k_and(k_is(g.beckmann.valid), hit.scaled > R(1e6) * K_TINY));
    real scaled = k_select(k_is(g.valid), hit.scaled, R(1.0));
    g.masked_share = hit.masked_share;
    g.cavity = vcavity_base_of(g.wi, k_exp_minus_square(g.a) * scaled, options);
    g.cavity.value_scale = R(0.25) / scaled;
    return g;
}

/* The pairs are Smith's, D exp(a^2) too. */
K_FN facet_pair beckmann_vcavity_pair_of_wo(beckmann_vcavity_base g, v3 wo) {
    return beckmann_pair_of_wo(g.beckmann, wo);
}

K_FN facet_pair beckmann_vcavity_pair_of_m(beckmann_vcavity_base g, v3 m) {
    return beckmann_pair_of_m(g.beckmann, m);
}

K_FN facet_eval beckmann_vcavity_eval(beckmann_vcavity_base g, facet_pair pair) {
    return vcavity_eval(g.cavity, k_is(g.valid), pair, beckmann_d(pair.m, g.ax, g.ay));
}

/* Of the visible normals' density: 1 but for the previous normalisation. */
K_FN real beckmann_vcavity_vndf_integral(beckmann_vcavity_base g) {
    return g.cavity.density_bias;
}

/* Worst error of H in float, 5 10^6 random inputs with H above 1e-8 (tools/numerics/vcavity_error.c): 4.8e-06
 * relative, the rounding of a in exp(-a^2), at wi (0x1.9ba406p-1, -0x1.8321f2p-2, -0x1.d60348p-2), alpha
 * (0x1.5461dep-3, 0x1.02fabep-6). */

#endif
