/* kernel/bind/c_f64.h: the kernel's words in C, double precision. */
#ifndef K_BIND_C_F64_H
#define K_BIND_C_F64_H

#include <stdint.h>

typedef double real;
typedef int64_t kint;
typedef uint64_t kuint;

#define R(x) x
#define K_INT(x) INT64_C(x)
/* 64 bits by halves: glslang refuses a longer literal even where the preprocessor skips it. */
#define K_INT_PAIR(high, low) ((kint)(UINT64_C(high) << 32 | UINT64_C(low)))
#define K_IS_F64 1
#define K_MANTISSA_BITS 52
#define K_EPS R(2.220446049250313e-16)
#define K_BELOW_ONE R(0.9999999999999999)
#define K_TINY R(1e-290)
#define K_HUGE R(1e290)
#define K_ROUNDER R(6755399441055744.0) /* 3 2^51: what is added to it stands in its last digits */
#define K_SIGN_BIT 63

#include "c.h"

K_FN real k_sqrt(real x) {
    return __builtin_sqrt(x);
}

K_FN real k_abs(real x) {
    return __builtin_fabs(x);
}

/* |n| < 2^51. Before AVX-512 processors convert no vectors of 64-bit integers. */
K_FN real k_from_int(kint n) {
    return k_from_bits(k_bits(K_ROUNDER) + n) - K_ROUNDER;
}

#endif
