/* A plot: a frame with two axes, and what is drawn in it in the units of the axes. */
#ifndef LOBE_FIGURE_PLOT_H
#define LOBE_FIGURE_PLOT_H

#include "text.h"

typedef enum scale {
    SCALE_LINEAR,
    SCALE_DEGREES, /* ticks at multiples of 15 */
    SCALE_LOG,     /* low and high are powers of ten */
    SCALE_CHANCE   /* logit of a probability; ticks close to 0 and to 1 */
} scale;

typedef struct axis {
    const char *label; /* with the unit; NULL: neither label nor numbers */
    double low, high;
    scale scale;
} axis;

typedef struct plot {
    canvas *c;
    box box;
    axis x, y;
} plot;

/* Frame, grid, ticks, numbers and labels. */
plot lobe_plot_begin(canvas *c, box b, axis x, axis y, const char *title);

double lobe_plot_x(const plot *p, double x);
double lobe_plot_y(const plot *p, double y);

void lobe_plot_line(const plot *p, pen pen, int count, const double *x, const double *y);
void lobe_plot_fill(const plot *p, colour k, double opacity, int count, const double *x,
                    const double *y);
void lobe_plot_dots(const plot *p, colour k, double radius, int count, const double *x,
                    const double *y);

/* values[row * columns + column], from the lower left corner; NaN stays the paper. */
typedef struct grid {
    int columns, rows;
    const double *values;
    double low, high; /* where the colours begin and end */
    colour_map *map;
} grid;

void lobe_plot_grid(const plot *p, grid g);

/* Beside or below plots of the same colours. */
void lobe_colour_bar(canvas *c, box b, colour_map *map, axis a);

/* The value in the middle of cell k of `count` along an axis. */
double lobe_axis_middle(axis a, int k, int count);

#endif
