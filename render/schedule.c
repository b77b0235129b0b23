#include "schedule.h"

#include <stdlib.h>

int lobe_schedule_create(schedule *s, uint32_t tiles, uint32_t samples, uint32_t part,
                         uint32_t parts) {
    *s = (schedule){.tiles = tiles, .samples = samples, .part = part, .parts = parts};
    s->done = calloc(tiles, sizeof *s->done);
    s->is_out = calloc(tiles, sizeof *s->is_out);
    if (s->done && s->is_out) return 1;
    lobe_schedule_free(s);
    return 0;
}

int lobe_schedule_add_rounds(schedule *s) {
    s->samples = 0;
    s->planned = calloc(s->tiles, sizeof *s->planned);
    return s->planned != NULL;
}

void lobe_schedule_free(schedule *s) {
    free(s->done);
    free(s->planned);
    free(s->is_out);
    s->done = NULL;
    s->planned = NULL;
    s->is_out = NULL;
}

void lobe_schedule_begin_round(schedule *s, uint32_t round, uint32_t samples) {
    s->round = round;
    s->samples = samples;
    s->cursor = s->target = s->passed = 0;
}

static uint32_t end_of(const schedule *s, uint32_t tile) {
    return s->planned ? s->planned[tile] : s->samples;
}

/* Passes double, so that an interrupted picture is a whole one, up to a length that keeps units short. */
static uint32_t step_after(const schedule *s, uint32_t samples, uint32_t end) {
    const uint32_t next = !s->planned && samples < 16 ? (samples ? 2 * samples : 1) : samples + 16;
    return next < end ? next : end;
}

int lobe_schedule_is_step(const schedule *s, uint32_t tile, uint32_t samples) {
    const uint32_t end = end_of(s, tile);
    const int is_power = !s->planned && (samples & (samples - 1)) == 0;
    return samples == end || (samples < end && ((samples < 16 && is_power) || samples % 16 == 0));
}

/* Where a tile is when all are as far as one of `target` samples in the mean. */
static uint32_t goal_of(const schedule *s, uint32_t tile, uint32_t target) {
    if (!s->planned) return target;
    const uint64_t end = s->planned[tile];
    const uint64_t share = (end * target + (uint64_t)s->samples * ROUND_STEP - 1) /
                           ((uint64_t)s->samples * ROUND_STEP);
    return target >= s->samples || share * ROUND_STEP > end ? (uint32_t)end
                                                            : (uint32_t)share * ROUND_STEP;
}

/* The other way: the greatest target that a tile has reached. */
static uint32_t reached(const schedule *s, uint32_t tile) {
    const uint32_t done = s->done[tile];
    if (!s->planned) return done;
    if (done >= s->planned[tile]) return s->samples;
    return (uint32_t)((uint64_t)done * s->samples / s->planned[tile]) / ROUND_STEP * ROUND_STEP;
}

uint32_t lobe_schedule_least(const schedule *s) {
    uint32_t least = s->samples;
    for (uint32_t t = s->part - 1; t < s->tiles; t += s->parts)
        if (reached(s, t) < least) least = reached(s, t);
    return least;
}

int lobe_schedule_is_even(const schedule *s) {
    const uint32_t least = lobe_schedule_least(s);
    for (uint32_t t = s->part - 1; t < s->tiles; t += s->parts)
        if (s->done[t] != goal_of(s, t, least)) return 0;
    return 1;
}

static int take(schedule *s, unit *u) {
    if (s->cursor < s->part - 1) s->cursor = s->part - 1;
    for (; s->cursor < s->tiles; s->cursor += s->parts) {
        const uint32_t t = s->cursor, done = s->done[t], end = end_of(s, t);
        if (s->is_out[t] || done >= goal_of(s, t, s->target)) continue;
        *u = (unit){s->planned ? (double)s->samples / end : 1.0,
                    t,
                    done,
                    step_after(s, done, end) - done,
                    end,
                    s->round};
        s->is_out[t] = 1;
        s->out++;
        s->cursor += s->parts;
        return 1;
    }
    return 0;
}

schedule_answer lobe_schedule_next(schedule *s, unit *u) {
    if (take(s, u)) return SCHEDULE_UNIT;
    const uint32_t least = lobe_schedule_least(s);
    if (s->is_stepwise && s->out == 0 && least > s->passed) {
        s->passed = least;
        return SCHEDULE_PASS;
    }
    if (!s->is_stepwise) s->passed = least;
    s->cursor = 0;
    s->target = step_after(s, least, s->samples);
    /* nobody waits for the slowest tile of a pass */
    if (!s->is_stepwise) s->target = step_after(s, s->target, s->samples);
    if (take(s, u)) return SCHEDULE_UNIT;
    return s->out ? SCHEDULE_WAIT : SCHEDULE_END;
}

void lobe_schedule_deliver(schedule *s, const unit *u) {
    s->done[u->tile] += u->count;
    s->is_out[u->tile] = 0;
    s->out--;
}
