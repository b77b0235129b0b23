/* ssr/passes/bind_shader.h: what the passes need beside the kernel's words, in GLSL and HLSL. */
#ifndef LOBE_SSR_BIND_SHADER_H
#define LOBE_SSR_BIND_SHADER_H

/* 32 bits without a sign: sums and products wrap around. */
#define kword uint

/* The upper 24 bits as a number in [0, 1). */
K_FN real k_unit_of_word(kword word) {
    return float(word >> 8) * R(5.9604644775390625e-8);
}

/* x >= 0 */
K_FN kword k_word(kint x) {
    return uint(x);
}

/* The whole number below x, 0 <= x < 2^31. */
K_FN kint k_whole(real x) {
    return kint(x);
}

/* x / 2^count, cut, and x 2^count, 0 <= x < 2^24, the result too. */
K_FN kint k_down(kint x, kint count) {
    return x >> count;
}

K_FN real k_up(kint x, kint count) {
    return float(x << count);
}

/* a < b, and false if a is no number: by its bits, for the compilers of shaders turn conditions around as if
 * there were none such. */
K_FN bool k_is_below(real a, real b) {
    return k_and((K_FLOAT_BITS(a) & 0x7fffffff) <= 0x7f800000, a < b);
}

#endif
