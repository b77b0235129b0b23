/* The share of draws whose reflection does not leave the surface. */
#include "sweep.h"

/* Closed where the library knows it, else counted. */
static double rejected(const run *r, const lobe_reflection_f64 *model, uint64_t samples) {
    const double accepted = lobe_reflection_acceptance_f64(model);
    if (accepted >= 0) return 1 - accepted;
    uint64_t count = 0;
    for (uint64_t k = 0; k < samples && !lobe_run_is_over(r, k); k++) {
        double u[3];
        lobe_sweep_numbers(k, samples, u);
        count += lobe_reflection_sample_f64(model, u[0], u[1], u[2]).pdf > 0 ? 0 : 1;
    }
    return (double)count / (double)samples;
}

lobe_figure_result lobe_figure_rejections(run *r) {
    return lobe_figure_sweep(
        r, (sweep){rejected, "share rejected", "rejected", {NULL, 0, 0.5, SCALE_LINEAR}, 4, 1024});
}
