#include "crew.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "adaptive.h"
#include "message.h"
#include "ranks.h"

static double read_clock(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double lobe_clock(void) {
    return read_clock(CLOCK_MONOTONIC);
}

double lobe_cpu_clock(void) {
    return read_clock(CLOCK_PROCESS_CPUTIME_ID);
}

static void nap(void) {
    nanosleep(&(struct timespec){.tv_nsec = 500000}, NULL);
}

static int is_cancelled(const crew *c) {
    return c->options->cancel && *c->options->cancel;
}

/* ---- One thread ------------------------------------------------------------------------------ */

static void work(crew *c, lobe_film *tile) {
    for (;;) {
        unit u;
        if (omp_get_thread_num() == 0) c->source.tend(c);
        omp_set_lock(&c->lock);
        const schedule_answer answer = c->source.next(c, &u);
        omp_unset_lock(&c->lock);
        if (answer == SCHEDULE_END) return;
        if (answer != SCHEDULE_UNIT) {
            nap();
            continue;
        }
        uint64_t rays = 0;
        lobe_film_clear(tile);
        c->render(c->user, &u, tile, &rays);
        omp_set_lock(&c->lock);
        c->source.deliver(c, &u, tile, rays);
        omp_unset_lock(&c->lock);
    }
}

int lobe_crew_work(crew *c, uint32_t aovs) {
    lobe_film **tiles = calloc((size_t)c->threads, sizeof(lobe_film *));
    int is_good = tiles != NULL;
    for (int i = 0; i < c->threads && is_good; i++)
        is_good = (tiles[i] = lobe_film_create(TILE, TILE, aovs)) != NULL;
    if (is_good) {
#pragma omp parallel num_threads(c->threads)
        work(c, tiles[omp_get_thread_num()]);
    }
    for (int i = 0; i < c->threads && tiles; i++) lobe_film_free(tiles[i]);
    free(tiles);
    return is_good;
}

/* ---- Units of this process's picture --------------------------------------------------------- */

static uint32_t tiles_across(const lobe_film *film) {
    return (uint32_t)(film->width + TILE - 1) / TILE;
}

static uint64_t pixels_of_tile(const lobe_film *film, uint32_t tile) {
    const int left = (int)(tile % tiles_across(film)) * TILE;
    const int top = (int)(tile / tiles_across(film)) * TILE;
    const int width = film->width - left, height = film->height - top;
    return (uint64_t)(width < TILE ? width : TILE) * (uint64_t)(height < TILE ? height : TILE);
}

/* Noise is looked at where every pixel has the same number of samples: then it does not depend on who rendered what
 * when. */
static int is_quiet(const crew *c) {
    return c->options->noise > 0.0 && lobe_film_noise(c->film) <= c->options->noise;
}

/* Of an adaptive picture; 0: there is none. */
static int begin_round(crew *c) {
    if (!c->film->tiles || !lobe_adaptive_plan(c->film, c->options->samples)) return 0;
    lobe_adaptive_schedule(c->film, c->options->samples, &c->schedule);
    return 1;
}

static schedule_answer next(crew *c, unit *u) {
    const lobe_render_options *o = c->options;
    if (is_cancelled(c)) c->is_stopped = c->is_cancelled = 1;
    if (o->time_limit > 0.0 && lobe_clock() - c->start > o->time_limit) c->is_stopped = 1;
    if (c->is_cancelled) return SCHEDULE_END;
    if (c->is_stopped) return c->schedule.out ? SCHEDULE_WAIT : SCHEDULE_END;
    schedule_answer answer = lobe_schedule_next(&c->schedule, u);
    if (answer == SCHEDULE_END && begin_round(c)) answer = lobe_schedule_next(&c->schedule, u);
    if (answer == SCHEDULE_PASS && is_quiet(c)) c->is_stopped = 1;
    return answer;
}

static void deliver(crew *c, const unit *u, const lobe_film *tile, uint64_t rays) {
    const uint32_t across = tiles_across(c->film);
    lobe_film_add_part(c->film, (int)(u->tile % across) * TILE, (int)(u->tile / across) * TILE,
                       tile, u->weight);
    if (c->film->tiles) {
        c->film->tiles[u->tile].done += u->count;
        c->film->tiles[u->tile].squares += u->count * u->weight * u->weight;
    }
    lobe_schedule_deliver(&c->schedule, u);
    c->rays += rays;
    c->samples += u->count * pixels_of_tile(c->film, u->tile);
    c->done += u->weight * (double)(u->count * pixels_of_tile(c->film, u->tile));
}

checkpoint_cost lobe_crew_cost(const crew *c) {
    return (checkpoint_cost){c->before.rays + c->rays, c->before.seconds + lobe_clock() - c->start,
                             c->before.cpu_seconds + lobe_cpu_clock()};
}

/* A disk that is full now may not be so later: the picture goes on. */
static void save(crew *c) {
    const lobe_render_options *o = c->options;
    c->has_failed_to_save =
        lobe_checkpoint_write(o->checkpoint, c->film, lobe_crew_cost(c)) != LOBE_RENDER_OK;
    c->saved = lobe_clock();
    if (!c->has_failed_to_save || !o->warning) return;
    char line[1100];
    snprintf(line, sizeof line, "%s, rendering goes on and the checkpoint before is kept",
             lobe_render_error_message());
    o->warning(o->warning_user, line);
}

static void show_progress(const crew *c) {
    const double seconds = lobe_clock() - c->start;
    const double fraction = c->wanted > 0.0 ? fmin(c->done / c->wanted, 1.0) : 1.0;
    const lobe_render_progress p = {
        .fraction = fraction,
        .seconds = seconds,
        .seconds_left = fraction > 0.0 ? seconds * (1.0 - fraction) / fraction : -1.0,
        .samples = c->samples,
        .pixel_samples =
            lobe_adaptive_before(c->schedule.round, c->options->samples) + c->schedule.passed};
    c->options->progress(c->options->progress_user, &p);
}

static void tend(crew *c) {
    const lobe_render_options *o = c->options;
    if (lobe_ranks_size() > 1) lobe_ranks_serve(c);
    if (o->progress) show_progress(c);
    if (!o->checkpoint || lobe_clock() - c->saved < o->checkpoint_seconds) return;
    omp_set_lock(&c->lock);
    save(c);
    omp_unset_lock(&c->lock);
}

/* The first pixel of a tile. */
static size_t corner_of(const lobe_film *film, uint32_t tile) {
    const size_t left = (size_t)(tile % tiles_across(film)) * TILE;
    return (size_t)(tile / tiles_across(film)) * TILE * (size_t)film->width + left;
}

static int has_everywhere(const lobe_film *film, uint32_t tile, uint32_t samples) {
    const size_t width = (size_t)film->width, height = (size_t)film->height;
    const size_t left = corner_of(film, tile) % width, top = corner_of(film, tile) / width;
    for (size_t y = top; y < top + TILE && y < height; y++)
        for (size_t x = left; x < left + TILE && x < width; x++)
            if (lobe_film_tried(film, y * width + x) != samples) return 0;
    return 1;
}

/* Samples of the rounds before this one. */
static uint32_t samples_before(const lobe_film *film, uint32_t tile) {
    return film->tiles ? film->tiles[tile].before : 0;
}

static void count_tile(crew *c, uint32_t tile) {
    const schedule *s = &c->schedule;
    const double pixels = (double)pixels_of_tile(c->film, tile), done = s->done[tile];
    const uint32_t before = lobe_adaptive_before(s->round, c->options->samples);
    c->samples += (uint64_t)(pixels * (samples_before(c->film, tile) + done));
    c->done += pixels * (before + (s->planned ? done * s->samples / s->planned[tile] : done));
    c->wanted += pixels * c->options->samples;
}

/* Where the film stands. A film that was made elsewhere may stand anywhere: 0, it cannot be gone on with. */
static int take_stock(crew *c) {
    schedule *s = &c->schedule;
    lobe_film *f = c->film;
    const uint32_t samples = c->options->samples;
    if (c->options->is_adaptive && (!f->tiles || !lobe_adaptive_is_sane(f, samples))) return 0;
    if (f->tiles) lobe_adaptive_schedule(f, samples, s);
    for (uint32_t t = 0; t < s->tiles; t++) {
        if (!f->tiles) s->done[t] = lobe_film_tried(f, corner_of(f, t));
        const int is_own = t % s->parts == s->part - 1;
        if (!lobe_schedule_is_step(s, t, s->done[t]) || (!is_own && s->done[t] > 0) ||
            !has_everywhere(f, t, samples_before(f, t) + s->done[t]))
            return 0;
        if (is_own) count_tile(c, t);
    }
    /* uneven: the pass before was looked at, and was too noisy */
    s->passed = lobe_schedule_is_even(s) ? 0 : lobe_schedule_least(s);
    return 1;
}

static int create_schedule(crew *c) {
    const lobe_render_options *o = c->options;
    const uint32_t down = (uint32_t)(c->film->height + TILE - 1) / TILE;
    schedule *s = &c->schedule;
    if (!lobe_schedule_create(s, tiles_across(c->film) * down, o->samples, o->part, o->parts))
        return 0;
    s->is_stepwise = o->noise > 0.0;
    return !o->is_adaptive || lobe_schedule_add_rounds(s);
}

lobe_render_result lobe_crew_run(crew *c) {
    const lobe_render_options *o = c->options;
    if (!create_schedule(c)) {
        lobe_schedule_free(&c->schedule);
        return lobe_fail_memory("schedule");
    }
    c->source = (crew_source){next, deliver, tend};
    c->saved = c->start;
    lobe_render_result result = LOBE_RENDER_OK;
    if (!take_stock(c))
        result = lobe_fail(
            LOBE_RENDER_BAD_INPUT,
            "%s: its samples are of no render that was interrupted; take another one", o->resume);
    else if (!lobe_crew_work(c, o->aovs))
        result = lobe_fail_memory("tiles");
    if (lobe_ranks_size() > 1 && !c->is_cancelled) lobe_ranks_dismiss(c);
    if (result == LOBE_RENDER_OK && o->checkpoint) save(c);
    lobe_schedule_free(&c->schedule);
    return result;
}
