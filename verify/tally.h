/* Counting draws: the same result for any number of threads. */
#ifndef LOBE_VERIFY_TALLY_H
#define LOBE_VERIFY_TALLY_H

#include "bins.h"
#include "engine.h"

typedef struct lobe_tally {
    uint64_t *counts;  /* a bin each, and the rejected draws last */
    double weight_sum; /* of weights cut to bins->cut */
    uint64_t draws;
    uint64_t unsound; /* draws that break a promise: NaN, infinite, negative */
} lobe_tally;

/* Returns 0 without memory. After a cancellation the tally is incomplete. */
int lobe_tally_make(lobe_tally *tally, const lobe_verify_model *model, const lobe_bins *bins,
                    const lobe_settings *settings, lobe_monitor *monitor);
void lobe_tally_free(lobe_tally *tally);

#endif
