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

#endif
