/* ssr/passes/bind_c.h: the passes in C, single precision. A shader includes bind_shader.h instead. */
#ifndef LOBE_SSR_BIND_C_H
#define LOBE_SSR_BIND_C_H

#include "kernel/bind/c_f32.h"

/* 32 bits without a sign: sums and products wrap around. */
typedef uint32_t kword;

/* The upper 24 bits as a number in [0, 1). */
K_FN real k_unit_of_word(kword word) {
    return (real)(kint)(word >> 8) * R(5.9604644775390625e-8);
}

/* x >= 0 */
K_FN kword k_word(kint x) {
    return (kword)x;
}

/* The whole number below x, 0 <= x < 2^31. */
K_FN kint k_whole(real x) {
    return (kint)x;
}

/* x / 2^count, cut, and x 2^count, 0 <= x < 2^24, the result too. SSE shifts all numbers of a vector by one count, and a
 * loop that asks for more does not become vectors; products of floats are as exact. Of any other x >= 0 the first is
 * some number >= 0. */
#if defined(__SSE2__) && !defined(__AVX2__)
K_FN real k_power_of_2(kint power) {
    return k_from_bits((127 + power) << K_MANTISSA_BITS);
}

K_FN kint k_down(kint x, kint count) {
    return (kint)(k_min((real)x, R(16777215.0)) * k_power_of_2(-count));
}

K_FN real k_up(kint x, kint count) {
    return (real)x * k_power_of_2(count);
}
#else
K_FN kint k_down(kint x, kint count) {
    return x >> count;
}

K_FN real k_up(kint x, kint count) {
    return (real)(x << count);
}
#endif

/* a < b, and false if a is no number. */
K_FN bool k_is_below(real a, real b) {
    return a < b;
}

#include "accumulate.h"
#include "between.h"
#include "camera.h"
#include "composite.h"
#include "fade.h"
#include "finite.h"
#include "march.h"
#include "noise.h"
#include "parameters.h"
#include "pyramid.h"
#include "ray.h"
#include "reproject.h"
#include "resolve.h"
#include "surface.h"
#include "trace.h"
#include "weight.h"

#endif
