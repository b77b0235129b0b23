#include "monitor.h"

#include <stddef.h>

int lobe_monitor_advance(lobe_monitor *monitor, uint64_t draws) {
    uint64_t done = atomic_fetch_add(&monitor->draws, draws) + draws;
    if (monitor->on_progress != NULL) {
#pragma omp critical(lobe_verify_callback)
        {
            double share = (double)done / monitor->total_draws;
            if (monitor->on_progress(monitor->user, share) != 0) {
                atomic_store(&monitor->is_cancelled, 1);
            }
        }
    }
    return !atomic_load(&monitor->is_cancelled);
}
