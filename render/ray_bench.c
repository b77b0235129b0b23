#include "lobe/ray_bench.h"

#include <omp.h>
#include <stdlib.h>

#include "crew.h"
#include "message.h"
#include "ray_log.h"
#include "scene.h"

/* What the rounds measured. */
typedef struct rounds {
    int count;
    double *render_cpu, *raw_cpu, *ratio, *seconds, *raw_seconds; /* one allocation, owned */
} rounds;

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts. */
static double median(double *values, int count) {
    qsort(values, (size_t)count, sizeof *values, compare);
    return values[count / 2];
}

/* All rays once more; how many met something. */
static uint64_t replay(const lobe_scene *scene, const ray_log *log, int threads) {
    uint64_t hits = 0;
    const long units = (long)log->unit_count;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1) reduction(+ : hits)
    for (long u = 0; u < units; u++) {
        const logged_ray *rays;
        const size_t count = lobe_ray_log_unit(log, (size_t)u, &rays);
        hits += lobe_tracer_replay(scene->tracer, rays, count);
    }
    return hits;
}

static lobe_render_result render_round(const lobe_scene *scene, const lobe_render_options *o,
                                       rounds *r, int round) {
    lobe_film *film = NULL;
    lobe_render_statistics st;
    const lobe_render_result result = lobe_render(scene, *o, &film, &st);
    lobe_film_free(film);
    r->render_cpu[round] = st.cpu_seconds;
    r->seconds[round] = st.seconds;
    return result;
}

static uint64_t raw_round(const lobe_scene *scene, const ray_log *log, int threads, rounds *r,
                          int round) {
    const double start = lobe_clock(), cpu = lobe_cpu_clock();
    const uint64_t hits = replay(scene, log, threads);
    r->raw_cpu[round] = lobe_cpu_clock() - cpu;
    r->raw_seconds[round] = lobe_clock() - start;
    r->ratio[round] = r->raw_cpu[round] / r->render_cpu[round];
    return hits;
}

static void fill(lobe_ray_bench *b, rounds *r, const ray_log *log) {
    const double rays = (double)log->count;
    const double render_cpu = median(r->render_cpu, r->count);
    b->camera_rays = log->of_kind[RAY_CAMERA];
    b->bounce_rays = log->of_kind[RAY_BOUNCE];
    b->shadow_rays = log->of_kind[RAY_SHADOW];
    b->samples_per_cpu_second = (double)b->samples / render_cpu;
    b->rays_per_cpu_second = rays / render_cpu;
    b->raw_rays_per_cpu_second = rays / median(r->raw_cpu, r->count);
    b->ratio = median(r->ratio, r->count);
    b->spread = (r->ratio[3 * r->count / 4] - r->ratio[r->count / 4]) / b->ratio;
    b->seconds = median(r->seconds, r->count);
    b->raw_seconds = median(r->raw_seconds, r->count);
}

static lobe_render_result measure(const lobe_scene *scene, const lobe_ray_bench_options *options,
                                  const lobe_render_options *o, const ray_log *log, rounds *r,
                                  lobe_ray_bench *b) {
    for (int round = 0; round < r->count; round++) {
        const lobe_render_result result = render_round(scene, o, r, round);
        if (result != LOBE_RENDER_OK) return result;
        b->hits = raw_round(scene, log, b->threads, r, round);
        if (options->on_progress)
            options->on_progress(options->user, (round + 1.0) / (double)r->count);
    }
    fill(b, r, log);
    return LOBE_RENDER_OK;
}

static lobe_render_options only_the_picture(const lobe_render_options *from) {
    lobe_render_options o = *from;
    const lobe_render_options none = lobe_render_default_options();
    o.aovs = none.aovs;
    o.progress = none.progress;
    o.noise = none.noise;
    o.time_limit = none.time_limit;
    o.checkpoint = o.resume = NULL;
    o.part = o.parts = 1;
    return o;
}

static lobe_render_result note_rays(const lobe_scene *scene, const lobe_render_options *o,
                                    ray_log *log, lobe_ray_bench *b) {
    lobe_render_statistics st;
    const lobe_render_result result = lobe_render_logged(scene, *o, log, &st);
    if (result != LOBE_RENDER_OK) return result;
    b->samples = st.samples;
    return log->out_of_memory ? lobe_fail_memory("rays; take a smaller --size or --spp")
                              : LOBE_RENDER_OK;
}

lobe_render_result lobe_ray_bench_run(const lobe_scene *scene,
                                      const lobe_ray_bench_options *options,
                                      lobe_ray_bench *result) {
    const lobe_render_options o = only_the_picture(&options->render);
    *result = (lobe_ray_bench){.threads = o.threads > 0 ? o.threads : omp_get_max_threads()};
    if (options->rounds < 1)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "rounds: %d; give at least 1", options->rounds);
    const size_t n = (size_t)options->rounds;
    double *times = calloc(n, 5 * sizeof *times);
    if (!times) return lobe_fail_memory("rounds");
    rounds r = {options->rounds, times, times + n, times + 2 * n, times + 3 * n, times + 4 * n};
    ray_log log = {0};
    lobe_render_result done = note_rays(scene, &o, &log, result);
    if (done == LOBE_RENDER_OK) done = measure(scene, options, &o, &log, &r, result);
    lobe_ray_log_free(&log);
    free(times);
    return done;
}
