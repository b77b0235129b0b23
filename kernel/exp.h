/* kernel/exp.h: the exponential, branch-free, of a number and of minus a square. x = n ln 2 + r with
 * |r| <= ln(2)/2; n by the word of the language that rounds: in a shader a sum and its difference again would be
 * nothing. Polynomial:
 * tools/numerics/coefficients.py. */
#ifndef K_EXP_H
#define K_EXP_H

#include "rounding.h"

/* exp(high + low) = (1 + tail) 2^n */
K_STRUCT(k_exp_parts) {
    real tail; /* in [-0.3, 0.42] */
    kint n;
};

/* (exp(r) - 1 - r)/r^2 */
K_FN real k_exp_tail(real r) {
#if K_IS_F64
    real p = R(2.5105208339987696806e-8) + r * R(2.0914680780540265278e-9);
    p = R(2.7557255421023504491e-6) + r * (R(2.7557273657975951331e-7) + r * p);
    p = R(0.00019841269874804214781) + r * (R(0.000024801587325536022311) + r * p);
    p = R(0.0083333333333261398193) + r * (R(0.0013888888888883751656) + r * p);
    p = R(0.16666666666666670987) + r * (R(0.041666666666666669752) + r * p);
    return R(0.5) + r * p;
#else
    real p = R(0.008363166823983192) + r * R(0.0013926177052780986);
    p = R(0.16666577756404877) + r * (R(0.04166653752326965) + r * p);
    return R(0.5) + r * p;
#endif
}

/* |low| small beside 1; high is cut where the result is 0 or infinite. NaN is taken for -infinity. */
K_FN k_exp_parts k_exp_split(real high, real low) {
#if K_IS_F64
    real least = R(-746.0);
    real most = R(710.0);
    real ln2_high = R(6.93147180369123816490e-01);
    real ln2_low = R(1.90821492927058770002e-10);
#else
    real least = R(-104.0);
    real most = R(89.0);
    real ln2_high = R(6.9314575195e-01);
    real ln2_low = R(1.4286067653e-06);
#endif
    real x = k_min(k_max(high, least), most);
    real n = k_round((x + low) * R(1.44269504088896340736));
    real coarse = x - n * ln2_high;
    real fine = low - n * ln2_low;
    real r = coarse + fine;
    k_exp_parts e;
    e.tail = r + (r * r * k_exp_tail(r) + ((coarse - r) + fine));
    e.n = k_to_int(n);
    return e;
}

/* x 2^n, |n| below twice the largest exponent, in two steps: a result below the smallest normal number is rounded once. */
K_FN real k_scale_by_power(real x, kint n) {
#if K_IS_F64
    kint bias = K_INT(1023);
#else
    kint bias = K_INT(127);
#endif
    kint both = n + K_INT(2) * bias;
    kint first = k_shift_down(both, 1);
    return x * k_from_bits(first << K_MANTISSA_BITS) *
           k_from_bits((both - first) << K_MANTISSA_BITS);
}

K_FN real k_exp(real x) {
    k_exp_parts e = k_exp_split(x, R(0.0));
    return k_scale_by_power(R(1.0) + e.tail, e.n);
}

/* exp(sign x^2), the square in two numbers. |x| is cut where the result is 0 or infinite. */
K_FN k_exp_parts k_exp_split_square(real x, real sign) {
#if K_IS_F64
    real most = R(28.0);
#else
    real most = R(11.0);
#endif
    real a = k_min(k_abs(x), most);
    real high = k_upper_half(a);
    return k_exp_split(sign * (high * high), sign * ((a - high) * (a + high)));
}

K_FN real k_exp_square(real x) {
    k_exp_parts e = k_exp_split_square(x, R(1.0));
    return k_scale_by_power(R(1.0) + e.tail, e.n);
}

K_FN real k_exp_minus_square(real x) {
    k_exp_parts e = k_exp_split_square(x, R(-1.0));
    return k_scale_by_power(R(1.0) + e.tail, e.n);
}

/* Worst errors, every float whose result is neither 1, 0 nor infinite (tools/numerics/worst_error.c): 0.96 ulp at
 * x = 0x1.20654cp+2, below zero 0.95 ulp at x = -0x1.c12872p+4. Double: 0.8 ulp on the points of
 * tests/kernel/special_vectors.h. */

#endif
