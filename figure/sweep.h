/* A number of every method: over both roughnesses for one direction, and over the angle for two
 * roughnesses. */
#ifndef LOBE_FIGURE_SWEEP_H
#define LOBE_FIGURE_SWEEP_H

#include "figures.h"
#include "plot.h"

typedef double sweep_measure(const run *r, const lobe_reflection_f64 *model, uint64_t samples);

typedef struct sweep {
    sweep_measure *measure;
    const char *label;  /* of the number, for the axes */
    const char *column; /* of the number, in the table */
    axis axis;          /* its range */
    int maps;           /* how many of the methods get a map of their own */
    uint64_t
        samples; /* draws of a number of a map, where it takes any; of a curve nine times as many */
} sweep;

/* ndf, caps, bounded, optimal, horizon. */
lobe_figure_result lobe_figure_sweep(run *r, sweep s);

/* Numbers of the index-th of about `samples` draws: a regular grid, the third at random. */
void lobe_sweep_numbers(uint64_t index, uint64_t samples, double u[3]);

#endif
