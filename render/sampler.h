/* Points of the integrator: Sobol sequence of four dimensions, Owen-scrambled by hashing (Laine &
 * Karras 2011, Burley 2020), padded: every group of four dimensions has its own scrambling and its
 * own shuffling of the indices, so that groups are independent and each group stays stratified.
 *
 * Stateless but for the number of the next group: the points depend on (seed, pixel, index, group)
 * only, hence not on the order in which pixels are rendered. */
#ifndef LOBE_RENDER_SAMPLER_H
#define LOBE_RENDER_SAMPLER_H

#include <stdint.h>

typedef struct sampler {
    uint32_t key;        /* of the pixel */
    uint32_t index;      /* of the sample in the pixel */
    uint32_t index_bits; /* enough for every index of the pixel */
    uint32_t group;      /* next one */
} sampler;

typedef struct sampler_point {
    uint32_t bits[4]; /* uniform words */
} sampler_point;

/* `samples`: number of points a pixel, at least 1. */
uint32_t lobe_sampler_index_bits(uint32_t samples);
uint32_t lobe_sampler_key(uint64_t seed, uint32_t x, uint32_t y);

/* The same for points that are independent of those of other rounds; round 0: that of lobe_sampler_key. */
uint32_t lobe_sampler_round_key(uint64_t seed, uint32_t x, uint32_t y, uint32_t round);

/* The next four dimensions. */
sampler_point lobe_sampler_next(sampler *s);

/* Word to [0, 1). */
static inline float sampler_unit(uint32_t bits) {
    return (float)(bits >> 8) * 0x1p-24f;
}

#endif
