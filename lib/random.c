/* lib/random.c: Philox4x32-10 (Salmon et al. 2011): ten rounds of two 32x32 -> 64 bit products. */
#include "lobe/random.h"

static lobe_random4 philox_round(lobe_random4 c, uint32_t key0, uint32_t key1) {
    uint64_t p0 = (uint64_t)0xD2511F53u * c.word[0];
    uint64_t p1 = (uint64_t)0xCD9E8D57u * c.word[2];
    lobe_random4 r = {{(uint32_t)(p1 >> 32) ^ c.word[1] ^ key0, (uint32_t)p1,
                       (uint32_t)(p0 >> 32) ^ c.word[3] ^ key1, (uint32_t)p0}};
    return r;
}

lobe_random4 lobe_random(uint64_t seed, uint64_t stream, uint64_t counter) {
    uint32_t key0 = (uint32_t)seed;
    uint32_t key1 = (uint32_t)(seed >> 32);
    lobe_random4 c = {
        {(uint32_t)counter, (uint32_t)(counter >> 32), (uint32_t)stream, (uint32_t)(stream >> 32)}};
    for (int round = 0; round < 10; ++round) {
        c = philox_round(c, key0, key1);
        key0 += 0x9E3779B9u; /* golden ratio and sqrt(3) - 1: the published key schedule */
        key1 += 0xBB67AE85u;
    }
    return c;
}

/* Several counters side by side, in the form that compilers turn into vectors. */
enum { LANES = 8 };

typedef struct philox_lanes {
    uint32_t word[4][LANES];
} philox_lanes;

static void round_of_lanes(philox_lanes *c, uint32_t key0, uint32_t key1) {
    for (int i = 0; i < LANES; ++i) {
        uint64_t p0 = (uint64_t)0xD2511F53u * c->word[0][i];
        uint64_t p1 = (uint64_t)0xCD9E8D57u * c->word[2][i];
        c->word[0][i] = (uint32_t)(p1 >> 32) ^ c->word[1][i] ^ key0;
        c->word[1][i] = (uint32_t)p1;
        c->word[2][i] = (uint32_t)(p0 >> 32) ^ c->word[3][i] ^ key1;
        c->word[3][i] = (uint32_t)p0;
    }
}

static void fill_lanes(uint64_t seed, uint64_t stream, uint64_t first, lobe_random4 *blocks) {
    philox_lanes c;
    for (int i = 0; i < LANES; ++i) {
        uint64_t counter = first + (uint64_t)i;
        c.word[0][i] = (uint32_t)counter;
        c.word[1][i] = (uint32_t)(counter >> 32);
        c.word[2][i] = (uint32_t)stream;
        c.word[3][i] = (uint32_t)(stream >> 32);
    }
    uint32_t key0 = (uint32_t)seed;
    uint32_t key1 = (uint32_t)(seed >> 32);
    for (int round = 0; round < 10; ++round) {
        round_of_lanes(&c, key0, key1);
        key0 += 0x9E3779B9u;
        key1 += 0xBB67AE85u;
    }
    for (int i = 0; i < LANES; ++i) {
        for (int k = 0; k < 4; ++k) blocks[i].word[k] = c.word[k][i];
    }
}

void lobe_random_many(uint64_t seed, uint64_t stream, uint64_t first, uint32_t count,
                      lobe_random4 *blocks) {
    uint32_t done = 0;
    for (; count - done >= LANES; done += LANES) {
        fill_lanes(seed, stream, first + done, blocks + done);
    }
    for (; done < count; ++done) blocks[done] = lobe_random(seed, stream, first + done);
}

float lobe_random_unit_f32(uint32_t word) {
    return (float)(word >> 8) * 0x1p-24f;
}

double lobe_random_unit_f64(uint32_t high, uint32_t low) {
    return (double)((((uint64_t)high << 32) | low) >> 11) * 0x1p-53;
}
