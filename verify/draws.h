/* Random numbers, draws and values, many at a time. */
#ifndef LOBE_VERIFY_DRAWS_H
#define LOBE_VERIFY_DRAWS_H

#include <math.h>

#include "engine.h"

/* The index-th random numbers of the settings' seed and stream, as the model takes them. */
void lobe_random_numbers(const lobe_verify_model *model, const lobe_settings *settings,
                         uint64_t index, double u[3]);

/* The same from `first` on, three numbers each. */
void lobe_many_random_numbers(const lobe_verify_model *model, const lobe_settings *settings,
                              uint64_t first, size_t count, double *u);

void lobe_draw_many(const lobe_verify_model *model, const lobe_verify_state *state, size_t count,
                    const double *u, lobe_verify_draw *draws);

/* Of `count` directions, three numbers each. */
void lobe_evaluate_many(const lobe_verify_model *model, const lobe_verify_state *state,
                        size_t count, const double *wo, double *density, double *value);

/* Whether a draw keeps what every model promises: finite, not negative, no weight without a
 * density. */
static inline int lobe_draw_is_sound(const lobe_verify_draw *draw) {
    double sum = draw->wo[0] + draw->wo[1] + draw->wo[2];
    int is_finite = sum - sum == 0 && draw->pdf < INFINITY && draw->weight < INFINITY;
    return is_finite && draw->pdf >= 0 && draw->weight >= 0 && (draw->pdf > 0 || draw->weight == 0);
}

#endif
