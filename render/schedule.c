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

void lobe_schedule_free(schedule *s) {
    free(s->done);
    free(s->is_out);
    s->done = NULL;
    s->is_out = NULL;
}

/* Passes double, so that an interrupted picture is a whole one, up to a length that keeps units short. */
static uint32_t step_after(const schedule *s, uint32_t samples) {
    const uint32_t next = samples == 0 ? 1 : samples < 16 ? 2 * samples : samples + 16;
    return next < s->samples ? next : s->samples;
}

int lobe_schedule_is_step(const schedule *s, uint32_t samples) {
    const int is_power = (samples & (samples - 1)) == 0;
    return samples == s->samples ||
           (samples < s->samples && (samples < 16 ? is_power : samples % 16 == 0));
}

static uint32_t least_done(const schedule *s) {
    uint32_t least = s->samples;
    for (uint32_t t = s->part - 1; t < s->tiles; t += s->parts)
        if (s->done[t] < least) least = s->done[t];
    return least;
}

static int take(schedule *s, unit *u) {
    if (s->cursor < s->part - 1) s->cursor = s->part - 1;
    for (; s->cursor < s->tiles; s->cursor += s->parts) {
        const uint32_t t = s->cursor, done = s->done[t];
        if (s->is_out[t] || done >= s->target) continue;
        *u = (unit){t, done, step_after(s, done) - done};
        s->is_out[t] = 1;
        s->out++;
        s->cursor += s->parts;
        return 1;
    }
    return 0;
}

schedule_answer lobe_schedule_next(schedule *s, unit *u) {
    if (take(s, u)) return SCHEDULE_UNIT;
    const uint32_t least = least_done(s);
    if (s->is_stepwise && s->out == 0 && least > s->passed) {
        s->passed = least;
        return SCHEDULE_PASS;
    }
    if (!s->is_stepwise) s->passed = least;
    s->cursor = 0;
    s->target = step_after(s, least);
    /* nobody waits for the slowest tile of a pass */
    if (!s->is_stepwise) s->target = step_after(s, s->target);
    if (take(s, u)) return SCHEDULE_UNIT;
    return s->out ? SCHEDULE_WAIT : SCHEDULE_END;
}

void lobe_schedule_deliver(schedule *s, const unit *u) {
    s->done[u->tile] += u->count;
    s->is_out[u->tile] = 0;
    s->out--;
}
