/* kernel/dielectric_masking.h: shadowing between the two sides of a microsurface.
 *
 * On one side heights are correlated, G2 = 1/(1 + Li + Lo). Through the surface what is high is seen
 * well from above and badly from below: with h in (0, 1) the share of the surface that lies lower,
 * Smith's masking is h^Li from above and (1 - h)^Lo from below, and
 *   G2 = int_0^1 h^Li (1 - h)^Lo dh = B(1 + Li, 1 + Lo)              (Heitz et al. 2016)
 * The separable form is G1(i) G1(o). Both are symmetric, B is the smaller: near the horizon, and for an
 * index near 1, next to nothing gets through in a single scattering. */
#ifndef K_DIELECTRIC_MASKING_H
#define K_DIELECTRIC_MASKING_H

#include "ggx.h"
#include "log.h"

/* A larger Lambda is taken for this: directions within 1e-7 alpha of the horizon. */
#define DIELECTRIC_LAMBDA_MAX R(1e7)

/* Steps of the recurrence before Stirling's series, and its first term that is left out: below
 * 1e-8 (float) and 2e-16 (double) at 1 + steps. */
#if K_IS_F64
#define DIELECTRIC_GAMMA_STEPS 8
#else
#define DIELECTRIC_GAMMA_STEPS 4
#endif

/* 2^n, n a whole number in the range of exponents. */
K_FN real dielectric_power_of_two(real n) {
#if K_IS_F64
    real shift = R(6755399441055744.0); /* 1.5 2^52: what is added to it stands in its last bits */
    kint bias = K_INT(1023);
#else
    real shift = R(12582912.0);
    kint bias = K_INT(127);
#endif
    kint whole = k_bits(n + shift) - k_bits(shift);
    return k_from_bits((whole + bias) << K_MANTISSA_BITS);
}

/* exp(x) for x <= 80: 2^n times the series of exp(r), |r| <= ln(2)/2. 0 below the smallest numbers. */
K_FN real dielectric_exp(real x) {
#if K_IS_F64
    real lowest = R(-708.0);
    real ln2_high = R(6.93147180369123816490e-01);
    real ln2_low = R(1.90821492927058770002e-10);
#else
    real lowest = R(-87.0);
    real ln2_high = R(6.9314575195e-01);
    real ln2_low = R(1.4286067653e-06);
#endif
    real y = k_min(k_max(x, lowest), R(80.0));
    real n = k_floor(y * R(1.4426950408889634074) + R(0.5));
    real r = (y - n * ln2_high) - n * ln2_low;
#if K_IS_F64
    real p = R(1.6059043836821614599e-10) + r * R(1.1470745597729724714e-11);
    p = R(2.5052108385441718775e-08) + r * (R(2.0876756987868098979e-09) + r * p);
    p = R(2.7557319223985890653e-06) + r * (R(2.7557319223985890653e-07) + r * p);
    p = R(1.9841269841269841270e-04) + r * (R(2.4801587301587301587e-05) + r * p);
#else
    real p = R(1.9841269841269841270e-04) + r * R(2.4801587301587301587e-05);
#endif
    p = R(8.3333333333333333333e-03) + r * (R(1.3888888888888888889e-03) + r * p);
    p = R(1.6666666666666666667e-01) + r * (R(4.1666666666666666667e-02) + r * p);
    p = R(1.0) + r * (R(1.0) + r * (R(0.5) + r * p));
    return k_select(x > lowest, p * dielectric_power_of_two(n), R(0.0));
}

/* log(1 + t), t >= 0 */
K_FN real dielectric_log1p(real t) {
    real s = t / (R(2.0) + t);
    real small = R(2.0) * s + s * s * s * k_atanh_tail(s * s);
    return k_select(t < R(0.4), small, k_log(R(1.0) + t));
}

/* Stirling: log Gamma(x) = (x - 1/2) log x - x + log(2 pi)/2 + this */
K_FN real dielectric_stirling(real x) {
    real y = R(1.0) / x;
    real z = y * y;
#if K_IS_F64
    real p = R(-1.9175269175269175269e-03) + z * R(6.4102564102564102564e-03);
    p = R(-5.9523809523809523810e-04) + z * (R(8.4175084175084175084e-04) + z * p);
#else
    real p = R(-5.9523809523809523810e-04);
#endif
    p = R(-2.7777777777777777778e-03) + z * (R(7.9365079365079365079e-04) + z * p);
    return y * (R(8.3333333333333333333e-02) + z * p);
}

/* B(1 + a, 1 + b), a and b from 0 on. With p = 1 + max, q = 1 + min, X = p + n, Y = q + n and
 * Z = p + q + n: n steps of the recurrence, and Stirling's series of what is left, written so that
 * large terms are taken from each other before they are formed. */
K_FN real dielectric_beta(real a, real b) {
    real p = R(1.0) + k_min(k_max(a, b), DIELECTRIC_LAMBDA_MAX);
    real q = R(1.0) + k_min(k_min(a, b), DIELECTRIC_LAMBDA_MAX);
    real below = R(1.0);
    real above = R(1.0);
    real sums = R(1.0);
    K_UNROLL
    for (int k = 0; k < DIELECTRIC_GAMMA_STEPS; ++k) {
        real step = k_from_int(k);
        below = below * (q + step);
        above = above * (p + step);
        sums = sums * (p + q + step);
    }
    real n = k_from_int(DIELECTRIC_GAMMA_STEPS);
    real x = p + n;
    real y = q + n;
    real z = p + y;
    real first = (n - R(0.5)) * k_log(y) - q * dielectric_log1p(p / y);
    real second = (x - R(0.5)) * dielectric_log1p(q / x);
    real rest = dielectric_stirling(x) + dielectric_stirling(y) - dielectric_stirling(z);
    real half_log_2pi = R(0.91893853320467274178);
    real e = (first - second) + (rest + half_log_2pi - n);
    return dielectric_exp(e) * (sums / above / below);
}

/* Lambda of a direction by its height above (below) the surface; finite on the horizon. */
K_FN real dielectric_lambda(v3 v, real ax, real ay) {
    real x = ax * v.x;
    real y = ay * v.y;
    real z = k_abs(v.z);
    real xy2 = x * x + y * y;
    real t = k_sqrt(xy2 + z * z);
    real lambda = R(0.5) * xy2 / k_max(z * (z + t), K_TINY);
    return k_min(lambda, DIELECTRIC_LAMBDA_MAX);
}

/* G2(i, o)/G1(i) for i above and o below the surface */
K_FN real dielectric_shadowing(v3 wi, v3 wo, real ax, real ay, bool separable) {
    real a = dielectric_lambda(wi, ax, ay);
    real b = dielectric_lambda(wo, ax, ay);
    real correlated = (R(1.0) + a) * dielectric_beta(a, b);
    return k_select(separable, R(1.0) / (R(1.0) + b), k_min(correlated, R(1.0)));
}

/* Worst relative error of (1 + max) B in float, where it is at least 1e-6, 2 10^5 random pairs
 * (tools/numerics/dielectric_error.c): 4.5e-6 at a = 0x1.6c41b6p-1, b = 0x1.0cf0a6p+22. Double: below
 * 2e-13 on the pairs of tests/kernel/dielectric_template.h. */

#endif
