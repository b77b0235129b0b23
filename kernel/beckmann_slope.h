/* kernel/beckmann_slope.h: visible normals in slope space by exact pieces (Heitz & d'Eon 2014, section
 * 3): slopes below -c are Rayleigh or Gaussian tails, those between -c and c a Gaussian, mirrored where the
 * projected area says so. A number that has chosen a branch is used again (their section 2): u1 is cut
 * in three, u2 in two, so the map is not continuous. Without their special case for normal incidence: written with
 * erfc, no branch needs it. Below the horizon the pieces do not exist and the slope is found as by
 * kernel/beckmann_newton.h. */
#ifndef K_BECKMANN_SLOPE_H
#define K_BECKMANN_SLOPE_H

#include "beckmann_visible.h"

K_STRUCT(beckmann_slope) {
    beckmann_base g;
    facet_azimuth azimuth;
    beckmann_slopes slopes;
    real tails;    /* C: share of the slopes below -c */
    real rayleigh; /* of these, the share of the Rayleigh tail */
    real erfc_c;
};

K_FN beckmann_slope beckmann_slope_prepare(beckmann_base g) {
    beckmann_slope s;
    s.g = g;
    s.azimuth = facet_azimuth_of(g.i_std);
    s.slopes = beckmann_slopes_of(g.c);
    real c = s.slopes.c_plus;
    real rest = R(1.0) + K_SQRT_PI * c * k_erfcx_positive(c);
    s.tails = k_min(k_exp_minus_square(c) * rest / s.slopes.k.high, R(1.0));
    s.rayleigh = R(1.0) / rest;
    s.erfc_c = k_erfc_abs(c);
    return s;
}

K_FN real beckmann_slope_pdf(beckmann_slope s, facet_pair pair) {
    return beckmann_visible_pdf(s.g, pair);
}

K_FN real beckmann_slope_pdf_m(beckmann_slope s, facet_pair pair) {
    return beckmann_visible_pdf_m(s.g, pair);
}

K_FN real beckmann_slope_acceptance(beckmann_slope s) {
    return beckmann_visible_acceptance(s.g);
}

/* A slope below -c; u in [0, 1) */
K_FN real beckmann_slope_tail(beckmann_slope s, real u) {
    real c = s.slopes.c_plus;
    bool rayleigh = u < s.rayleigh;
    real again =
        k_select(rayleigh, u / s.rayleigh, (u - s.rayleigh) / k_max(R(1.0) - s.rayleigh, K_TINY));
    real far = k_sqrt(c * c + k_max(-k_log(again), R(0.0)));
    return -k_select(rayleigh, far, k_erfcinv(again * s.erfc_c));
}

/* The slope along i, and what is left of u2. */
K_STRUCT(beckmann_slope_along) {
    real x;
    real u2;
};

K_FN beckmann_slope_along beckmann_slope_along_of(beckmann_slope s, real u1, real u2) {
    real c = s.slopes.c_plus;
    bool in_tail = u1 < s.tails;
    real tail = beckmann_slope_tail(s, u1 / k_max(s.tails, K_TINY));
    real again = (u1 - s.tails) / k_max(R(1.0) - s.tails, K_TINY);
    real middle = k_erfinv((R(2.0) * k_saturate(again) - R(1.0)) * (R(1.0) - s.erfc_c));
    real stays = k_saturate(R(0.5) * (c - middle) / k_max(c, K_TINY));
    bool mirrored = u2 > stays;
    real left =
        k_select(mirrored, (u2 - stays) / k_max(R(1.0) - stays, K_TINY), u2 / k_max(stays, K_TINY));
    beckmann_slope_along a;
    a.x = k_select(in_tail, tail, k_select(mirrored, -middle, middle));
    a.u2 = k_select(in_tail, u2, k_min(left, K_BELOW_ONE));
    return a;
}

K_FN facet_draw beckmann_slope_draw(beckmann_slope s, real u1, real u2, real u3) {
    bool below = s.slopes.s > R(0.0);
    beckmann_slope_along a = beckmann_slope_along_of(s, u1, u2);
    real t = k_select(below, beckmann_slopes_inverse(s.slopes, u1), -a.x);
    real y = beckmann_gaussian(k_select(below, u2, a.u2));
    return beckmann_visible_draw(s.g, beckmann_pair_of_depth(s.g, s.azimuth, t, y));
}

/* Worst errors of a draw in float, 3 10^5 random inputs (tools/numerics/beckmann_error.c: roughness 0.01 to 2,
 * either side, c above -10).
 * wo:  2.6e-04 at wi (-0x1.a56042p-2, -0x1.74aa96p-1, 0x1.18d886p-1), where u1 is used a second time,
 *      alpha (0x1.689cdap-2, 0x1.293284p-4) u (0x1.a0158cp-2, 0x1.0c1074p-1)
 * pdf: 5.9e-05 relative at wi (0x1.237aacp-1, 0x1.483562p-7, -0x1.a4e6a4p-1),
 *      alpha (0x1.28c4ccp-3, 0x1.28c4ccp-3) u (0x1.3d03a8p-3, 0x1.d3d6a2p-1) */

#endif
