/* kernel/bind/c_f32.h: the kernel's words in C, single precision. */
#ifndef K_BIND_C_F32_H
#define K_BIND_C_F32_H

#include <stdint.h>

typedef float real;
typedef int32_t kint;
typedef uint32_t kuint;

#define R(x) x##f
#define K_INT(x) x
#define K_IS_F64 0
#define K_MANTISSA_BITS 23
#define K_EPS R(1.1920929e-7)     /* one ulp of 1 */
#define K_BELOW_ONE R(0.99999994) /* the largest number below 1 */
#define K_TINY R(1e-30)           /* a denominator that overflows nothing */
#define K_HUGE R(1e30)
#define K_ROUNDER R(12582912.0) /* 3 2^22: what is added to it stands in its last digits */
#define K_SIGN_BIT 31

#include "c.h"

K_FN real k_sqrt(real x) {
    return __builtin_sqrtf(x);
}

K_FN real k_abs(real x) {
    return __builtin_fabsf(x);
}

K_FN real k_from_int(kint n) {
    return (real)n;
}

#endif
