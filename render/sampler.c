#include "sampler.h"

#include "lobe/random.h"

enum { DIMENSIONS = 4, BITS = 32, NIBBLES = BITS / 4 };

/* One number a dimension. */
typedef uint32_t words __attribute__((vector_size(16)));

/* What four bits of the index make of the point, by Sobol direction numbers, bit-reversed (the first digit of
 * the point is bit 0). The first dimension is van der Corput's; the others follow from the primitive
 * polynomials x + 1, x^2 + x + 1 and x^3 + x + 1 over GF(2) and small odd initial numbers
 * (tools/numerics/sobol_directions.py, which also checks the stratification of every pair). */
static const words nibbles[16 * NIBBLES] = {
#include "sobol_nibbles.inc"
};

/* The steps below are the same for a number and for one of each dimension. */
#define REVERSE_BITS(x)                                                                            \
    do {                                                                                           \
        x = (x >> 16) | (x << 16);                                                                 \
        x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);                                   \
        x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);                                   \
        x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);                                   \
        x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);                                   \
    } while (0)

/* A permutation in which a bit depends on the lower ones only: on a reversed number it is a nested
 * uniform (Owen) scrambling. Constants of Burley 2020, listing 2. */
#define PERMUTE_UPWARD(x, seed)                                                                    \
    do {                                                                                           \
        x += (seed);                                                                               \
        x ^= x * 0x6c50b47cu;                                                                      \
        x ^= x * 0xb82f1e52u;                                                                      \
        x ^= x * 0xc7afe638u;                                                                      \
        x ^= x * 0x8d22f6e6u;                                                                      \
    } while (0)

/* A bijection of 32 bits that looks random (the finaliser of MurmurHash3). */
#define HASH(x)                                                                                    \
    do {                                                                                           \
        x ^= x >> 16;                                                                              \
        x *= 0x85ebca6bu;                                                                          \
        x ^= x >> 13;                                                                              \
        x *= 0xc2b2ae35u;                                                                          \
        x ^= x >> 16;                                                                              \
    } while (0)

uint32_t lobe_sampler_index_bits(uint32_t samples) {
    uint32_t bits = 1;
    while (bits < 31 && (1u << bits) < samples) bits++;
    return bits;
}

uint32_t lobe_sampler_round_key(uint64_t seed, uint32_t x, uint32_t y, uint32_t round) {
    return lobe_random(seed, ((uint64_t)y << 32) | x, round).word[0];
}

uint32_t lobe_sampler_key(uint64_t seed, uint32_t x, uint32_t y) {
    return lobe_sampler_round_key(seed, x, y, 0);
}

sampler_point lobe_sampler_next(sampler *s) {
    /* the powers of a linear congruential generator: a key a dimension */
    static const words factors = {0x915f77f5u, 0xca0bb079u, 0xd21f22cdu, 0x980c9931u},
                       terms = {0x93d765ddu, 0x2b589d5eu, 0xe4aeb2d3u, 0x83759eccu};
    uint32_t key = s->key ^ (s->group++ * 0x9e3779b9u);
    HASH(key);
    const uint32_t unused = BITS - s->index_bits;
    uint32_t shuffled = s->index;
    REVERSE_BITS(shuffled);
    shuffled >>= unused;
    PERMUTE_UPWARD(shuffled, key);
    shuffled <<= unused;
    /* `shuffled` is still reversed: its top bit is bit 0 of the index. */
    words point = nibbles[shuffled >> 28];
    for (uint32_t i = 1; 4 * i < s->index_bits; i++)
        point ^= nibbles[16 * i + (shuffled >> (28 - 4 * i) & 15u)];
    words keys = key * factors + terms;
    HASH(keys);
    PERMUTE_UPWARD(point, keys);
    REVERSE_BITS(point);
    return (sampler_point){{point[0], point[1], point[2], point[3]}};
}
