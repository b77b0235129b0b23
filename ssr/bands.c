/* Bands of rows, by the instruction set that the library has chosen, over threads. */
#include "bands.h"

#include "lobe/batch.h"

typedef void band_pass(const ssr_band *b);

typedef struct band_passes {
    const char *isa;
    void (*trace)(const ssr_band *b, ssr_counts *counts);
    band_pass *reproject, *resolve, *accumulate, *keep_z, *composite;
} band_passes;

/* Those of the set in use; the plainest for a set that has none of its own. */
static const band_passes *passes_in_use(void) {
    static const band_passes all[] = {
#define SSR_PASSES(set, name)                                                                      \
    {name,                                                                                         \
     lobe_ssr_trace_##set,                                                                         \
     lobe_ssr_reproject_##set,                                                                     \
     lobe_ssr_resolve_##set,                                                                       \
     lobe_ssr_accumulate_##set,                                                                    \
     lobe_ssr_keep_z_##set,                                                                        \
     lobe_ssr_composite_##set},
        SSR_SETS(SSR_PASSES)
#undef SSR_PASSES
    };
    const char *isa = lobe_isa();
    for (size_t i = 1; i < sizeof all / sizeof *all; i++)
        if (strcmp(all[i].isa, isa) == 0) return &all[i];
    return &all[0];
}

enum { BAND_ROWS = 8 };

static ssr_band band_at(lobe_ssr *s, const lobe_ssr_frame *f, int first) {
    const int end = first + BAND_ROWS;
    return (ssr_band){s, f, first, end < s->height ? end : s->height};
}

void lobe_ssr_pass_trace(lobe_ssr *s, const lobe_ssr_frame *f, lobe_ssr_statistics *statistics) {
    const band_passes *passes = passes_in_use();
    uint64_t rays = 0, rejected = 0, hits = 0, steps = 0;
    s->noise = lobe_ssr_noise_keys(s->options.seed, s->frame);
#pragma omp parallel for schedule(dynamic, 1) num_threads(s->threads)                              \
    reduction(+ : rays, rejected, hits, steps)
    for (int y = 0; y < s->height; y += BAND_ROWS) {
        const ssr_band band = band_at(s, f, y);
        ssr_counts counts = {0};
        passes->trace(&band, &counts);
        rays += counts.rays;
        rejected += counts.rejected;
        hits += counts.hits;
        steps += counts.steps;
    }
    statistics->rays = rays;
    statistics->rejected = rejected;
    statistics->hits = hits;
    statistics->steps = steps;
}

static void run_bands(lobe_ssr *s, const lobe_ssr_frame *f, band_pass *pass) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(s->threads)
    for (int y = 0; y < s->height; y += BAND_ROWS) {
        const ssr_band band = band_at(s, f, y);
        pass(&band);
    }
}

void lobe_ssr_pass_reproject(lobe_ssr *s, const lobe_ssr_frame *f) {
    run_bands(s, f, passes_in_use()->reproject);
}

void lobe_ssr_pass_resolve(lobe_ssr *s, const lobe_ssr_frame *f) {
    run_bands(s, f, passes_in_use()->resolve);
}

void lobe_ssr_pass_accumulate(lobe_ssr *s, const lobe_ssr_frame *f) {
    float *swapped = s->history; /* what was the reflection is history now */
    s->history = s->reflection;
    s->reflection = swapped;
    run_bands(s, f, passes_in_use()->accumulate);
    run_bands(s, f, passes_in_use()->keep_z);
}

void lobe_ssr_pass_composite(lobe_ssr *s, const lobe_ssr_frame *f) {
    run_bands(s, f, passes_in_use()->composite);
}
