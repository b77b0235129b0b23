/* Which tile is rendered next, and how far. A tile goes from one fixed number of samples to the next: 1, 2, 4, 8, 16,
 * 32, 48, … A unit is such a step; its sum is added to the picture as a whole. So the sum of a pixel has one order of
 * additions, whoever renders the units and whatever comes between.
 *
 * An adaptive picture goes in rounds (adaptive.h): in a round each tile has its own number of samples, and goes there
 * in steps of 16, all tiles about equally far. */
#ifndef LOBE_RENDER_SCHEDULE_H
#define LOBE_RENDER_SCHEDULE_H

#include <stdint.h>

enum { TILE = 16, ROUND_STEP = 16 };

typedef struct unit {
    double weight; /* of each sample; 1 without rounds */
    uint32_t tile, first, count;
    uint32_t of;    /* samples of the tile in the end, or in this round */
    uint32_t round; /* from 0 */
} unit;

typedef struct schedule {
    uint32_t tiles, samples; /* samples: in the end, of every pixel; in a round: their mean */
    uint32_t part, parts;    /* tiles t with t % parts == part - 1 are to be rendered */
    int is_stepwise;         /* no unit of the next pass before the last of this one is delivered */
    uint32_t *done;          /* samples of each tile, in this round */
    uint32_t *planned;       /* in the end of the round, multiples of ROUND_STEP; NULL: no rounds */
    uint32_t round;
    unsigned char *is_out; /* tiles that somebody renders */
    uint32_t out, cursor, target;
    uint32_t passed; /* samples that every tile had when a pass was begun last; in a round: mean */
} schedule;

typedef enum schedule_answer {
    SCHEDULE_UNIT, /* *u is to be rendered and delivered */
    SCHEDULE_WAIT, /* all that is left is with others: ask again */
    SCHEDULE_PASS, /* is_stepwise: every tile has `passed` samples; ask again to go on */
    SCHEDULE_END
} schedule_answer;

/* 0: no memory. */
int lobe_schedule_create(schedule *s, uint32_t tiles, uint32_t samples, uint32_t part,
                         uint32_t parts);
void lobe_schedule_free(schedule *s);

schedule_answer lobe_schedule_next(schedule *s, unit *u);
void lobe_schedule_deliver(schedule *s, const unit *u);

/* Rounds are to come: nothing to do until lobe_schedule_begin_round has been called. 0: no memory. */
int lobe_schedule_add_rounds(schedule *s);

/* A round of `samples` a pixel, in the mean, at least ROUND_STEP; `planned` and `done` are filled in. Nothing is out. */
void lobe_schedule_begin_round(schedule *s, uint32_t round, uint32_t samples);

/* Whether the tile can have been left at so many samples. */
int lobe_schedule_is_step(const schedule *s, uint32_t tile, uint32_t samples);

/* How far all tiles are, and whether none is farther, which is so at the end of a pass. */
uint32_t lobe_schedule_least(const schedule *s);
int lobe_schedule_is_even(const schedule *s);

#endif
