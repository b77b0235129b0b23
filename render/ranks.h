/* Other processes at the same picture. Rank 0 has the film and the schedule and hands out units; it works too. The
 * others ask, render and send sums back. */
#ifndef LOBE_RENDER_RANKS_H
#define LOBE_RENDER_RANKS_H

#include "crew.h"

/* 1 and 0 where this process is alone. */
int lobe_ranks_size(void);
int lobe_ranks_own(void);

/* `size` bytes of rank 0 for all. All ranks call it. */
void lobe_ranks_broadcast(void *data, int size);

/* Rank 0, first thread: take what came and answer. */
void lobe_ranks_serve(crew *c);

/* Rank 0: there is nothing left to do. */
void lobe_ranks_dismiss(crew *c);

/* Other ranks: render what rank 0 hands out until it says that it is enough. */
lobe_render_result lobe_ranks_help(crew *c);

#endif
