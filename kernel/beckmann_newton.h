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
    k_pair twice = k_erfc_abs_pair(along);
    beckmann_target target;
    target.deep = k_flag(along < R(0.0));
    target.tail.high = R(0.5) * twice.high;
    target.tail.low = R(0.5) * twice.low;
    target.w = -along;
    real t = beckmann_slopes_at(s.slopes, target);
    return beckmann_visible_draw(s.g, beckmann_pair_of_depth(s.g, s.azimuth, t, across));
}

/* Worst errors of a draw in float, 3 10^5 random inputs (tools/numerics/beckmann_error.c: roughness 0.01 to 2,
 * either side, c above -10).
 * wo:  7.7e-07 at wi (-0x1.108ed8p-4, -0x1.5375ep-2, 0x1.e1d866p-1),
 *      alpha (0x1.b453dcp-3, 0x1.c352fp-7) u (0x1.4p-15, 0x1.a551a4p-2)
 * pdf: 5.7e-05 relative at wi (-0x1.d8e356p-4, 0x1.f2d36ap-1, -0x1.8c703p-3),
 *      alpha (0x1.27d5fcp-4, 0x1.25e2b6p-6) u (0x1.43565cp-1, 0x1.df95c8p-2): the rounding of m, c^2 times */

#endif
