/* kernel/beckmann_slopes.h: visible slopes along i of a Gaussian of unit roughness, whole or between two
 * limits: distribution function, density and its inverse. In the stretched frame of Heitz & d'Eon 2014, with
 * c = cot(theta) of either sign, a slope x < c is seen with the density
 *     p(x) = 2 (c - x) exp(s^2 - x^2)/K,   s = max(-c, 0),   K = sqrt(pi) exp(s^2) int_{-c}^inf erfc.
 * The unknown is the depth t = -x - s: below the horizon x sticks to c and only its distance t from
 * it keeps its digits; above, t is minus the slope. With c+ = max(c, 0) the share of slopes deeper than t is
 *     t >= 0:  exp(-t (t + 2s)) k(t)/K,  k = 1 + sqrt(pi) c erfcx(t)  or  (t + s defect(s + t))/(s + t),
 *     t < 0:   1 - (exp(-t^2)(sqrt(pi) c erfcx(-t) - 1) + exp(-c^2) defect(c))/K:
 * every term positive where its share is small, nothing underflows. Within about one of c, where these cancel,
 * the share between c and c - g is an integral over g, by Gauss quadrature. The inverse is found by steps of
 * Halley's third-order method inside a bracket (Jakob 2014 and Tokuyoshi 2021 take Newton steps without
 * one), from a start that is exact for c = 0, at both ends, and to second order at t = 0. */
#ifndef K_BECKMANN_SLOPES_H
#define K_BECKMANN_SLOPES_H

#include "erf.h"
#include "log.h"

#define K_SQRT_PI R(1.77245385090551602730)

/* The slopes between two depths, and what depends on c only. */
K_STRUCT(beckmann_slopes) {
    real c_plus;
    real s;
    real k;             /* K */
    real end;           /* exp(-c^2) defect(c), for c >= 0 */
    real deep_0;        /* share deeper than t = 0 */
    real shallow_0;     /* share above it */
    real near;          /* exp(-c+^2)/K */
    real end_gap;       /* c - x is at most end_gap sqrt(share above x) */
    real t_least;       /* the range: depth of its greatest slope */
    real t_most;        /* and of its smallest */
    real deep_most;     /* share of all visible slopes deeper than t_most */
    real deep_least;    /* deeper than t_least */
    real shallow_most;  /* 1 - deep_most */
    real shallow_least; /* 1 - deep_least */
};

/* What a depth divides the visible slopes into. */
K_STRUCT(beckmann_shares) {
    real deep;
    real shallow;
    kint by_deep;
};

/* Beyond this depth lies nothing that a random number can reach: a share of K_EPS^2. */
K_FN real beckmann_slopes_bottom(real c_plus, real s, real k) {
    real exponent = k_max(-k_log(k_min(k, R(1.0))), R(0.0)) - R(2.0) * k_log(K_EPS);
    return exponent / (s + k_sqrt(s * s + exponent));
}

/* Everything that is visible. */
K_FN beckmann_slopes beckmann_slopes_of(real c) {
    real a = k_abs(c);
    real defect = k_erfcx_defect(a);
    bool above = c >= R(0.0);
    beckmann_slopes r;
    r.c_plus = k_select(above, a, R(0.0));
    r.s = k_select(above, R(0.0), a);
    real peak = k_select(above, k_exp_minus_square(a), R(1.0));
    r.end = k_select(above, peak * defect, R(0.0));
    r.k = k_select(above, R(2.0) * K_SQRT_PI * r.c_plus + r.end, defect);
    r.near = peak / r.k;
    real rise = K_SQRT_PI * r.c_plus;
    r.deep_0 = k_select(above, (R(1.0) + rise) / r.k, R(1.0));
    r.shallow_0 = k_max(rise - R(1.0) + r.end, K_TINY) / r.k;
    real near = k_min(r.c_plus, R(9.0));
    r.end_gap = k_select(r.c_plus < R(9.0), k_sqrt(r.k) * k_exp(R(0.5) * near * near), K_HUGE);
    r.t_least = -r.c_plus;
    r.t_most = beckmann_slopes_bottom(r.c_plus, r.s, r.k);
    r.deep_most = R(0.0);
    r.deep_least = R(1.0);
    r.shallow_most = R(1.0);
    r.shallow_least = R(0.0);
    return r;
}

/* exp(c^2 - x^2) at the slope x = c - v */
K_FN real beckmann_gaussian_at(real v, real c) {
    return k_exp(v * (R(2.0) * c - v));
}

/* int_0^1 2 h exp(c^2 - (c - g h)^2) dh by Gauss quadrature (tools/numerics/gauss_nodes.py) */
K_FN real beckmann_near_integral(real g, real c) {
#if K_IS_F64
    real sum =
        R(0.0043616941715462617451) * beckmann_gaussian_at(R(0.036257812883209460941) * g, c);
    sum = sum + R(0.024120008569570758103) * beckmann_gaussian_at(R(0.11807897878999870019) * g, c);
    sum = sum + R(0.063609642982108002523) * beckmann_gaussian_at(R(0.23717698481496038532) * g, c);
    sum = sum + R(0.11680239059033022113) * beckmann_gaussian_at(R(0.38188276530470597536) * g, c);
    sum = sum + R(0.16871664368984069879) * beckmann_gaussian_at(R(0.53802959891898906512) * g, c);
    sum = sum + R(0.20061761838673657931) * beckmann_gaussian_at(R(0.69033242007236218294) * g, c);
    sum = sum + R(0.19706748434469141032) * beckmann_gaussian_at(R(0.82388334383700471814) * g, c);
    sum = sum + R(0.15214851021861632516) * beckmann_gaussian_at(R(0.92561261029080395536) * g, c);
    sum = sum + R(0.072556007046559742919) * beckmann_gaussian_at(R(0.98558759035112345137) * g, c);
#else
    real sum = R(0.031495829043384552371) * beckmann_gaussian_at(R(0.098535085798826426123) * g, c);
    sum = sum + R(0.1478177401452333407) * beckmann_gaussian_at(R(0.30453572664636390549) * g, c);
    sum = sum + R(0.2927739741693396174) * beckmann_gaussian_at(R(0.56202518975261385599) * g, c);
    sum = sum + R(0.33434927618873913098) * beckmann_gaussian_at(R(0.80198658212639182746) * g, c);
    sum = sum + R(0.19356318045330335855) * beckmann_gaussian_at(R(0.96019014294853125766) * g, c);
#endif
    return sum;
}

/* The shares on both sides of depth t; `by_deep` tells which of the two has all its digits: the other is 1
 * minus it. */
K_FN beckmann_shares beckmann_slopes_shares(beckmann_slopes r, real t) {
    bool below_zero = t >= R(0.0);
    real a = k_abs(t);
    real erfcx = k_erfcx_positive(a);
    real y = r.s + a;
    real under = (a + r.s * k_erfcx_defect(y)) / k_max(y, K_TINY);
    real e = k_exp(-(a * (a + R(2.0) * r.s)));
    real scaled = K_SQRT_PI * r.c_plus * erfcx;
    real deep = e * k_select(r.s > R(0.0), under, R(1.0) + scaled) / r.k;
    real shallow = k_max(e * (scaled - R(1.0)) + r.end, R(0.0)) / r.k;
    real gap = r.c_plus + t;
    bool near = k_and(gap * (gap + R(2.0) * r.s) < R(1.0), r.c_plus < R(1.0));
    real near_gap = k_select(near, k_max(gap, R(0.0)), R(0.0));
    real near_shallow =
        near_gap * near_gap * r.near * beckmann_near_integral(near_gap, r.c_plus - r.s);
    shallow = k_select(near, near_shallow, shallow);
    beckmann_shares shares;
    shares.by_deep = k_flag(k_and(below_zero, !near));
    shares.deep = k_select(k_is(shares.by_deep), k_min(deep, R(1.0)), R(1.0) - shallow);
    shares.shallow = k_select(k_is(shares.by_deep), R(1.0) - shares.deep, shallow);
    return shares;
}

/* Density of the slope over all visible slopes. */
K_FN real beckmann_slopes_density(beckmann_slopes r, real t) {
    return R(2.0) * k_max(r.c_plus + t, R(0.0)) * k_exp(-(t * (t + R(2.0) * r.s))) / r.k;
}

/* Only the slopes with depths from t_least to t_most, within what is visible. */
K_FN beckmann_slopes beckmann_slopes_between(beckmann_slopes all, real t_least, real t_most) {
    beckmann_slopes r = all;
    r.t_least = k_min(k_max(t_least, all.t_least), all.t_most);
    r.t_most = k_min(k_max(t_most, r.t_least), all.t_most);
    beckmann_shares least = beckmann_slopes_shares(all, r.t_least);
    beckmann_shares most = beckmann_slopes_shares(all, r.t_most);
    r.deep_least = least.deep;
    r.shallow_least = least.shallow;
    r.deep_most = most.deep;
    r.shallow_most = most.shallow;
    return r;
}

/* Share of the visible slopes that lies in the range, from the smaller of the two tails. */
K_FN real beckmann_slopes_mass(beckmann_slopes r) {
    real by_deep = r.deep_least - r.deep_most;
    real by_shallow = r.shallow_most - r.shallow_least;
    return k_max(k_select(r.deep_least < R(0.5), by_deep, by_shallow), R(0.0));
}

/* Where the inverse begins: depth with a share of `deep` below it, `shallow` above.
 * L is minus the logarithm of the share relative to that at t = 0. Below the horizon the exponent
 * E = t (t + 2s) is L + log(1 + ...); above it both sides solve L = r t + q t^2, the second-order
 * expansion at 0 with q bent towards 1 far out; near the horizon the slope saturates at c. */
K_FN real beckmann_slopes_start(beckmann_slopes r, real deep, real shallow) {
    bool is_deep = deep <= r.deep_0;
    real ratio = k_select(is_deep, deep / r.deep_0, shallow / r.shallow_0);
    real l = k_max(-k_log(ratio), R(0.0));
    real root_l = k_sqrt(l);

    real theta = r.s * k_sqrt(R(2.0) * r.k) / k_max(R(1.0) - r.k, K_EPS);
    real q = theta * (l + R(1.41421356237309504880) * root_l);
    real e = l + k_log((R(1.0) + q) / (R(1.0) + r.k * q));
    real under = e / k_max(r.s + k_sqrt(r.s * r.s + e), K_TINY);

    real c = r.c_plus;
    real b = R(1.0) / k_select(is_deep, R(1.0) + K_SQRT_PI * c, r.k * r.shallow_0);
    real slope = R(2.0) * c * b;
    real bend = k_max(R(0.5) * slope * slope + k_select(is_deep, b, -b), R(0.0));
    real bent = k_max(R(1.0) - (R(1.0) - bend) / (R(1.0) + R(0.27) * root_l), bend);
    real t = R(2.0) * l / k_max(slope + k_sqrt(slope * slope + R(4.0) * bent * l), K_TINY);

    /* x = c (1 - exp(-t/c)) keeps its second order with a smaller bend */
    real inv_c = R(1.0) / k_max(c, K_TINY);
    real straight = k_max(bend - R(0.5) * slope * inv_c, R(0.0));
    real t_straight =
        R(2.0) * l / k_max(slope + k_sqrt(slope * slope + R(4.0) * straight * l), K_TINY);
    real near_end = c * (R(1.0) - k_exp(-(t_straight * inv_c)));
    real weight = c * c / (c * c + R(4.0));
    real x = near_end + weight * (k_min(t, c) - near_end);
    x = k_max(x, c - r.end_gap * k_sqrt(shallow));
    return k_select(r.s > R(0.0), under, k_select(is_deep, t, -x));
}

/* The depth that leaves the share u of the range below it; v = 1 - u, so that neither tail loses digits.
 * Residual: at the foot. */
K_FN real beckmann_slopes_inverse(beckmann_slopes r, real u, real v) {
    real deep = u * r.deep_least + v * r.deep_most;
    real shallow = v * r.shallow_most + u * r.shallow_least;
    deep = k_max(deep, K_EPS * K_EPS);
    real low = r.t_least;
    real high = r.t_most;
    real t = k_min(k_max(beckmann_slopes_start(r, deep, shallow), low), high);
    K_UNROLL
    for (int step = 0; step < 2 + K_IS_F64; ++step) {
        beckmann_shares at = beckmann_slopes_shares(r, t);
        real excess = k_select(k_is(at.by_deep), at.deep - deep, shallow - at.shallow);
        low = k_select(excess >= R(0.0), t, low);
        high = k_select(excess <= R(0.0), t, high);
        real newton = excess / k_max(beckmann_slopes_density(r, t), K_TINY);
        real gap = k_max(r.c_plus + t, K_TINY);
        real halley = R(1.0) + newton * (R(0.5) / gap - (t + r.s));
        t = k_min(k_max(t + newton / k_max(halley, R(0.1)), low), high);
    }
    return t;
}

/* Residual of the inverse, the share of all visible slopes that the depth misses, against long double
 * (tests/kernel/beckmann_slopes_template.h: c over all magnitudes of both signs, whole and limited ranges): below
 * 3e-7 in float, at c < 0 and shares of about 1/2; 5e-16 in double. Of 400000 in float the worst is 2.5e-7 at c =
 * -7.12437057, u = 0.694748163, and 0.44 % are above 1e-7. The depth nearest to the exact root would leave up to
 * 4.4e-8: what is above that is the rounding of the share itself, an exponential times a quotient, not the
 * steps: of 120000 of them the worst is 2.3e-7, with a third step too, 2.4e-7 with the integral near the end in
 * use up to g (g + 2s) = 1.7, where half of the slopes are above, and 2.6e-7 with both. */

#endif
