/* kernel/beckmann_visible.h: what the samplers of the visible Beckmann normals share: their density, and
 * the way from a slope along i and one across it to a draw. */
#ifndef K_BECKMANN_VISIBLE_H
#define K_BECKMANN_VISIBLE_H

#include "beckmann.h"
#include "beckmann_slopes.h"
#include "erfinv.h"

/* Density over directions, continued to reflections that do not leave. */
K_FN real beckmann_visible_pdf(beckmann_base g, facet_pair pair) {
    return g.density_bias * pair.d / (R(2.0) * g.visible);
}

/* Density over the sphere of normals. */
K_FN real beckmann_visible_pdf_m(beckmann_base g, facet_pair pair) {
    return R(4.0) * k_max(pair.cos_im, R(0.0)) * beckmann_visible_pdf(g, pair);
}

/* Share of the draws that leave the surface: all from below, of those from above no closed form is known. */
K_FN real beckmann_visible_acceptance(beckmann_base g) {
    return k_select(k_and(g.wi.z <= R(0.0), !k_is(g.tilted)), R(1.0), R(-1.0));
}

/* The pair of the slope at depth t along i (kernel/beckmann_slopes.h) and y across. i.m is taken of the m
 * that came out, which keeps o a unit vector; well below the horizon i.m is nothing but rounding there,
 * and what it must be is known: b m_z (c - x). So is D: of the slopes, not of what rounding left of them. */
K_FN facet_pair beckmann_pair_of_depth(beckmann_base g, facet_azimuth azimuth, real t, real y) {
    real s = k_max(-g.c, R(0.0));
    real x = -t - s;
    v3 m =
        beckmann_normal_of_slopes(g, x * azimuth.x - y * azimuth.y, x * azimuth.y + y * azimuth.x);
    real dot = v3_dot(g.wi, m);
    return beckmann_pair_about(g, m, k_select(s > R(3.0), g.b * m.z * k_max(t, R(0.0)), dot),
                               beckmann_d_of(beckmann_exponent_at(g, t, y), m, g.ax, g.ay));
}

K_FN facet_draw beckmann_visible_draw(beckmann_base g, facet_pair pair) {
    return beckmann_draw_of(g, pair, beckmann_visible_pdf_m(g, pair),
                            beckmann_visible_pdf(g, pair));
}

/* A standard Gaussian slope of a random number: erfinv(2u - 1), with the digits that u has at its ends. */
K_FN real beckmann_gaussian(real u) {
    return -k_erfcinv(R(2.0) * u);
}

#endif
