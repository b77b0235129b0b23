/* Adaptive sampling: where noise is, more samples go, and the mean stays what it is.
 *
 * The picture goes in rounds. In a round r every pixel has a weight b(r), the same for all and known before the first
 * sample; a tile (16 x 16 pixels) has n samples a pixel, each of weight b(r)/n. n is chosen from the rounds before, and the
 * samples of a round are independent of those: their mean has the right expectation, whatever n is. The picture is the
 * mean of the rounds by b, so its expectation is right too. No sample has a say in its own weight. Weighing all samples
 * of a pixel alike, and stopping where they happen to agree, is biased (Kirk and Arvo 1991); weights that are known
 * before the values, as in Owen and Zhou 2020 (The square root rule for adaptive importance sampling), are not.
 *
 * For a sum of n(t) that is given, the mean square error is least for n(t) in proportion to the standard deviation s(t)
 * of one sample. A quarter of each round goes evenly to all tiles, so that noise that was not seen yet is found; no
 * tile gets more than 16 times the mean. s(t) is relative, as lobe_render_statistics.noise is, and told from the halves of
 * the samples so far. */
#ifndef LOBE_RENDER_ADAPTIVE_H
#define LOBE_RENDER_ADAPTIVE_H

#include "film.h"
#include "schedule.h"

enum { ADAPTIVE_SAMPLES_MIN = 64, ADAPTIVE_HALF_BLOCK = ROUND_STEP / 2 };

/* Plan the first round of an empty film. 0: no memory. */
int lobe_adaptive_begin(lobe_film *film, uint32_t samples);

/* Samples a pixel of the rounds before `round`, in the mean; `samples`: of all rounds. */
uint32_t lobe_adaptive_before(uint32_t round, uint32_t samples);

/* Plan the next round of a film whose rounds are finished; 0: there is none. */
int lobe_adaptive_plan(lobe_film *film, uint32_t samples);

/* Let the schedule go on where the film is, which has a plan. */
void lobe_adaptive_schedule(const lobe_film *film, uint32_t samples, schedule *s);

/* Whether the numbers of the tiles can be those of a film with a plan. */
int lobe_adaptive_is_sane(const lobe_film *film, uint32_t samples);

#endif
