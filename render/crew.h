/* The threads of this process at the units of a picture, and what goes on meanwhile: progress, checkpoints, the end by
 * time, noise or interrupt, and the other processes (ranks.h). */
#ifndef LOBE_RENDER_CREW_H
#define LOBE_RENDER_CREW_H

#include <omp.h>

#include "checkpoint.h"
#include "film.h"
#include "schedule.h"

/* Render a unit into `tile`, an empty film of TILE x TILE pixels, and raise `rays`. */
typedef void render_unit(const void *user, const unit *u, lobe_film *tile, uint64_t *rays);

typedef struct crew crew;

/* Where units come from and where their sums go. */
typedef struct crew_source {
    schedule_answer (*next)(crew *c, unit *u);
    void (*deliver)(crew *c, const unit *u, const lobe_film *tile, uint64_t rays);
    void (*tend)(crew *c); /* by the first thread, before each of its units; without the lock */
} crew_source;

struct crew {
    const lobe_render_options *options;
    render_unit *render;
    const void *user;
    int threads;
    double start; /* of this run, by lobe_clock */
    crew_source source;
    omp_lock_t lock; /* held in next and deliver; guards all below */
    lobe_film *film;
    schedule schedule;
    uint64_t rays;          /* of this run */
    checkpoint_cost before; /* of the runs before */
    uint64_t samples;       /* camera paths so far */
    double done, wanted;    /* sums of their weights, and in the end */
    double saved;           /* when the last checkpoint was begun */
    int is_stopped;         /* no new units */
    int is_cancelled;       /* nor any wait for those that others have */
    int has_failed_to_save; /* the last checkpoint */
};

/* Seconds of a clock that only goes forward, and of the processor for all threads. */
double lobe_clock(void);
double lobe_cpu_clock(void);

/* Render what is left of c->film. */
lobe_render_result lobe_crew_run(crew *c);

/* Units from elsewhere: the same loop. 0: no memory. */
int lobe_crew_work(crew *c, uint32_t aovs);

checkpoint_cost lobe_crew_cost(const crew *c);

#endif
