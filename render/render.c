/* The loop over passes, tiles, pixels and samples. A pixel belongs to one thread at a time and its
 * samples come in order, so the bits do not depend on the number of threads. */

#include <omp.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "integrator.h"

enum { TILE = 16, FILTER_STEPS = 256 };

static const struct {
    lobe_heuristic value;
    const char *name;
} heuristics[] = {{LOBE_HEURISTIC_BALANCE, "balance"},
                  {LOBE_HEURISTIC_POWER, "power"},
                  {LOBE_HEURISTIC_BSDF_ONLY, "bsdf-only"},
                  {LOBE_HEURISTIC_LIGHT_ONLY, "light-only"}};

lobe_heuristic lobe_heuristic_from_name(const char *name, int *known) {
    for (size_t i = 0; i < sizeof heuristics / sizeof *heuristics; i++)
        if (strcmp(heuristics[i].name, name) == 0) {
            *known = 1;
            return heuristics[i].value;
        }
    *known = 0;
    return LOBE_HEURISTIC_POWER;
}

const char *lobe_heuristic_name(lobe_heuristic heuristic) {
    return (unsigned)heuristic < 4u ? heuristics[heuristic].name : NULL;
}

lobe_render_options lobe_render_default_options(void) {
    lobe_reflection_options reflection = lobe_reflection_default_options();
    reflection.model.method = LOBE_METHOD_COUNT; /* by surface: render/material.c */
    return (lobe_render_options){.reflection = reflection,
                                 .width = 960,
                                 .height = 540,
                                 .samples = 64,
                                 .depth = 8,
                                 .roulette_depth = 5,
                                 .heuristic = LOBE_HEURISTIC_BALANCE};
}

/* What the threads share. */
typedef struct job {
    const lobe_scene *scene;
    const lobe_render_options *options;
    integrator integrator;
    lobe_film *film;
    vec3 eye, forward, right, up; /* right and up reach to the edge of the picture */
    float filter[FILTER_STEPS + 1];
    double start;
    uint64_t rays;
    uint32_t done; /* samples a pixel of all finished passes */
} job;

static double now(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Inverse distribution of the Blackman-Harris window (Harris 1978), 3 pixels wide: pixels are filtered
 * by drawing from it, so every sample weighs the same. */
static void make_filter(float table[FILTER_STEPS + 1]) {
    enum { CELLS = 4096 };
    const double width = 3.0;
    double sum[CELLS + 1] = {0.0};
    for (int i = 0; i < CELLS; i++) {
        double t = 6.283185307179586 * (i + 0.5) / CELLS;
        sum[i + 1] =
            sum[i] + 0.35875 - 0.48829 * cos(t) + 0.14128 * cos(2 * t) - 0.01168 * cos(3 * t);
    }
    for (int k = 0, i = 0; k <= FILTER_STEPS; k++) {
        double target = sum[CELLS] * k / FILTER_STEPS;
        while (i < CELLS && sum[i + 1] < target) i++;
        double share = i < CELLS ? (target - sum[i]) / (sum[i + 1] - sum[i]) : 0.0;
        table[k] = (float)(width * ((i + share) / CELLS - 0.5));
    }
}

static float filter_offset(const job *j, uint32_t bits) {
    float x = sampler_unit(bits) * FILTER_STEPS;
    int k = (int)x;
    return j->filter[k] + (x - (float)k) * (j->filter[k + 1] - j->filter[k]);
}

static void render_sample(const job *j, int x, int y, uint32_t index, uint64_t *rays) {
    const lobe_render_options *o = j->options;
    sampler points = {.key = lobe_sampler_key(o->seed, (uint32_t)x, (uint32_t)y),
                      .index = index,
                      .index_bits = lobe_sampler_index_bits(o->samples)};
    sampler_point p = lobe_sampler_next(&points);
    float px = ((float)x + 0.5f + filter_offset(j, p.bits[0])) / (float)o->width * 2.0f - 1.0f;
    float py = 1.0f - ((float)y + 0.5f + filter_offset(j, p.bits[1])) / (float)o->height * 2.0f;
    vec3 d = v3_add(j->forward, v3_add(v3_scale(j->right, px), v3_scale(j->up, py)));
    film_sample sample =
        lobe_trace_path(&j->integrator, j->eye, v3_normalize_or(d, j->forward), &points, rays);
    lobe_film_add(j->film, (size_t)y * (size_t)o->width + (size_t)x, &sample);
}

static int is_stopped(const job *j) {
    const lobe_render_options *o = j->options;
    if (o->cancel && *o->cancel) return 1;
    return o->time_limit > 0.0 && now(CLOCK_MONOTONIC) - j->start > o->time_limit;
}

static void render_tile(const job *j, int tile, uint32_t first, uint32_t count, uint64_t *rays) {
    const lobe_render_options *o = j->options;
    int across = (o->width + TILE - 1) / TILE;
    int left = tile % across * TILE, top = tile / across * TILE;
    for (int y = top; y < top + TILE && y < o->height; y++)
        for (int x = left; x < left + TILE && x < o->width; x++)
            for (uint32_t i = first; i < first + count; i++) render_sample(j, x, y, i, rays);
}

static void show_progress(const job *j, double fraction) {
    if (!j->options->progress || omp_get_thread_num() != 0) return;
    double seconds = now(CLOCK_MONOTONIC) - j->start;
    lobe_render_progress p = {.fraction = fraction,
                              .seconds = seconds,
                              .seconds_left =
                                  fraction > 0.0 ? seconds * (1.0 - fraction) / fraction : -1.0,
                              .samples = (uint64_t)(fraction * j->options->samples *
                                                    (double)j->options->width * j->options->height),
                              .pixel_samples = j->done};
    j->options->progress(j->options->progress_user, &p);
}

/* `count` samples for every pixel; 0: stopped before all tiles had theirs. */
static int render_pass(job *j, uint32_t count, int threads) {
    const lobe_render_options *o = j->options;
    int tiles = ((o->width + TILE - 1) / TILE) * ((o->height + TILE - 1) / TILE);
    int finished = 0, stopped = 0;
    uint64_t rays = 0;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) reduction(+ : rays)
    for (int tile = 0; tile < tiles; tile++) {
        int skip;
#pragma omp atomic read
        skip = stopped;
        if (skip) continue;
        if (is_stopped(j)) {
#pragma omp atomic write
            stopped = 1;
            continue;
        }
        render_tile(j, tile, j->done, count, &rays);
        int now_finished;
#pragma omp atomic capture
        now_finished = ++finished;
        show_progress(j, (j->done + (double)count * now_finished / tiles) / o->samples);
    }
    j->rays += rays;
    if (finished == tiles) j->done += count;
    return finished == tiles;
}

static lobe_render_result aim(job *j) {
    const lobe_render_options *o = j->options;
    const camera *c = &j->scene->cameras[0];
    if (o->camera) {
        uint32_t i = 0;
        while (i < j->scene->camera_count && strcmp(j->scene->cameras[i].name, o->camera) != 0) i++;
        if (i == j->scene->camera_count)
            return lobe_fail(LOBE_RENDER_BAD_INPUT,
                             "%s: no camera named %s; without a name the first one is taken",
                             j->scene->name, o->camera);
        c = &j->scene->cameras[i];
    }
    float height = tanf(0.5f * c->vertical_degrees * (LOBE_PI / 180.0f));
    j->eye = c->position;
    j->forward = v3_normalize_or(v3_sub(c->target, c->position), v3(0.0f, 0.0f, -1.0f));
    vec3 right = v3_normalize_or(v3_cross(j->forward, c->up), v3_across(j->forward));
    j->right = v3_scale(right, height * (float)o->width / (float)o->height);
    j->up = v3_scale(v3_cross(right, j->forward), height);
    return LOBE_RENDER_OK;
}

const char *lobe_render_method_name(lobe_method method) {
    return method == LOBE_METHOD_COUNT ? "by surface" : lobe_method_name(method);
}

static lobe_method method_or_best(lobe_model model) {
    return model.method == LOBE_METHOD_COUNT ? lobe_best_method(model.ndf, model.masking)
                                             : model.method;
}

static int is_offered(lobe_model model) {
    model.method = method_or_best(model);
    return lobe_model_exists(model);
}

static lobe_render_result check_options(const lobe_render_options *o) {
    if (o->width < 1 || o->height < 1 || o->width > LOBE_RENDER_SIZE_MAX ||
        o->height > LOBE_RENDER_SIZE_MAX)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "size: %d x %d is out of range; use 1 to %d",
                         o->width, o->height, LOBE_RENDER_SIZE_MAX);
    if (o->samples < 1 || o->samples > LOBE_RENDER_SAMPLES_MAX)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "samples: %u is out of range; use 1 to %d",
                         o->samples, LOBE_RENDER_SAMPLES_MAX);
    if (o->depth < 0 || o->depth > 1000000)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "depth: %d is out of range; use 0 to 1000000",
                         o->depth);
    if (o->threads < 0 || o->threads > 1024)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "threads: %d is out of range; use 0 to 1024",
                         o->threads);
    const lobe_model model = o->reflection.model;
    if (o->multiscatter == LOBE_MULTISCATTER_WALK &&
        (model.masking != LOBE_MASKING_SMITH || o->reflection.g2 != LOBE_G2_CORRELATED))
        return lobe_fail(
            LOBE_RENDER_BAD_INPUT,
            "multiscatter: walks are known for --masking smith --g2 correlated only; use "
            "another");
    if (!is_offered(model) || (unsigned)o->multiscatter > LOBE_MULTISCATTER_WALK ||
        !(o->reflection.floor >= 0.0 && o->reflection.floor <= 1.0) ||
        (unsigned)o->heuristic >= 4u || !(o->time_limit >= 0.0))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "options: a value is out of range; see lobe/render.h");
    return LOBE_RENDER_OK;
}

static void fill_statistics(const job *j, double cpu, int threads, lobe_render_statistics *st) {
    *st =
        (lobe_render_statistics){.rays = j->rays, .threads = threads, .pixel_samples = UINT32_MAX};
    for (size_t i = 0; i < (size_t)j->options->width * (size_t)j->options->height; i++) {
        const film_pixel *p = &j->film->pixels[i];
        st->samples += p->samples + p->dropped;
        st->dropped_samples += p->dropped;
        st->ggx_draws += p->draws;
        st->ggx_rejected += p->rejected;
        uint32_t samples = p->samples + p->dropped;
        if (samples < st->pixel_samples) st->pixel_samples = samples;
    }
    if (st->ggx_draws) st->rejected_share = (double)st->ggx_rejected / (double)st->ggx_draws;
    st->seconds = now(CLOCK_MONOTONIC) - j->start;
    st->cpu_seconds = now(CLOCK_PROCESS_CPUTIME_ID) - cpu;
}

/* Passes double, so that an interrupted picture is a whole one and few pixels are ahead. */
static int render_passes(job *j, int threads) {
    while (j->done < j->options->samples) {
        uint32_t left = j->options->samples - j->done;
        uint32_t count = j->done == 0 ? 1 : j->done < 16 ? j->done : 16;
        if (!render_pass(j, count < left ? count : left, threads)) return 0;
    }
    return 1;
}

static void keep_metadata(job *j, double seconds) {
    film_metadata *m = &j->film->metadata;
    memcpy(m->scene, j->scene->name, sizeof m->scene);
    const char *method = lobe_render_method_name(j->options->reflection.model.method);
    memcpy(m->method, method, strlen(method) + 1);
    m->samples = j->done;
    m->seed = j->options->seed;
    m->seconds = seconds;
    m->is_rendered = 1;
}

/* A file with very many indices gets the nearest ones. */
const coat_table **lobe_find_coats(const lobe_scene *s, const lobe_reflection_options *o) {
    enum { INDICES_MAX = 64 };
    const coat_table *known[INDICES_MAX], **coats = malloc((s->material_count + 1) * sizeof *coats);
    int count = 0;
    for (uint32_t i = 0; coats && i <= s->material_count; i++) {
        const float ior = i < s->material_count ? s->materials[i].ior : COAT_IOR;
        int nearest = 0;
        for (int k = 1; k < count; k++)
            if (fabsf(known[k]->ior - ior) < fabsf(known[nearest]->ior - ior)) nearest = k;
        if (count < INDICES_MAX && (count == 0 || known[nearest]->ior != ior)) {
            nearest = count++;
            known[nearest] =
                lobe_coat_table(o->model.ndf, o->model.masking, o->g2, ior, s->has_anisotropy);
        }
        coats[i] = known[nearest];
        if (coats[i]) continue;
        free(coats);
        coats = NULL;
    }
    return coats;
}

static lobe_render_result render_with(const coat_table *const *coats, const lobe_scene *scene,
                                      const lobe_render_options *options, lobe_film **film,
                                      lobe_render_statistics *statistics) {
    job j = {.scene = scene, .options = options, .start = now(CLOCK_MONOTONIC)};
    double cpu = now(CLOCK_PROCESS_CPUTIME_ID);
    j.integrator = (integrator){
        scene,          {.ggx = options->reflection, .multiscatter = options->multiscatter},
        coats,          options->heuristic,
        options->depth, options->roulette_depth};
    lobe_render_result result = aim(&j);
    if (result != LOBE_RENDER_OK) return result;
    make_filter(j.filter);
    j.film = lobe_film_create(options->width, options->height, options->aovs);
    if (!j.film) return lobe_fail_memory("film");
    int threads = options->threads ? options->threads : omp_get_max_threads();
    int finished = render_passes(&j, threads);
    lobe_render_statistics own;
    fill_statistics(&j, cpu, threads, statistics ? statistics : &own);
    keep_metadata(&j, now(CLOCK_MONOTONIC) - j.start);
    *film = j.film;
    int cancelled = !finished && options->cancel && *options->cancel;
    return cancelled ? LOBE_RENDER_INTERRUPTED : LOBE_RENDER_OK;
}

lobe_render_result lobe_render(const lobe_scene *scene, lobe_render_options options,
                               lobe_film **film, lobe_render_statistics *statistics) {
    *film = NULL;
    lobe_render_result result = check_options(&options);
    if (result != LOBE_RENDER_OK) return result;
    lobe_model model = options.reflection.model;
    /* the choice by surface is known for Smith-GGX; else the best method is one for all */
    if (model.ndf != LOBE_NDF_GGX || model.masking != LOBE_MASKING_SMITH)
        options.reflection.model.method = method_or_best(model);
    const coat_table **coats = lobe_find_coats(scene, &options.reflection);
    if (!coats) return lobe_fail_memory(scene->name);
    result = render_with(coats, scene, &options, film, statistics);
    free(coats);
    return result;
}
