/* kernel/beckmann_newton_published.h: the slope along i by three Newton steps without a bracket, as
 * Tokuyoshi 2021 (listing 6) and Mitsuba 2 print it, for comparison. The unknown is the error function of
 * the slope. The steps do not converge where the tangent of theta is large and negative: from about theta =
 * 95 degrees on chi^2 tests reject it. The density is that of the distribution that it means to draw from. */
#ifndef K_BECKMANN_NEWTON_PUBLISHED_H
#define K_BECKMANN_NEWTON_PUBLISHED_H

#include "beckmann_visible.h"

K_STRUCT(beckmann_newton_published) {
    beckmann_base g;
    facet_azimuth azimuth;
};

K_FN beckmann_newton_published beckmann_newton_published_prepare(beckmann_base g) {
    beckmann_newton_published s;
    s.g = g;
    s.azimuth = facet_azimuth_of(g.i_std);
    return s;
}

K_FN real beckmann_newton_published_pdf(beckmann_newton_published s, facet_pair pair) {
    return beckmann_visible_pdf(s.g, pair);
}

K_FN real beckmann_newton_published_pdf_m(beckmann_newton_published s, facet_pair pair) {
    return beckmann_visible_pdf_m(s.g, pair);
}

K_FN real beckmann_newton_published_acceptance(beckmann_newton_published s) {
    return beckmann_visible_acceptance(s.g);
}

K_FN facet_draw beckmann_newton_published_draw(beckmann_newton_published s, real u1, real u2,
                                               real u3) {
    real u = k_min(k_max(u1, R(1e-6)), R(0.999999));
    real cot = s.g.c;
    real tan_over_root_pi = K_INV_SQRT_PI / k_select(k_abs(cot) > K_TINY, cot, K_TINY);
    real most = k_erf(cot);
    real x = most - (R(1.0) + most) * k_erf(k_sqrt(-k_log(u)));
    real whole = R(1.0) + most + tan_over_root_pi * k_exp_minus_square(cot);
    for (int step = 0; step < 3; ++step) {
        real z = k_erfinv(x);
        real value = R(1.0) + x + tan_over_root_pi * k_exp_minus_square(z) - u * whole;
        x = x - value / (R(1.0) - z * tan_over_root_pi * K_SQRT_PI);
        x = k_min(k_max(x, -K_BELOW_ONE), K_BELOW_ONE); /* the domain of the error function */
    }
    real along = k_erfinv(x);
    real t = -along - k_max(-cot, R(0.0));
    return beckmann_visible_draw(s.g,
                                 beckmann_pair_of_depth(s.g, s.azimuth, t, beckmann_gaussian(u2)));
}

#endif
