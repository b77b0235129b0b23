/* kernel/ggx_slope_published.h: slope space as printed (Heitz & d'Eon 2014, listing 4.5), with the
 * rational fit of C_z^-1 and guards against its NaNs (docs/departures.md). The distribution function
 * of the fit is off by up to 1.1e-3, so a chi^2 test rejects it from 4 10^5 draws on: for
 * comparison, not for use. Its density is the one it aims at. */
#ifndef K_GGX_SLOPE_PUBLISHED_H
#define K_GGX_SLOPE_PUBLISHED_H

#include "ggx_slope.h"

K_STRUCT(ggx_slope_published) {
    ggx_slope slope;
    kint as_published; /* i above the surface, at an angle; elsewhere the exact slope */
};

K_FN ggx_slope_published ggx_slope_published_prepare(ggx_base g) {
    ggx_slope_published s;
    s.slope = ggx_slope_prepare(g);
    s.as_published = k_flag(k_and(s.slope.g.i_std.z > R(1e-4), s.slope.azimuth.rho > R(1e-4)));
    return s;
}

K_FN real ggx_slope_published_pdf(ggx_slope_published s, facet_pair pair) {
    return ggx_slope_pdf(s.slope, pair);
}

K_FN real ggx_slope_published_pdf_m(ggx_slope_published s, facet_pair pair) {
    return ggx_slope_pdf_m(s.slope, pair);
}

K_FN real ggx_slope_published_acceptance(ggx_slope_published s) {
    return ggx_slope_acceptance(s.slope);
}

/* The paper's fit of C_z^-1 on the upper half, u in [0, 1). */
K_FN real ggx_slope_published_z(real u) {
    real top = u * (u * (u * R(0.27385) - R(0.73369)) + R(0.46341));
    real bottom = u * (u * (u * R(0.093073) + R(0.309420)) - R(1.0)) + R(0.597999);
    return top / bottom;
}

/* The paper's root choice for the slope along i: A = 1, grazing and negative radicands guarded. */
K_FN ggx_slope_along ggx_slope_published_along(ggx_slope s, real u1) {
    real a = u1 * s.g.one_plus_z / k_max(s.g.i_std.z, K_EPS) - R(1.0);
    real b = s.azimuth.rho / k_max(s.g.i_std.z, K_EPS);
    real gap = a * a - R(1.0);
    real tmp = R(1.0) / (k_sign(gap) * k_max(k_abs(gap), K_EPS * K_EPS));
    real d = k_sqrt(k_max(b * b * tmp * tmp - (a * a - b * b) * tmp, R(0.0)));
    real x1 = b * tmp - d;
    real x2 = b * tmp + d;
    real x = k_select(k_or(a<R(0.0), x2 * b> R(1.0)), x1, x2);
    ggx_slope_along along;
    along.c = R(1.0) / k_sqrt(R(1.0) + x * x);
    along.s = x * along.c;
    return along;
}

K_FN facet_draw ggx_slope_published_draw(ggx_slope_published s, real u1, real u2, real u3) {
    bool upper = u2 > R(0.5);
    real z = ggx_slope_published_z(k_select(upper, R(2.0) * u2 - R(1.0), R(1.0) - R(2.0) * u2));
    ggx_slope_along exact = ggx_slope_along_of(s.slope, u1);
    ggx_slope_along published = ggx_slope_published_along(s.slope, u1);
    ggx_slope_along along;
    along.s = k_select(k_is(s.as_published), published.s, exact.s);
    along.c = k_select(k_is(s.as_published), published.c, exact.c);
    k_sincos half_e;
    half_e.s = R(1.0) / k_sqrt(R(1.0) + z * z);
    half_e.c = z * half_e.s;
    return ggx_slope_draw_of(s.slope, along, half_e, k_select(upper, R(1.0), R(-1.0)));
}

/* Worst errors of a draw in float, 2 10^7 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side). The
 * printed roots cancel by nature.
 * wo:  0.011 at wi (0x1.7930c4p-4, 0x1.39f9bep-1, 0x1.91ac04p-1),
 *      alpha (0x1.d9934p-3, 0x1.776cd6p-1) u (0x1.dba176p-1, 0x1.5115ccp-1)
 * pdf: 1.1e-06 relative at wi (0x1.42fd0ep-3, -0x1.b8995p-1, -0x1.eff848p-2),
 *      alpha (0x1.8cacfap-7, 0x1.f2780cp-6) u (0x1.1cd788p-2, 0x1.777104p-5) */

#endif
