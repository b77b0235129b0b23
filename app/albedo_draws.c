#include "albedo_draws.h"

#include <lobe/batch.h>

#include "interrupt.h"

enum { ROWS = 4096 };

/* Adds up a batch of draws. */
static void add_rows(const lobe_reflection_f64 *model, const lobe_app_draws *draws, uint64_t first,
                     size_t rows, const lobe_reflectance *laws, int count, double *e,
                     double *by_law) {
    double weight[ROWS], cos_im[ROWS];
    const lobe_sample_batch_f64 batch = {.count = rows,
                                         .prepared = model,
                                         .seed = draws->seed,
                                         .offset = first,
                                         .cos_im = {cos_im, 1},
                                         .weight = {weight, 1}};
    lobe_reflection_sample_batch_f64(&batch);
    for (size_t i = 0; i < rows; i++) {
        *e += weight[i];
        for (int k = 0; k < count; k++)
            by_law[k] += weight[i] * lobe_reflectance_at(laws[k], cos_im[i]);
    }
}

bool lobe_app_albedo_by_draws(const lobe_app_draws *draws, lobe_vec3_f64 wi,
                              const lobe_reflectance *laws, int count, double *e, double *by_law) {
    const lobe_reflection_f64 model = lobe_reflection_prepare_above_f64(
        draws->options, wi, draws->alpha[0], draws->alpha[1], draws->plane);
    if (!model.is_valid) return false;
    *e = 0;
    for (int k = 0; k < count; k++) by_law[k] = 0;
    for (uint64_t first = 0; first < draws->count; first += ROWS) {
        if (lobe_app_interrupted) return false;
        const uint64_t rest = draws->count - first;
        add_rows(&model, draws, first, rest < ROWS ? (size_t)rest : ROWS, laws, count, e, by_law);
    }
    *e /= (double)draws->count;
    for (int k = 0; k < count; k++) by_law[k] /= (double)draws->count;
    return true;
}
