/* kernel/beckmann_newton.h: visible normals by inverting the distribution of the slope along i (Jakob
 * 2014), made exact: kernel/beckmann_slopes.h. The map is continuous in u and in i, normal incidence
 * included: both random numbers first become a Gaussian slope in the frame of the shading point,
 * which is turned to the azimuth of i (a Gaussian has no azimuth), and only then is its part along
 * i moved to where the visible slopes have the same share below them. Seen from above that
 * moves nothing, whatever the azimuth. */
#ifndef K_BECKMANN_NEWTON_H
#define K_BECKMANN_NEWTON_H

#include "beckmann_visible.h"

K_STRUCT(beckmann_newton) {
    beckmann_base g;
    facet_azimuth azimuth;
    beckmann_slopes slopes;
};

K_FN beckmann_newton beckmann_newton_prepare(beckmann_base g) {
    beckmann_newton s;
    s.g = g;
    s.azimuth = facet_azimuth_of(g.i_std);
    s.slopes = beckmann_slopes_of(g.c);
    return s;
}

K_FN real beckmann_newton_pdf(beckmann_newton s, facet_pair pair) {
    return beckmann_visible_pdf(s.g, pair);
}

K_FN real beckmann_newton_pdf_m(beckmann_newton s, facet_pair pair) {
    return beckmann_visible_pdf_m(s.g, pair);
}

K_FN real beckmann_newton_acceptance(beckmann_newton s) {
    return beckmann_visible_acceptance(s.g);
}

K_FN facet_draw beckmann_newton_draw(beckmann_newton s, real u1, real u2, real u3) {
    real x = beckmann_gaussian(u1);
    real y = beckmann_gaussian(u2);
    real along = s.azimuth.x * x + s.azimuth.y * y;
    real across = s.azimuth.x * y - s.azimuth.y * x;
    real tail = R(0.5) * k_erfc_abs(along);
    real rest = R(1.0) - tail;
    bool deep = along < R(0.0);
    real t =
        beckmann_slopes_inverse(s.slopes, k_select(deep, tail, rest), k_select(deep, rest, tail));
    return beckmann_visible_draw(s.g, beckmann_pair_of_depth(s.g, s.azimuth, t, across));
}

/* Worst errors of a draw in float, 3 10^5 random inputs (tools/numerics/beckmann_error.c: roughness 0.01 to 2,
 * either side, c above -10).
 * wo:  7.4e-07 at wi (-0x1.2f671cp-2, 0x1.bb727ep-3, 0x1.dc471p-1),
 *      alpha (0x1.226eecp-4, 0x1.f85cd4p+0) u (0x1.2ac91p-1, 0x1.34ffep-1)
 * pdf: 4.2e-05 relative at wi (0x1.3d0d7ep-1, -0x1.1e8ad2p-6, -0x1.91ec1p-1),
 *      alpha (0x1.052c04p-3, 0x1.052c04p-3) u (0x1.969d84p-1, 0x1.c16914p-2): the rounding of m, c^2 times */

#endif
