/* app/ssr_contest.h: pipelines that run side by side on the same frames, and what real rays say of each. */
#ifndef LOBE_APP_SSR_CONTEST_H
#define LOBE_APP_SSR_CONTEST_H

#include <stdbool.h>

#include <jansson.h>
#include <lobe/ssr_frames.h>

#include "report.h"
#include "ssr_write.h"

enum { LOBE_APP_SSR_CONTENDERS_MAX = 12, LOBE_APP_SSR_SHOTS = 3 };

/* What one contender did in one frame. */
typedef struct lobe_app_ssr_row {
    lobe_ssr_statistics statistics;
    lobe_ssr_judgement judgement; /* these three with a truth only */
    double flip;                  /* negative: out of memory */
    double
        temporal; /* relative error of the change since the frame before; negative: there is none */
} lobe_app_ssr_row;

/* Pictures of a frame, kept for the report: where nothing was traced they are black. */
typedef struct lobe_app_ssr_shot {
    float *rgb, *relative, *flip; /* NULL: the frame was not reached */
} lobe_app_ssr_shot;

typedef struct lobe_app_ssr_contender {
    char name[48];
    lobe_ssr_options options;
    lobe_ssr *ssr;
    lobe_app_ssr_row *rows; /* one a frame */
    float *before;          /* radiance of the frame before */
    lobe_app_ssr_shot shots[LOBE_APP_SSR_SHOTS];
} lobe_app_ssr_contender;

typedef struct lobe_app_ssr_contest {
    int width, height, frames;
    int done; /* frames that are whole */
    bool has_truth;
    int contenders; /* the first is the one that was asked for */
    lobe_app_ssr_contender contender[LOBE_APP_SSR_CONTENDERS_MAX];
    float *truth_before;
    float *truth_shots[LOBE_APP_SSR_SHOTS];
} lobe_app_ssr_contest;

/* Adds a contender; false: there are too many. */
bool lobe_app_add_ssr_contender(lobe_app_ssr_contest *contest, const char *name,
                                lobe_ssr_options options);

/* Sizes and has_truth are set: the rest is made. */
lobe_app_status lobe_app_open_ssr_contest(lobe_app_ssr_contest *contest);
void lobe_app_close_ssr_contest(lobe_app_ssr_contest *contest);

/* Runs all on the next frame, number `index`. */
lobe_app_status lobe_app_run_ssr_contest(lobe_app_ssr_contest *contest, int index,
                                         const lobe_ssr_frame *frame);

/* Judges all on it; `frames` gave it last. */
lobe_app_status lobe_app_judge_ssr_contest(lobe_app_ssr_contest *contest, int index,
                                           const lobe_ssr_frames *frames,
                                           const lobe_app_truth *truth);

/* The number of the frame of a shot. */
int lobe_app_ssr_shot_frame(const lobe_app_ssr_contest *contest, int shot);

/* The frames of a contender, as stats.json has them; NULL: out of memory. */
json_t *lobe_app_ssr_rows(const lobe_app_ssr_contest *contest,
                          const lobe_app_ssr_contender *contender);

#endif
