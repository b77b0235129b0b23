/* The variance of one draw in a white furnace: of the weight, a rejected draw counted as 0. */
#include <math.h>

#include "sweep.h"

static double variance(const run *r, const lobe_reflection_f64 *model, uint64_t samples) {
    double sum = 0, squares = 0;
    for (uint64_t k = 0; k < samples && !lobe_run_is_over(r, k); k++) {
        double u[3];
        lobe_sweep_numbers(k, samples, u);
        const double weight = lobe_reflection_sample_f64(model, u[0], u[1], u[2]).weight;
        sum += weight;
        squares += weight * weight;
    }
    const double mean = sum / (double)samples;
    return fmax(squares / (double)samples - mean * mean, 0);
}

lobe_figure_result lobe_figure_variance(run *r) {
    return lobe_figure_sweep(r, (sweep){variance,
                                        "furnace variance of a draw",
                                        "variance",
                                        {NULL, 1e-4, 1, SCALE_LOG},
                                        5,
                                        1024});
}
