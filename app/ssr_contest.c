#include "ssr_contest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/metrics.h>

#include "json.h"
#include "ssr_source.h"

static size_t pixels_of(const lobe_app_ssr_contest *c) {
    return (size_t)c->width * (size_t)c->height;
}

static lobe_app_status no_memory(void) {
    lobe_app_report("ssr", "use a smaller --size", "out of memory");
    return LOBE_APP_FAILED;
}

bool lobe_app_add_ssr_contender(lobe_app_ssr_contest *c, const char *name,
                                lobe_ssr_options options) {
    if (c->contenders == LOBE_APP_SSR_CONTENDERS_MAX) return false;
    lobe_app_ssr_contender *added = &c->contender[c->contenders++];
    snprintf(added->name, sizeof added->name, "%s", name);
    added->options = options;
    return true;
}

lobe_app_status lobe_app_open_ssr_contest(lobe_app_ssr_contest *c) {
    for (int m = 0; m < c->contenders; m++) {
        lobe_app_ssr_contender *one = &c->contender[m];
        const lobe_app_status status =
            lobe_app_ssr_status(lobe_ssr_create(c->width, c->height, one->options, &one->ssr));
        if (status) return status;
        one->rows = calloc((size_t)c->frames, sizeof *one->rows);
        if (c->has_truth) one->before = calloc(3 * pixels_of(c), sizeof *one->before);
        if (!one->rows || (c->has_truth && !one->before)) return no_memory();
    }
    if (c->has_truth) c->truth_before = calloc(3 * pixels_of(c), sizeof *c->truth_before);
    return c->has_truth && !c->truth_before ? no_memory() : LOBE_APP_DONE;
}

void lobe_app_close_ssr_contest(lobe_app_ssr_contest *c) {
    for (int m = 0; m < c->contenders; m++) {
        lobe_app_ssr_contender *one = &c->contender[m];
        lobe_ssr_free(one->ssr);
        free(one->rows);
        free(one->before);
        for (int k = 0; k < LOBE_APP_SSR_SHOTS; k++) free(one->shots[k].rgb);
    }
    for (int k = 0; k < LOBE_APP_SSR_SHOTS; k++) free(c->truth_shots[k]);
    free(c->truth_before);
}

lobe_app_status lobe_app_run_ssr_contest(lobe_app_ssr_contest *c, int index,
                                         const lobe_ssr_frame *frame) {
    for (int m = 0; m < c->contenders; m++) {
        lobe_app_ssr_contender *one = &c->contender[m];
        const lobe_app_status status =
            lobe_app_ssr_status(lobe_ssr_run(one->ssr, frame, &one->rows[index].statistics));
        if (status) return status;
    }
    return LOBE_APP_DONE;
}

/* ---- Judging --------------------------------------------------------------------------------- */

/* The pixels with a ray; the others black. */
static void keep_traced(const lobe_app_ssr_contest *c, const lobe_ssr *ssr, const float *from,
                        float *to) {
    const lobe_ssr_ray *rays = lobe_ssr_rays(ssr);
    for (size_t i = 0; i < pixels_of(c); i++)
        for (size_t k = 0; k < 3; k++)
            to[3 * i + k] = rays[i].state != LOBE_SSR_NO_RAY ? from[3 * i + k] : 0.0f;
}

/* Relative error of the change since the frame before; both pictures have become 0 where nothing is traced. */
static double change_error(size_t values, const float *now, const float *before, const float *truth,
                           const float *truth_before) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < values; i++) {
        if (!(truth[i] > 0) || !(truth_before[i] > 0)) continue;
        const double change = (double)now[i] - (double)before[i];
        const double right = (double)truth[i] - (double)truth_before[i];
        sum += (change - right) * (change - right) / lobe_relative_scale((double)truth[i]);
        count++;
    }
    return count ? sum / (double)count : -1;
}

int lobe_app_ssr_shot_frame(const lobe_app_ssr_contest *c, int shot) {
    return shot * (c->frames - 1) / (LOBE_APP_SSR_SHOTS - 1);
}

/* The shot that a frame is; the last of them if it is several; -1: none. */
static int shot_of(const lobe_app_ssr_contest *c, int index) {
    for (int k = LOBE_APP_SSR_SHOTS - 1; k >= 0; k--)
        if (lobe_app_ssr_shot_frame(c, k) == index) return k;
    return -1;
}

static bool keep_shot(const lobe_app_ssr_contest *c, lobe_app_ssr_shot *shot, const float *seen,
                      const float *truth, const float *flip) {
    const size_t pixels = pixels_of(c);
    shot->rgb = malloc(5 * pixels * sizeof *shot->rgb);
    if (!shot->rgb) return false;
    shot->relative = shot->rgb + 3 * pixels;
    shot->flip = shot->relative + pixels;
    memcpy(shot->rgb, seen, 3 * pixels * sizeof *seen);
    memcpy(shot->flip, flip, pixels * sizeof *flip);
    for (size_t i = 0; i < pixels; i++) {
        double error = 0;
        for (size_t k = 0; k < 3; k++) {
            const double d = (double)seen[3 * i + k] - (double)truth[3 * i + k];
            error += d * d / lobe_relative_scale((double)truth[3 * i + k]) / 3;
        }
        shot->relative[i] = (float)error;
    }
    return true;
}

/* `room`: 7 floats a pixel: what is seen, the truth there, FLIP. */
static bool judge_one(lobe_app_ssr_contest *c, lobe_app_ssr_contender *one, int index,
                      const lobe_ssr_frames *frames, const lobe_app_truth *truth, float *room) {
    const size_t pixels = pixels_of(c);
    float *seen = room, *right = room + 3 * pixels, *flip = room + 6 * pixels;
    lobe_app_ssr_row *row = &one->rows[index];
    keep_traced(c, one->ssr, lobe_ssr_radiance(one->ssr), seen);
    keep_traced(c, one->ssr, truth->rgb, right);
    row->judgement = lobe_ssr_judge(frames, one->ssr, truth->rgb, truth->on_screen);
    if (!lobe_flip(seen, right, c->width, c->height, LOBE_FLIP_LDR, LOBE_FLIP_PIXELS_PER_DEGREE,
                   flip, &row->flip))
        return false;
    row->temporal =
        index > 0 ? change_error(3 * pixels, seen, one->before, right, c->truth_before) : -1;
    memcpy(one->before, seen, 3 * pixels * sizeof *seen);
    const int shot = shot_of(c, index);
    return shot < 0 || keep_shot(c, &one->shots[shot], seen, right, flip);
}

/* The truth of the shots, as the first contender traces it. */
static bool keep_truth(lobe_app_ssr_contest *c, int index, const lobe_app_truth *truth) {
    const size_t bytes = 3 * pixels_of(c) * sizeof(float);
    const int shot = shot_of(c, index);
    memcpy(c->truth_before, truth->rgb, bytes);
    if (shot < 0) return true;
    c->truth_shots[shot] = malloc(bytes);
    if (c->truth_shots[shot]) keep_traced(c, c->contender[0].ssr, truth->rgb, c->truth_shots[shot]);
    return c->truth_shots[shot] != NULL;
}

lobe_app_status lobe_app_judge_ssr_contest(lobe_app_ssr_contest *c, int index,
                                           const lobe_ssr_frames *frames,
                                           const lobe_app_truth *truth) {
    float *room = malloc(7 * pixels_of(c) * sizeof *room);
    bool is_good = room != NULL;
    for (int m = 0; m < c->contenders && is_good; m++)
        is_good = judge_one(c, &c->contender[m], index, frames, truth, room);
    free(room);
    is_good = is_good && keep_truth(c, index, truth);
    return is_good ? LOBE_APP_DONE : no_memory();
}

/* ---- Numbers --------------------------------------------------------------------------------- */

static json_t *pass_times(const lobe_ssr_statistics *st) {
    json_t *times = json_object();
    for (int pass = 0; times && pass < LOBE_SSR_PASS_COUNT; pass++)
        json_object_set_new(times, lobe_ssr_pass_name((lobe_ssr_pass)pass),
                            lobe_app_json_number(st->milliseconds[pass]));
    return times;
}

/* A number, or null where there is none. */
static json_t *known(int is_known, double number) {
    return is_known ? lobe_app_json_number(number) : json_null();
}

static json_t *judged(const lobe_app_ssr_row *row) {
    const lobe_ssr_judgement *j = &row->judgement;
    return json_pack(
        "{so so so so so so so}", "relmse", known(j->pixels > 0, j->relmse), "relmse_onscreen",
        known(j->pixels_onscreen > 0, j->relmse_onscreen), "flip", lobe_app_json_number(row->flip),
        "temporal", known(row->temporal >= 0, row->temporal), "false_hits",
        lobe_app_json_number(j->false_hits), "false_misses", lobe_app_json_number(j->false_misses),
        "hit_distance", lobe_app_json_number(j->hit_distance));
}

json_t *lobe_app_ssr_rows(const lobe_app_ssr_contest *c, const lobe_app_ssr_contender *one) {
    json_t *rows = json_array();
    for (int i = 0; rows && i < c->done; i++) {
        const lobe_ssr_statistics *st = &one->rows[i].statistics;
        const double rays = fmax(1.0, (double)st->rays);
        json_t *row = json_pack(
            "{si sI sI so so so}", "frame", i, "rays", (json_int_t)st->rays, "rejected",
            (json_int_t)st->rejected, "hit_rate", lobe_app_json_number((double)st->hits / rays),
            "steps_per_ray", lobe_app_json_number((double)st->steps / rays), "ms", pass_times(st));
        if (row && c->has_truth) json_object_set_new(row, "truth", judged(&one->rows[i]));
        json_array_append_new(rows, row);
    }
    if (json_array_size(rows) == (size_t)c->done) return rows;
    json_decref(rows);
    return NULL;
}
