/* What the random numbers of a frame are made of: hashes of the seed, and how far all of them shift. */
#include <math.h>

#include "lobe/random.h"
#include "pipeline.h"

static uint32_t turns(double x) {
    return (uint32_t)((x - floor(x)) * 0x1p32);
}

ssr_noise_keys lobe_ssr_noise_keys(uint64_t seed, uint64_t frame) {
    const lobe_random4 key = lobe_random(seed, 0, 0);
    const double n = (double)frame;
    /* powers of 1/1.32471795724…, the root of x^3 = x + 1: an even spread in two dimensions */
    return (ssr_noise_keys){.order = key.word[0],
                            .first = key.word[1],
                            .second = key.word[2],
                            .third = lobe_random(seed, 1 + frame, 0).word[0],
                            .shift_first = turns(n * 0.7548776662466927),
                            .shift_second = turns(n * 0.5698402909980532)};
}
