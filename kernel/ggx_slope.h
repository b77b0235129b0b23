/* kernel/ggx_slope.h: visible normals in slope space (Heitz & d'Eon 2014, section 4), exactly.
 *
 * In the stretched frame turned to the azimuth of i (i = (sin t, 0, cos t)), the slope along i has
 * the distribution (cos t + sin(t + xi))/(1 + cos t) of its angle xi = atan(x), so
 *     t + xi = asin a,  a = u1 (1 + cos t) - cos t:
 * no sign choice, no tangent of t, no pole; the paper's two roots and their NaNs are not needed.
 * The other slope is z sqrt(1 + x^2) with z = cot(e/2), e - sin e = 2 pi (1 - u2) on the upper half:
 * the exact inverse of the paper's C_z (kernel/kepler.h).
 * The normal is (-sin xi sin(e/2), -+cos(e/2), cos xi sin(e/2)): finite for every u. */
#ifndef K_GGX_SLOPE_H
#define K_GGX_SLOPE_H

#include "ggx_visible.h"
#include "kepler.h"

K_STRUCT(ggx_slope) {
    ggx_base g;
    ggx_visible visible;
    facet_azimuth azimuth; /* rho = sin t */
};

K_FN ggx_slope ggx_slope_prepare(ggx_base g) {
    ggx_slope s;
    s.g = g;
    s.visible = ggx_visible_of(g, g.one_plus_z);
    s.azimuth = facet_azimuth_of(g.i_std);
    return s;
}

K_FN real ggx_slope_pdf(ggx_slope s, facet_pair pair) {
    return ggx_visible_pdf(s.visible, pair);
}

K_FN real ggx_slope_pdf_m(ggx_slope s, facet_pair pair) {
    return ggx_visible_pdf_m(s.visible, pair);
}

K_FN real ggx_slope_acceptance(ggx_slope s) {
    return ggx_visible_acceptance(s.g, s.visible);
}

/* The angle xi of the slope along i, as sine and cosine. */
K_STRUCT(ggx_slope_along) {
    real s;
    real c;
};

K_FN ggx_slope_along ggx_slope_along_of(ggx_slope s, real u1) {
    real one_minus_a = (R(1.0) - u1) * s.g.one_plus_z;
    real one_plus_a = u1 * s.g.one_plus_z + s.g.one_minus_z;
    real a = u1 * s.g.one_plus_z - s.g.i_std.z;
    real cos_sum = k_sqrt(one_minus_a * one_plus_a);
    ggx_slope_along x;
    x.s = a * s.g.i_std.z - cos_sum * s.azimuth.rho;
    x.c = k_max(cos_sum * s.g.i_std.z + a * s.azimuth.rho, R(0.0));
    return x;
}

/* The draw from both slopes: along i by xi, across as the angle e/2 and a sign. */
K_FN facet_draw ggx_slope_draw_of(ggx_slope s, ggx_slope_along x, k_sincos half_e, real side) {
    real along = -x.s * half_e.s;
    real across = -side * half_e.c;
    v3 h = v3_of(s.azimuth.x * along - s.azimuth.y * across,
                 s.azimuth.y * along + s.azimuth.x * across, x.c * half_e.s);
    return ggx_visible_draw(s.g, s.visible, ggx_pair_of_stretched(s.g, h));
}

K_FN facet_draw ggx_slope_draw(ggx_slope s, real u1, real u2, real u3) {
    bool upper = u2 > R(0.5);
    real tail = k_select(upper, R(1.0) - u2, u2);
    real e = k_kepler(R(2.0) * K_PI * tail);
    k_sincos half_e = k_sincos_2pi(e * (R(0.25) * K_INV_PI));
    return ggx_slope_draw_of(s, ggx_slope_along_of(s, u1), half_e,
                             k_select(upper, R(1.0), R(-1.0)));
}

/* Worst errors of a draw in float, 2 10^7 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side).
 * wo:  1.7e-05 at wi (0x1.cf934ap-1, -0x1.602c9p-8, -0x1.b2ab5p-2),
 *      alpha (0x1.5f2e28p-6, 0x1.8de8c8p+0) u (0x1.d5aa8p-6, 0x1.031c0ep-2)
 * pdf: 1.1e-06 relative at wi (0x1.c32092p-3, -0x1.55d8aap-1, -0x1.6c186p-1),
 *      alpha (0x1.5cc8e6p+0, 0x1.5de66cp-3) u (0x1.7884f2p-1, 0x1.f01428p-1) */

#endif
