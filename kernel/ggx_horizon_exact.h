/* kernel/ggx_horizon_exact.h: exactly uniform over the useful normals, like `horizon_mirror`, and a
 * continuous bijection. At the radius s = u2 the distribution function of the angle phi is closed: with
 * rho^2 = s, A = v + s g1, C = v + s g2, B = A - C, w^2 = C + B cos^2 phi,
 *     G(phi) = phi + (rho/sqrt(B)) (k1 atan(sqrt(B) sin(phi)/w) - k2 asinh(cos(phi) sqrt(B/C))),
 * and G(phi) = theta = 2 pi u1 is solved by steps that take the slope and the curvature of G, from the
 * direction that `horizon_uniform` would draw without its limit. The unknown is phi - theta. */
#ifndef K_GGX_HORIZON_EXACT_H
#define K_GGX_HORIZON_EXACT_H

#include "arc.h"
#include "ggx_horizon_point.h"

/* Largest |G - theta| after 4, 5 and 6 steps: 5e-12, below 1e-15 and below 1e-15 for all but one in 10^4 of
 * 6 10^5 draws (roughness 1e-3 to 3, a tenth of them 1e-4 to 1e4; any i, a third of them grazing); 3e-4,
 * 1e-5 and 5e-10 for all. */
#if K_IS_F64
#define GGX_HORIZON_EXACT_STEPS 5
#else
#define GGX_HORIZON_EXACT_STEPS 4
#endif

K_STRUCT(ggx_horizon_exact) {
    ggx_horizon_set set;
    ggx_horizon_frame f;
    real squeeze; /* (k1^2 g1 + k2^2 g2)/|k|^2 */
};

K_FN ggx_horizon_exact ggx_horizon_exact_prepare(ggx_base g) {
    ggx_horizon_exact s;
    ggx_useful u = ggx_useful_of(g);
    ggx_horizon_frame f = ggx_horizon_frame_of(u);
    s.f = f;
    s.set = ggx_horizon_set_of(g, f.lambda, f.a * f.b, u.i.z);
    real k1 = f.k1 * f.k1;
    real k2 = f.k2 * f.k2;
    s.squeeze = (k1 * f.g1 + k2 * f.g2) / k_max(k1 + k2, K_TINY);
    return s;
}

K_FN real ggx_horizon_exact_pdf(ggx_horizon_exact s, facet_pair pair) {
    return ggx_horizon_density(s.set, pair, R(1.0) / s.f.nu);
}

K_FN real ggx_horizon_exact_pdf_m(ggx_horizon_exact s, facet_pair pair) {
    return ggx_horizon_density_m(pair, ggx_horizon_exact_pdf(s, pair));
}

K_FN real ggx_horizon_exact_acceptance(ggx_horizon_exact s) {
    return ggx_horizon_set_acceptance(s.set);
}

/* One radius. */
K_STRUCT(ggx_horizon_circle) {
    real k1; /* rho k */
    real k2;
    real b; /* B, not quite 0, and its root */
    real root_b;
    real inv_root_b;
    real c; /* C and 1/sqrt(C) */
    real inv_root_c;
};

K_FN ggx_horizon_circle ggx_horizon_circle_of(ggx_horizon_frame f, real v, real rest) {
    real radius = k_sqrt(rest);
    ggx_horizon_circle at;
    at.k1 = radius * f.k1;
    at.k2 = radius * f.k2;
    at.b = k_max(rest * (f.g1 - f.g2), R(1e-9) * (v + rest * f.g1));
    at.root_b = k_sqrt(at.b);
    at.inv_root_b = R(1.0) / at.root_b;
    at.c = v + rest * f.g2;
    at.inv_root_c = R(1.0) / k_sqrt(at.c);
    return at;
}

K_FN ggx_horizon_angle ggx_horizon_ahead(ggx_horizon_angle e, real ahead) {
    k_sincos turn = k_sincos_2pi(ahead * (R(0.5) * K_INV_PI));
    ggx_horizon_angle to;
    to.c = e.c * turn.c - e.s * turn.s;
    to.s = e.s * turn.c + e.c * turn.s;
    return to;
}

/* G(phi) = theta by the parabola through value, slope and curvature at phi = theta + ahead */
K_FN real ggx_horizon_exact_step(ggx_horizon_circle at, ggx_horizon_angle theta, real ahead) {
    ggx_horizon_angle e = ggx_horizon_ahead(theta, ahead);
    real w2 = at.c + at.b * e.c * e.c;
    real w = k_sqrt(w2);
    real inv_w = R(1.0) / w;
    real leaning = at.k1 * e.c + at.k2 * e.s;
    real odd =
        at.k1 * k_angle(at.root_b * e.s, w) - at.k2 * k_asinh(e.c * at.root_b * at.inv_root_c);
    real f = ahead + at.inv_root_b * odd;
    real slope = k_max(R(1.0) + leaning * inv_w, R(1e-4));
    real bend = (at.k2 * e.c - at.k1 * e.s + leaning * at.b * e.s * e.c * inv_w * inv_w) * inv_w;
    real root = k_sqrt(k_max(slope * slope - R(2.0) * f * bend, R(0.0)));
    real step = R(2.0) * f / (slope + root);
    return ahead - k_min(k_max(step, R(-0.6)), R(0.6));
}

K_FN facet_draw ggx_horizon_exact_draw(ggx_horizon_exact s, real u1, real u2, real u3) {
    ggx_horizon_frame f = s.f;
    ggx_horizon_angle theta = ggx_horizon_turned(f, u1);
    real v = R(1.0) - u2;
    real reach = k_sqrt(u2 / (v + u2 * s.squeeze));
    real d1 = f.k1 * reach;
    real d2 = f.k2 * reach;
    real ahead =
        k_angle(theta.c * d2 - theta.s * d1, k_max(R(1.0) + theta.c * d1 + theta.s * d2, R(0.0)));
    ggx_horizon_circle at = ggx_horizon_circle_of(f, v, u2);
    K_UNROLL
    for (int step = 0; step < GGX_HORIZON_EXACT_STEPS; ++step)
        ahead = ggx_horizon_exact_step(at, theta, ahead);
    ggx_horizon_arrival to =
        ggx_horizon_arrive_in(s.set, f, v, u2, ggx_horizon_ahead(theta, ahead));
    return ggx_horizon_draw_of(s.set, to.pair, R(1.0) / f.nu);
}

/* Worst errors of a draw in float, 4 10^6 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side).
 * wo:  0.0003 at wi (0x1.e00ea4p-6, 0x1.725deep-1, -0x1.61322p-1),
 *      alpha (0x1.c3014ap-3, 0x1.db0e0cp-7) u (0x1.5fa188p-2, 0x1.eca4d2p-1)
 * pdf: 2.6e-06 relative at wi (-0x1.089108p-2, 0x1.378342p-2, 0x1.d573bp-1),
 *      alpha (0x1.44f63p+0, 0x1.ab860cp-6) u (0x1.bb4a7p-3, 0x1.e8b306p-1) */

#endif
