/* lobe/random.h: counter-based random numbers: Philox4x32-10 (Salmon et al. 2011).
 *
 * Stateless: the same (seed, stream, counter) gives the same four words on every machine, so any
 * part of a long sequence can be made anywhere, by any thread. */
#ifndef LOBE_RANDOM_H
#define LOBE_RANDOM_H

#include "types.h"

LOBE_BEGIN_C

typedef struct lobe_random4 {
    uint32_t word[4];
} lobe_random4;

/* Four independent uniform words: key = seed, counter = (counter, stream). */
LOBE_API lobe_random4 lobe_random(uint64_t seed, uint64_t stream, uint64_t counter);

/* Blocks first, first + 1, ... first + count - 1 of the same sequence, at about half the time each. */
LOBE_API void lobe_random_many(uint64_t seed, uint64_t stream, uint64_t first, uint32_t count,
                               lobe_random4 *blocks);

/* Words to numbers in [0, 1): the top 24 bits, or 53 bits of two words. */
LOBE_API float lobe_random_unit_f32(uint32_t word);
LOBE_API double lobe_random_unit_f64(uint32_t high, uint32_t low);

LOBE_END_C

#endif
