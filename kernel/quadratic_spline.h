/* kernel/quadratic_spline.h: a distribution function on [0, 1] that follows three values of a density: two
 * rational quadratics, joined at 1/2 (Gregory & Delbourgo 1982). It is increasing for any positive
 * values, its density is continuous, and its inverse is the root of a quadratic. */
#ifndef K_QUADRATIC_SPLINE_H
#define K_QUADRATIC_SPLINE_H

#include "scalar.h"

K_STRUCT(quadratic_spline) {
    real at_0; /* the density at 0, 1/2 and 1 */
    real at_half;
    real at_1;
    real lower; /* its share below 1/2 */
};

/* A density in the proportions z0 : zm : z1. Each half holds what a density that rises steeply to a
 * plateau would hold. */
K_FN quadratic_spline quadratic_spline_of(real z0, real zm, real z1) {
    real lower = R(0.5) * (R(0.8) * zm + R(0.2) * z0);
    real upper = R(0.5) * (R(0.8) * zm + R(0.2) * z1);
    real inv = R(1.0) / (lower + upper);
    quadratic_spline s;
    s.at_0 = z0 * inv;
    s.at_half = zm * inv;
    s.at_1 = z1 * inv;
    s.lower = lower * inv;
    return s;
}

/* One half: its slope from end to end, and the density at both ends. */
K_STRUCT(quadratic_spline_half) {
    real mean;
    real left;
    real right;
};

K_FN quadratic_spline_half quadratic_spline_half_of(quadratic_spline s, bool upper) {
    quadratic_spline_half h;
    h.mean = R(2.0) * k_select(upper, R(1.0) - s.lower, s.lower);
    h.left = k_select(upper, s.at_half, s.at_0);
    h.right = k_select(upper, s.at_1, s.at_half);
    return h;
}

K_FN real quadratic_spline_density(quadratic_spline s, real u) {
    bool upper = u >= R(0.5);
    quadratic_spline_half h = quadratic_spline_half_of(s, upper);
    real a = R(2.0) * u - k_select(upper, R(1.0), R(0.0));
    real b = R(1.0) - a;
    real bottom = h.mean + (h.left + h.right - R(2.0) * h.mean) * a * b;
    real top = h.right * a * a + R(2.0) * h.mean * a * b + h.left * b * b;
    return h.mean * h.mean * top / (bottom * bottom);
}

K_FN real quadratic_spline_inverse(quadratic_spline s, real share) {
    bool upper = share >= s.lower;
    quadratic_spline_half h = quadratic_spline_half_of(s, upper);
    real rise = R(2.0) * (share - k_select(upper, s.lower, R(0.0))) / h.mean;
    real bend = (h.left + h.right - R(2.0) * h.mean) * rise;
    real b = h.left - bend;
    real root = k_sqrt(k_max(b * b + R(4.0) * (h.mean - h.left + bend) * h.mean * rise, R(0.0)));
    real a = k_saturate(R(2.0) * h.mean * rise / k_max(b + root, K_TINY));
    return R(0.5) * a + k_select(upper, R(0.5), R(0.0));
}

#endif
