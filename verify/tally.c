#include "tally.h"

#include <math.h>
#include <stdlib.h>

#include <lobe/random.h>

/* Draws between two looks at the monitor. */
enum { CHUNK = 1 << 16, MOST_BLOCKS = 4096 };

void lobe_random_numbers(const lobe_verify_model *model, const lobe_settings *settings,
                         uint64_t index, double u[3]) {
    lobe_random4 r = lobe_random(settings->seed, settings->stream, index);
    if (model->random_bits == 24) {
        for (int k = 0; k < 3; ++k) u[k] = lobe_random_unit_f32(r.word[k]);
    } else {
        u[0] = lobe_random_unit_f64(r.word[0], r.word[1]);
        u[1] = lobe_random_unit_f64(r.word[2], r.word[3]);
        /* The 22 bits that the others leave: enough for a choice, and free. */
        u[2] = ((r.word[1] & 2047) * 2048.0 + (r.word[3] & 2047)) / 4194304.0;
    }
}

typedef struct source {
    const lobe_verify_model *model;
    const lobe_bins *bins;
    const lobe_settings *settings;
    lobe_verify_state state;
} source;

static double count_chunk(const source *s, uint64_t first, uint64_t end, uint64_t *counts) {
    const lobe_verify_chart *chart = &s->model->chart;
    double weight_sum = 0;
    for (uint64_t index = first; index < end; ++index) {
        double u[3];
        lobe_random_numbers(s->model, s->settings, index, u);
        lobe_verify_draw draw = s->model->sample(&s->state, u);
        size_t bin = s->bins->count;
        lobe_disk_point point;
        if (draw.pdf > 0 && chart->point(chart->self, draw.wo, &point)) {
            double t, a;
            lobe_square_from_disk(point, &t, &a);
            bin = lobe_bins_find(s->bins, t, a);
        }
        counts[bin] += 1;
        /* not fmin, which would hide a NaN */
        weight_sum += draw.weight > s->bins->cut ? s->bins->cut : draw.weight;
    }
    return weight_sum;
}

/* Counts add up exactly in any order; the sums of weights are kept by block and added in order. */
static int count_all(lobe_tally *tally, const source *s, double *sums, uint64_t blocks,
                     lobe_monitor *monitor) {
    int threads = s->settings->threads;
    size_t bins = s->bins->count + 1;
    uint64_t block = (tally->draws + blocks - 1) / blocks;
    int is_good = 1;
#pragma omp parallel num_threads(threads) if (threads > 1)
    {
        uint64_t *counts = calloc(bins, sizeof *counts);
        if (counts == NULL) {
#pragma omp atomic write
            is_good = 0;
        }
#pragma omp for schedule(dynamic, 1)
        for (uint64_t b = 0; b < blocks; ++b) {
            uint64_t end = b * block + block < tally->draws ? b * block + block : tally->draws;
            int goes_on = counts != NULL && !atomic_load(&monitor->is_cancelled);
            for (uint64_t i = b * block; i < end && goes_on; i += CHUNK) {
                uint64_t stop = end - i < CHUNK ? end : i + CHUNK;
                sums[b] += count_chunk(s, i, stop, counts);
                goes_on = lobe_monitor_advance(monitor, stop - i);
            }
        }
#pragma omp critical(lobe_verify_tally)
        for (size_t i = 0; i < bins && counts != NULL; ++i) tally->counts[i] += counts[i];
        free(counts);
    }
    return is_good;
}

int lobe_tally_make(lobe_tally *tally, const lobe_verify_model *model, const lobe_bins *bins,
                    const lobe_settings *settings, lobe_monitor *monitor) {
    source s = {.model = model, .bins = bins, .settings = settings};
    uint64_t draws = settings->draws;
    model->prepare(model->self, model->wi, &s.state);
    uint64_t blocks = (draws + CHUNK - 1) / CHUNK;
    if (blocks > MOST_BLOCKS) blocks = MOST_BLOCKS;
    double *sums = calloc(blocks, sizeof *sums);
    *tally = (lobe_tally){.counts = calloc(bins->count + 1, sizeof(uint64_t)), .draws = draws};
    int is_good =
        sums != NULL && tally->counts != NULL && count_all(tally, &s, sums, blocks, monitor);
    for (uint64_t b = 0; b < blocks && is_good; ++b) tally->weight_sum += sums[b];
    free(sums);
    if (!is_good) lobe_tally_free(tally);
    return is_good;
}

void lobe_tally_free(lobe_tally *tally) {
    free(tally->counts);
    *tally = (lobe_tally){0};
}
