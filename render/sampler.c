#include "sampler.h"

#include "lobe/random.h"

enum { DIMENSIONS = 4, BITS = 32 };

/* Sobol direction numbers, bit-reversed (the first digit of the point is bit 0). The first dimension
 * is van der Corput's; the others follow from the primitive polynomials x + 1, x^2 + x + 1 and
 * x^3 + x + 1 over GF(2) and small odd initial numbers (tools/numerics/sobol_directions.py, which also
 * checks the stratification of every pair). */
static const uint32_t directions[BITS][DIMENSIONS] = {
#include "sobol_directions.inc"
};

static uint32_t reverse_bits(uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

/* A permutation in which a bit depends on the lower ones only: on a reversed number it is a nested
 * uniform (Owen) scrambling. Constants of Burley 2020, listing 2. */
static uint32_t permute_upward(uint32_t x, uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

/* A bijection of 32 bits that looks random (the finaliser of MurmurHash3). */
static uint32_t hash(uint32_t x) {
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    return x ^ (x >> 16);
}

uint32_t lobe_sampler_index_bits(uint32_t samples) {
    uint32_t bits = 1;
    while (bits < 31 && (1u << bits) < samples) bits++;
    return bits;
}

uint32_t lobe_sampler_key(uint64_t seed, uint32_t x, uint32_t y) {
    return lobe_random(seed, ((uint64_t)y << 32) | x, 0).word[0];
}

sampler_point lobe_sampler_next(sampler *s) {
    uint32_t key = hash(s->key ^ (s->group++ * 0x9e3779b9u));
    uint32_t unused = BITS - s->index_bits;
    uint32_t shuffled = permute_upward(reverse_bits(s->index) >> unused, key) << unused;
    uint32_t word[DIMENSIONS] = {0};
    /* `shuffled` is still reversed: its top bit is bit 0 of the index. */
    for (uint32_t i = 0; i < s->index_bits; i++) {
        uint32_t mask = 0u - ((shuffled >> (BITS - 1 - i)) & 1u);
        for (int d = 0; d < DIMENSIONS; d++) word[d] ^= directions[i][d] & mask;
    }
    sampler_point point;
    for (int d = 0; d < DIMENSIONS; d++) {
        key = key * 0x915f77f5u + 0x93d765ddu;
        point.bits[d] = reverse_bits(permute_upward(word[d], hash(key)));
    }
    return point;
}
