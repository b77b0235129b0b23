/* kernel/bind/c.h: what the two C bindings share. Helpers are functions, not macros: a macro `min`
 * evaluates its arguments twice and made gcc give up on vectorising. */
#ifndef K_BIND_C_H
#define K_BIND_C_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* All methods have one signature: what a method does not need it still takes. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

/* Always: a loop becomes vectors only if everything in it is inlined, and a prepared model passed by value
 * would be copied through memory. */
#ifndef K_FN
#define K_FN static inline __attribute__((always_inline))
#endif
#define K_STRUCT(name)                                                                             \
    typedef struct name name;                                                                      \
    struct name

/* Before a loop of few steps inside what runs for many rows: written out, it stands in no vector's way. */
#if defined(__clang__)
#define K_UNROLL _Pragma("clang loop unroll(full)")
#else
#define K_UNROLL _Pragma("GCC unroll 16")
#endif

K_FN real k_select(bool condition, real yes, real no) {
    return condition ? yes : no;
}

/* Not the operators: they stop at the first answer, and what may be skipped is a branch. */
K_FN bool k_and(bool a, bool b) {
    return a & b;
}

K_FN bool k_or(bool a, bool b) {
    return a | b;
}

/* A condition that is kept in a structure: as a number as wide as `real`, which a loop over many rows
 * can hold in a lane. */
K_FN kint k_flag(bool condition) {
    return condition ? K_INT(1) : K_INT(0);
}

K_FN bool k_is(kint flag) {
    return flag != K_INT(0);
}

K_FN real k_min(real a, real b) {
    return a < b ? a : b;
}

K_FN real k_max(real a, real b) {
    return a > b ? a : b;
}

K_FN kint k_bits(real x) {
    kint bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

K_FN real k_from_bits(kint bits) {
    real x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* To the nearest whole number, |x| below 2^22 (2^51 in double): few processors round whole vectors. */
K_FN real k_round(real x) {
    return (x + K_ROUNDER) - K_ROUNDER;
}

/* The same as an integer. */
K_FN kint k_to_int(real x) {
    return k_bits(x + K_ROUNDER) - k_bits(K_ROUNDER);
}

/* The SSE2 baseline has no packed floor: by conversion, for |x| below the integer range. */
K_FN real k_floor(real x) {
    real whole = (real)(kint)x;
    return whole > x ? whole - R(1.0) : whole;
}

/* bits >= 0. Not >>: before AVX-512, processors cannot shift vectors of signed 64-bit integers. */
K_FN kint k_shift_down(kint bits, int count) {
    return (kint)((kuint)bits >> count);
}

/* Into the sign, where << of an int is undefined. */
K_FN kint k_shift_up(kint bits, int count) {
    return (kint)((kuint)bits << count);
}

#endif
