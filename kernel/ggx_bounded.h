/* kernel/ggx_bounded.h: the cap about z cut to o_std.z >= -k i_std.z, which still holds every
 * reflection that leaves the surface (Eto & Tokuyoshi 2023, eq. 5; Tokuyoshi & Eto 2024). With
 * s = 1 + sin(theta_i) and i_z^2 = s (2 - s) their k is
 *     1 - k = 2 a^2 / (s + a^2 (2 - s)),   a = min(alpha_x, alpha_y, 1),
 * one division and no cancellation. For i_z <= 0 nothing can be cut: k = 1. */
#ifndef K_GGX_BOUNDED_H
#define K_GGX_BOUNDED_H

#include "ggx_cap.h"

K_STRUCT(ggx_bounded) {
    ggx_cap cap;
};

K_FN real ggx_bounded_one_minus_k(ggx_base g) {
    real a = k_min(k_min(g.ax, g.ay), R(1.0));
    real s = R(1.0) + k_min(k_sqrt(g.wi.x * g.wi.x + g.wi.y * g.wi.y), R(1.0));
    real one_minus_k = R(2.0) * a * a / (s + a * a * (R(2.0) - s));
    return k_select(g.wi.z > R(0.0), one_minus_k, R(0.0));
}

K_FN ggx_bounded ggx_bounded_prepare(ggx_base g) {
    ggx_bounded s;
    s.cap = ggx_cap_of(g, ggx_bounded_one_minus_k(g));
    return s;
}

K_FN real ggx_bounded_pdf(ggx_bounded s, facet_pair pair) {
    return ggx_cap_pdf(s.cap, pair);
}

K_FN real ggx_bounded_pdf_m(ggx_bounded s, facet_pair pair) {
    return ggx_cap_pdf_m(s.cap, pair);
}

K_FN real ggx_bounded_acceptance(ggx_bounded s) {
    return ggx_cap_acceptance(s.cap);
}

K_FN facet_draw ggx_bounded_draw(ggx_bounded s, real u1, real u2, real u3) {
    return ggx_cap_draw(s.cap, u1, u2);
}

/* Worst errors of a draw in float, 2 10^7 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side).
 * wo:  1.7e-05 at wi (0x1.f2dad6p-1, 0x1.2cbda4p-3, -0x1.5d83fp-3),
 *      alpha (0x1.fcb4bp+0, 0x1.19d588p-6) u (0x1.021ebcp-1, 0x1.f5634ep-1)
 * pdf: 1.2e-06 relative at wi (-0x1.511b14p-1, -0x1.61bc56p-1, -0x1.31c6b8p-2),
 *      alpha (0x1.185daep-5, 0x1.185daep-5) u (0x1.bbf3fep-1, 0x1.55ba56p-2) */

#endif
