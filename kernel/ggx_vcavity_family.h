/* kernel/ggx_vcavity_family.h: V-cavities with the GGX distribution (Tokuyoshi 2021, section 2). */
#ifndef K_GGX_VCAVITY_FAMILY_H
#define K_GGX_VCAVITY_FAMILY_H

#include "ggx.h"
#include "vcavity.h"

/* A shading point: what every sampler and density needs of (i, alpha). */
K_STRUCT(ggx_vcavity_base) {
    v3 wi;
    real ax;
    real ay;
    v3 plane;
    ggx_base ggx;
    vcavity_base cavity;
    kint tilted;
    kint valid;
    kint mirror;
};

/* H(i). In the stretched space, a = |i_std.z|, R^2 = 1 + 8 a^2, the two rationalised differences of
 *     1 + (sqrt(rho^2 + 9 z^2) - sqrt(rho^2 + z^2))/(2 z)
 * leave a sum of positive terms: exact to rounding as i_z -> 0 and straight from below. */
K_FN real ggx_vcavity_hit(ggx_base g) {
    real a = k_abs(g.i_std.z);
    real root = k_sqrt(R(1.0) + R(8.0) * a * a);
    real behind = g.rho2 * (R(1.0) / (root + R(3.0) * a) + R(1.0) / (R(1.0) + a)) / (root + R(1.0));
    return k_select(g.wi.z < R(0.0), behind, R(1.0));
}

K_FN ggx_vcavity_base ggx_vcavity_base_of(v3 wi, real alpha_x, real alpha_y,
                                          facet_options options) {
    ggx_vcavity_base g;
    g.ggx = ggx_base_of(wi, alpha_x, alpha_y, options);
    g.wi = g.ggx.wi;
    g.ax = g.ggx.ax;
    g.ay = g.ggx.ay;
    g.plane = g.ggx.plane;
    real hit = ggx_vcavity_hit(g.ggx);
    /* straight from below nothing is visible */
    g.valid = k_flag(k_and(k_is(g.ggx.valid), hit > R(1e6) * K_TINY));
    g.mirror = g.ggx.mirror;
    g.tilted = g.ggx.tilted;
    g.cavity = vcavity_base_of(g.wi, k_select(k_is(g.valid), hit, R(1.0)), options);
    return g;
}

K_FN facet_pair ggx_vcavity_pair_of_wo(ggx_vcavity_base g, v3 wo) {
    return ggx_pair_of_wo(g.ggx, wo);
}

K_FN facet_pair ggx_vcavity_pair_of_m(ggx_vcavity_base g, v3 m) {
    return ggx_pair_of_m(g.ggx, m);
}

K_FN facet_eval ggx_vcavity_eval(ggx_vcavity_base g, facet_pair pair) {
    return vcavity_eval(g.cavity, k_is(g.valid), pair, pair.d);
}

/* Of the visible normals' density: 1 but for the previous normalisation. */
K_FN real ggx_vcavity_vndf_integral(ggx_vcavity_base g) {
    return g.cavity.density_bias;
}

/* Worst error of H in float, 5 10^6 random inputs (tools/numerics/vcavity_error.c): 4.9e-07 relative at
 * wi (0x1.516a72p-4, 0x1.28789ep-3, -0x1.f8d92p-1), alpha (0x1.17626ap-3, 0x1.e06e58p+0). */

#endif
