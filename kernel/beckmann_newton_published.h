/* kernel/beckmann_newton_published.h: the slope along i by three Newton steps without a bracket, as
 * Tokuyoshi 2021 (listing 6) and Mitsuba 2 print it, for comparison. The unknown is the error function of
 * the slope; a lower limit serves V-cavities seen from below. The density is that of the
 * distribution that it means to draw from. Over all visible slopes three steps are nearly enough (the share is
 * off by up to 3e-6); over [3c, c) the start does not know the limit, and chi^2 rejects it. */
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

/* The slope of the number u between `least` and c = cot(theta). */
K_FN real beckmann_published_slope(real c, real least, real u1) {
    real u = k_min(k_max(u1, R(1e-6)), R(0.999999));
    real tan_over_root_pi = K_INV_SQRT_PI / k_select(k_abs(c) > K_TINY, c, K_TINY);
    real x_min = k_erf(least);
    real x_max = k_erf(c);
    real at_min = x_min + tan_over_root_pi * k_exp_minus_square(least);
    real at_max = x_max + tan_over_root_pi * k_exp_minus_square(c);
    real target = u * (at_max - at_min) + at_min;
    real x = x_max - (R(1.0) + x_max) * k_erf(k_sqrt(-k_log(u)));
    K_UNROLL
    for (int step = 0; step < 3; ++step) {
        real z = k_erfinv(x);
        real value = x + tan_over_root_pi * k_exp_minus_square(z) - target;
        x = x - value / (R(1.0) - z * tan_over_root_pi * K_SQRT_PI);
        x = k_min(k_max(x, -K_BELOW_ONE),
                  K_BELOW_ONE); /* where the inverse error function is defined */
    }
    return k_erfinv(x);
}

K_FN facet_draw beckmann_newton_published_draw(beckmann_newton_published s, real u1, real u2,
                                               real u3) {
    real x = beckmann_published_slope(s.g.c, R(-30.0), u1);
    real t = -x - k_max(-s.g.c, R(0.0));
    facet_pair pair = beckmann_pair_of_depth(s.g, s.azimuth, t, beckmann_gaussian(u2));
    return beckmann_visible_draw(s.g, pair);
}

/* Worst errors of a draw in float, 3 10^5 random inputs (tools/numerics/beckmann_error.c: roughness 0.01 to 2,
 * either side, c above -10).
 * wo:  0.24 at wi (-0x1.0b9752p-1, 0x1.2846aap-1, -0x1.408fbp-1),
 *      alpha (0x1.b6b28cp-2, 0x1.5db3fcp-5) u (0x1.fcda42p-1, 0x1.007dd8p-1): erf(c) is -1 in float
 * pdf: 7.9e-06 relative at wi (-0x1.c14eacp-1, 0x1.d4e34p-2, -0x1.23498p-3),
 *      alpha (0x1.3cf85ep-5, 0x1.475e12p-5) u (0x1.3078ep-2, 0x1.b91364p-2) */

#endif
