/* kernel/beckmann_horizon.h: visible normals whose reflection leaves, and no others. A microfacet of slope S
 * reflects i above the surface iff |S + i_xy/i_z| <= 1/i_z: the useful slopes fill a disk, whatever their
 * distribution. In the stretched frame turned to i it is the ellipse
 *     q11 x^2 + 2 q12 x y + q22 y^2 + 2 x/c <= 1,
 * that spans x0 < x < x1 < c along i and, at x, a chord of half width w about y = -(q12/q22) x. The slope
 * along i is drawn from the visible ones between x0 and x1 (kernel/beckmann_slopes.h), the slope across from the
 * Gaussian on the chord: nothing is rejected.
 *     p(o) = D/(2 V) q(u)/(Z_x Z_y(x)),
 * Z_x and Z_y the shares in the range and on the chord, u the share of the range that lies deeper than x.
 * With q = 1 the variance is that of 1/Z_y; here q follows Z_y, which it meets in proportion at three
 * slopes, and p is all but a constant times the visible density. Relative furnace variance, mean of 48 cases
 * (tools/numerics/furnace_variance.c): 0.161 drawing all visible normals, 0.044 like this.
 * The frame turns with the azimuth of i: at normal incidence the map has a seam.
 *
 * From behind every reflection leaves: there these are all visible normals. */
#ifndef K_BECKMANN_HORIZON_H
#define K_BECKMANN_HORIZON_H

#include "beckmann_chord.h"
#include "beckmann_visible.h"
#include "quadratic_spline.h"

/* Chords farther out than this hold less than 2e-12 of the Gaussian: no slope along i is drawn whose chord
 * is, and what underflows never matters. */
#define BECKMANN_HORIZON_FAR R(5.0)

K_STRUCT(beckmann_horizon) {
    beckmann_base g;
    facet_azimuth azimuth;
    beckmann_slopes slopes;
    real mass;    /* Z_x */
    real x1;      /* the greatest useful slope along i */
    real falling; /* 1/c + sqrt(1/c^2 + bend): w^2 = (x1 - x)(bend x + falling)/q22 */
    real bend;    /* det q/q22 */
    real q22;
    real tilt;    /* -q12/q22: the chord's centre is tilt x */
    real x_least; /* the slopes along i that are drawn */
    real x_most;
    quadratic_spline along;
    kint limited;
};

/* The useful slopes across i at a slope along it. */
K_FN beckmann_chord beckmann_horizon_chord(beckmann_horizon s, real x) {
    real room = k_max(s.x1 - x, K_EPS * s.x1);
    real left = k_max(s.bend * x + s.falling, K_EPS * s.falling);
    beckmann_chord chord;
    chord.centre = s.tilt * x;
    chord.w = k_sqrt(room * left / s.q22);
    return chord;
}

/* Z_y where the share u of the range is deeper */
K_FN real beckmann_horizon_chord_at(beckmann_horizon s, real u) {
    real t = beckmann_slopes_inverse(s.slopes, u);
    return beckmann_chord_share(beckmann_horizon_chord(s, -t));
}

/* An end of the slopes along i: of the ellipse, where its chord is near enough, else where the ellipse
 * meets |y| = far: q11 x^2 + 2 (inv_c - rise) x = 1 - q22 far^2, rise = -q12 y > 0 where x > 0. */
K_FN real beckmann_horizon_end(beckmann_horizon s, real inv_c, real end) {
    real side = k_sign(end);
    real half_b = inv_c - side * s.q22 * k_abs(s.tilt) * BECKMANN_HORIZON_FAR;
    real q11 = s.q22 * s.tilt * s.tilt + s.bend;
    real rest = R(1.0) - s.q22 * BECKMANN_HORIZON_FAR * BECKMANN_HORIZON_FAR;
    real root = k_sqrt(k_max(half_b * half_b + q11 * rest, R(0.0)));
    real sum = k_abs(half_b) + root;
    /* the root on the side of `end`, without a difference */
    real met = k_select(side * half_b > R(0.0), side * rest / k_max(sum, K_TINY), side * sum / q11);
    return k_select(k_abs(s.tilt * end) > BECKMANN_HORIZON_FAR, met, end);
}

K_FN beckmann_horizon beckmann_horizon_prepare(beckmann_base g) {
    beckmann_horizon s;
    s.g = g;
    s.azimuth = facet_azimuth_of(g.i_std);
    s.limited = k_flag(g.c > K_EPS * K_EPS); /* at the horizon itself the disk is a half-plane */
    real x2 = s.azimuth.x * s.azimuth.x;
    real y2 = s.azimuth.y * s.azimuth.y;
    real ax2 = g.ax * g.ax;
    real ay2 = g.ay * g.ay;
    s.q22 = ax2 * y2 + ay2 * x2;
    s.tilt = (ax2 - ay2) * s.azimuth.x * s.azimuth.y / s.q22;
    s.bend = ax2 * ay2 / s.q22;
    real inv_c = R(1.0) / k_select(k_is(s.limited), g.c, R(1.0));
    s.falling = inv_c + k_sqrt(inv_c * inv_c + s.bend);
    s.x1 = R(1.0) / s.falling;
    s.x_most = beckmann_horizon_end(s, inv_c, s.x1);
    s.x_least = beckmann_horizon_end(s, inv_c, -s.falling / s.bend);
    beckmann_slopes all = beckmann_slopes_of(g.c);
    s.slopes = beckmann_slopes_between(all, k_select(k_is(s.limited), -s.x_most, all.t_least),
                                       k_select(k_is(s.limited), -s.x_least, all.t_most));
    s.mass = k_select(k_is(s.limited), k_max(beckmann_slopes_mass(s.slopes), K_TINY), R(1.0));
    real deep = beckmann_horizon_chord_at(s, R(0.02));
    real middle = beckmann_horizon_chord_at(s, R(0.5));
    real shallow = beckmann_horizon_chord_at(s, R(0.98));
    real least = R(0.1) * k_max(middle, k_max(deep, shallow));
    s.along = quadratic_spline_of(k_select(k_is(s.limited), k_max(deep, least), R(1.0)),
                                  k_select(k_is(s.limited), k_max(middle, least), R(1.0)),
                                  k_select(k_is(s.limited), k_max(shallow, least), R(1.0)));
    return s;
}

/* Density over that of the visible normals, at the slope x along i; the rounding of a drawn normal does not
 * put it out of the range. */
K_FN real beckmann_horizon_gain(beckmann_horizon s, real x) {
    beckmann_shares at = beckmann_slopes_shares(s.slopes, -x);
    real by_deep = (at.deep - s.slopes.deep_most) / s.mass;
    real by_shallow = R(1.0) - (at.shallow - s.slopes.shallow_least) / s.mass;
    real u = k_saturate(k_select(at.deep < at.shallow, by_deep, by_shallow));
    real chord = beckmann_chord_share(beckmann_horizon_chord(s, x));
    real gain = quadratic_spline_density(s.along, u) / (s.mass * chord);
    real room = R(64.0) * K_EPS;
    bool drawn = k_and(x<s.x_most + room, x> s.x_least - room);
    return k_select(k_is(s.limited), k_select(drawn, gain, R(0.0)), R(1.0));
}

/* The slope along i of a normal */
K_FN real beckmann_horizon_slope_along(beckmann_horizon s, v3 m) {
    real inv_z = R(1.0) / k_max(m.z, K_TINY);
    return -(s.azimuth.x * m.x / s.g.ax + s.azimuth.y * m.y / s.g.ay) * inv_z;
}

K_FN real beckmann_horizon_pdf(beckmann_horizon s, facet_pair pair) {
    real x = beckmann_horizon_slope_along(s, pair.m);
    return beckmann_visible_pdf(s.g, pair) * beckmann_horizon_gain(s, x);
}

/* Normals outside the disk are never drawn. */
K_FN real beckmann_horizon_pdf_m_of(facet_pair pair, real pdf) {
    real pdf_m = R(4.0) * k_max(pair.cos_im, R(0.0)) * pdf;
    return k_select(pair.wo.z > R(0.0), pdf_m, R(0.0));
}

K_FN real beckmann_horizon_pdf_m(beckmann_horizon s, facet_pair pair) {
    return beckmann_horizon_pdf_m_of(pair, beckmann_horizon_pdf(s, pair));
}

/* All leave the surface; with a second plane the share has no closed form. */
K_FN real beckmann_horizon_acceptance(beckmann_horizon s) {
    return k_select(k_is(s.g.tilted), R(-1.0), R(1.0));
}

/* o_z = i_z q22 (w^2 - (y - centre)^2) m_z^2: positive whatever is rounded, and 0 at the rim. */
K_FN facet_draw beckmann_horizon_draw(beckmann_horizon s, real u1, real u2, real u3) {
    real u = quadratic_spline_inverse(s.along, u1);
    real t = beckmann_slopes_inverse(s.slopes, u);
    beckmann_chord chord = beckmann_horizon_chord(s, -t);
    real offset = beckmann_chord_offset(chord, u2);
    real across = k_select(k_is(s.limited), chord.centre + offset, beckmann_gaussian(u2));
    facet_pair pair = beckmann_pair_of_depth(s.g, s.azimuth, t, across);
    real rim = (chord.w - offset) * (chord.w + offset) * s.q22;
    pair.wo.z = k_select(k_is(s.limited), s.g.wi.z * rim * pair.m.z * pair.m.z, pair.wo.z);
    pair.leaves = k_and(facet_leaves(pair.wo, s.g.plane), pair.cos_im > R(0.0));
    real pdf = beckmann_visible_pdf(s.g, pair) * beckmann_horizon_gain(s, -t);
    return beckmann_draw_of(s.g, pair, beckmann_horizon_pdf_m_of(pair, pdf), pdf);
}

/* Worst errors of a draw in float, 3 10^5 random inputs (tools/numerics/beckmann_error.c: roughness 0.01 to 2,
 * either side, c above -10).
 * wo:  8.9e-06 at wi (0x1.937b3p-3, -0x1.7825f2p-1, 0x1.4c634cp-1),
 *      alpha (0x1.112f7ap-2, 0x1.148562p-3) u (0x1.fff2eep-1, 0x1.b9daa4p-2)
 * pdf: 7.5e-04 relative at wi (0x1.69145cp-4, 0x1.ba2ac6p-2, 0x1.cb98b2p-1),
 *      alpha (0x1.d4168p-7, 0x1.b5d81ep+0) u (0x1.cae4p-10, 0x1.e7da3ep-1) */

#endif
