/* Random numbers of a pixel: neighbours along a Z-order curve take neighbouring points of the (0, 2)-sequence
 * of Sobol', so that the error of 2 x 2, 4 x 4, … pixels cancels (Ahmed & Wonka 2020), Owen-scrambled by
 * hashing (Burley 2020); from frame to frame all of them shift along a lattice of two dimensions. */
#include <math.h>

#include "lobe/random.h"
#include "pipeline.h"

/* The bits of x on the even places. */
static uint32_t spread_bits(uint32_t x) {
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}

static uint32_t reverse_bits(uint32_t x) {
    x = __builtin_bswap32(x);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

/* Nested scrambling of a reversed number: every bit depends on the lower ones only. */
static uint32_t scramble(uint32_t x, uint32_t key) {
    x += key;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    return x ^ x * 0x8d22f6e6u;
}

/* The second dimension of Sobol' is Pascal's triangle modulo 2, applied by halves. */
static uint32_t sobol_second_reversed(uint32_t x) {
    x ^= (x & 0xaaaaaaaau) >> 1;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xff00ff00u) >> 8;
    return x ^ (x & 0xffff0000u) >> 16;
}

static float shifted(uint32_t bits, double shift) {
    const double u = (double)bits * 0x1p-32 + shift;
    return fminf((float)(u - floor(u)), 0x1.fffffep-1f);
}

void lobe_ssr_noise(const lobe_ssr *s, int x, int y, float u[3]) {
    const lobe_random4 key = lobe_random(s->options.seed, 0, 0);
    const uint32_t place = spread_bits((uint32_t)x) | spread_bits((uint32_t)y) << 1;
    const uint32_t index = reverse_bits(scramble(reverse_bits(place), key.word[0]));
    const double n = (double)s->frame;
    /* powers of 1/1.32471795724…, the root of x^3 = x + 1: an even spread in two dimensions */
    u[0] = shifted(reverse_bits(scramble(index, key.word[1])), n * 0.7548776662466927);
    u[1] = shifted(reverse_bits(scramble(sobol_second_reversed(index), key.word[2])),
                   n * 0.5698402909980532);
    u[2] = lobe_random_unit_f32(lobe_random(s->options.seed, 1 + s->frame, place).word[0]);
}
