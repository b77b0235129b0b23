/* kernel/log.h: natural logarithm, branch-free. x = 2^n m with m in [sqrt(1/2), sqrt(2)),
 * log m = 2 atanh(s), s = (m - 1)/(m + 1). Polynomial: tools/numerics/coefficients.py. */
#ifndef K_LOG_H
#define K_LOG_H

#include "scalar.h"

/* (2 atanh(s) - 2s)/s^3, y = s^2 */
K_FN real k_atanh_tail(real y) {
#if K_IS_F64
    real p = R(0.13268714792348096667) + y * R(0.13087236196659622326);
    p = R(0.18181795600060792441) + y * (R(0.15386241881938595507) + y * p);
    p = R(0.28571428570801956942) + y * (R(0.22222222392089007936) + y * p);
    return R(0.66666666666666666464) + y * (R(0.40000000000000879686) + y * p);
#else
    real p = R(0.28550802553276710125) + y * R(0.23330964051772040253);
    return R(0.66666666554300180159) + y * (R(0.40000122000816880822) + y * p);
#endif
}

/* high + low, where low is what the last sum of high has lost */
K_STRUCT(k_log_parts) {
    real high;
    real low;
};

/* x > 0 and normal; 0, denormal and negative numbers are taken for the smallest normal one. */
K_FN k_log_parts k_log_split(real x) {
#if K_IS_F64
    kint half_bits = K_INT_PAIR(0x3fe6a09e, 0x667f3bcd); /* sqrt(1/2) */
    kint mantissa_mask = K_INT_PAIR(0x000fffff, 0xffffffff);
    kint bias = K_INT(1023);
    real smallest = R(2.2250738585072014e-308);
    real ln2_high = R(6.93147180369123816490e-01); /* 33 bits: n ln2_high is exact */
    real ln2_low = R(1.90821492927058770002e-10);
#else
    kint half_bits = K_INT(0x3f3504f3);
    kint mantissa_mask = K_INT(0x007fffff);
    kint bias = K_INT(127);
    real smallest = R(1.17549435e-38);
    real ln2_high = R(6.9314575195e-01); /* 16 bits */
    real ln2_low = R(1.4286067653e-06);
#endif
    kint shifted = k_bits(k_max(x, smallest)) - half_bits + (bias << K_MANTISSA_BITS);
    real n = k_from_int(k_shift_down(shifted, K_MANTISSA_BITS) - bias);
    real m = k_from_bits((shifted & mantissa_mask) + half_bits);
    real f = m - R(1.0);
    real s = f / (R(2.0) + f);
    real y = s * s;
    real half_f2 = R(0.5) * f * f;
    /* f - f^2/2 + s (f^2/2 + s^2 tail) = 2s + s^3 tail: exact in its leading term */
    real tail = s * (half_f2 + y * k_atanh_tail(y));
    real whole = n * ln2_high;
    real rest = f - (half_f2 - (tail + n * ln2_low));
    k_log_parts r;
    r.high = whole + rest;
    r.low = (whole - r.high) + rest;
    return r;
}

K_FN real k_log(real x) {
    return k_log_split(x).high;
}

/* Worst error, every normal float (tools/numerics/worst_error.c): 0.84 ulp at x = 0x1.67cc32p+0.
 * Double: below 2 ulp on the points of tests/kernel/elementary_template.h. */

#endif
