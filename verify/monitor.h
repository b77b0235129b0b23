/* Progress and cancellation, shared by all threads of a run. */
#ifndef LOBE_VERIFY_MONITOR_H
#define LOBE_VERIFY_MONITOR_H

#include <stdatomic.h>
#include <stdint.h>

typedef struct lobe_monitor {
    int (*on_progress)(void *user, double share); /* other than 0: cancel */
    void *user;
    double total_draws;
    atomic_uint_fast64_t draws;
    atomic_int is_cancelled;
} lobe_monitor;

/* Adds draws, reports, and returns whether to go on. */
int lobe_monitor_advance(lobe_monitor *monitor, uint64_t draws);

#endif
