/* ssr/passes/noise.h: random numbers of a pixel. Neighbours along a Z-order curve take neighbouring points of
 * the (0, 2)-sequence of Sobol', so that the error of 2 x 2, 4 x 4, ... pixels cancels (Ahmed & Wonka 2020),
 * Owen-scrambled by hashing (Burley 2020); from frame to frame all of them shift along a lattice. */
#ifndef LOBE_SSR_NOISE_H
#define LOBE_SSR_NOISE_H

#include "kernel/scalar.h"

/* Of the seed and the frame. */
K_STRUCT(ssr_noise_keys) {
    kword order;
    kword first;
    kword second;
    kword third;
    kword shift_first; /* 2^32: once around */
    kword shift_second;
};

K_STRUCT(ssr_noise) {
    real u1;
    real u2;
    real u3;
};

/* The bits of x < 2^16 on the even places. */
K_FN kword ssr_spread_bits(kword x) {
    kword a = (x | x << 8) & 0x00ff00ffu;
    kword b = (a | a << 4) & 0x0f0f0f0fu;
    kword c = (b | b << 2) & 0x33333333u;
    return (c | c << 1) & 0x55555555u;
}

K_FN kword ssr_reverse_bits(kword x) {
    kword a = x << 16 | x >> 16;
    kword b = (a & 0x00ff00ffu) << 8 | (a >> 8 & 0x00ff00ffu);
    kword c = (b & 0x0f0f0f0fu) << 4 | (b >> 4 & 0x0f0f0f0fu);
    kword d = (c & 0x33333333u) << 2 | (c >> 2 & 0x33333333u);
    return (d & 0x55555555u) << 1 | (d >> 1 & 0x55555555u);
}

/* Nested scrambling of a reversed number: every bit depends on the lower ones only. */
K_FN kword ssr_scramble(kword x, kword key) {
    kword a = x + key;
    kword b = a ^ a * 0x6c50b47cu;
    kword c = b ^ b * 0xb82f1e52u;
    kword d = c ^ c * 0xc7afe638u;
    return d ^ d * 0x8d22f6e6u;
}

/* The second dimension of Sobol' is Pascal's triangle modulo 2, applied by halves. */
K_FN kword ssr_sobol_second_reversed(kword x) {
    kword a = x ^ (x & 0xaaaaaaaau) >> 1;
    kword b = a ^ (a & 0xccccccccu) >> 2;
    kword c = b ^ (b & 0xf0f0f0f0u) >> 4;
    kword d = c ^ (c & 0xff00ff00u) >> 8;
    return d ^ (d & 0xffff0000u) >> 16;
}

/* Every bit of the result depends on every bit of x. */
K_FN kword ssr_hash(kword x) {
    kword a = (x ^ x >> 16) * 0x21f0aaadu;
    kword b = (a ^ a >> 15) * 0xd35a2d97u;
    return b ^ b >> 15;
}

K_FN ssr_noise ssr_noise_of(ssr_noise_keys keys, kword x, kword y) {
    kword place = ssr_spread_bits(x) | ssr_spread_bits(y) << 1;
    kword index = ssr_reverse_bits(ssr_scramble(ssr_reverse_bits(place), keys.order));
    kword first = ssr_reverse_bits(ssr_scramble(index, keys.first));
    kword second = ssr_reverse_bits(ssr_scramble(ssr_sobol_second_reversed(index), keys.second));
    ssr_noise u;
    u.u1 = k_unit_of_word(first + keys.shift_first);
    u.u2 = k_unit_of_word(second + keys.shift_second);
    u.u3 = k_unit_of_word(ssr_hash(ssr_hash(place ^ keys.third) + keys.third));
    return u;
}

#endif
