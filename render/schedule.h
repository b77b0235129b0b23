/* Which tile is rendered next, and how far. A tile goes from one fixed number of samples to the next: 1, 2, 4, 8, 16,
 * 32, 48, … A unit is such a step; its sum is added to the picture as a whole. So the sum of a pixel has one order of
 * additions, whoever renders the units and whatever comes between. */
#ifndef LOBE_RENDER_SCHEDULE_H
#define LOBE_RENDER_SCHEDULE_H

#include <stdint.h>

enum { TILE = 16 };

typedef struct unit {
    uint32_t tile, first, count;
} unit;

typedef struct schedule {
    uint32_t tiles, samples; /* samples: in the end, of every pixel */
    uint32_t part, parts;    /* tiles t with t % parts == part - 1 are to be rendered */
    int is_stepwise;         /* no unit of the next pass before the last of this one is delivered */
    uint32_t *done;          /* samples of each tile */
    unsigned char *is_out;   /* tiles that somebody renders */
    uint32_t out, cursor, target;
    uint32_t passed; /* samples that every tile had when a pass was begun last */
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

/* Whether a tile can have been left at so many samples. */
int lobe_schedule_is_step(const schedule *s, uint32_t samples);

#endif
