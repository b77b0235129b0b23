/* Where the ticks of an axis stand, and what is written there. */
#ifndef LOBE_FIGURE_TICKS_H
#define LOBE_FIGURE_TICKS_H

#include "plot.h"

enum { TICKS_MAX = 24, TICK_TEXT = 24 };

typedef struct ticks {
    int count;
    double at[TICKS_MAX];
    char text[TICKS_MAX][TICK_TEXT];
} ticks;

/* At most about one for `spacing` points of the `length` of the axis. */
ticks lobe_ticks_of(axis a, double length, double spacing);

/* The value as a share of the axis: 0 at low, 1 at high; and back. */
double lobe_axis_share(axis a, double value);
double lobe_axis_value(axis a, double share);

#endif
