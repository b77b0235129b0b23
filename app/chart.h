/* app/chart.h: a chart of logarithms, or logarithms over numbers, as inline SVG, in the colours of the page. */
#ifndef LOBE_APP_CHART_H
#define LOBE_APP_CHART_H

#include <stdbool.h>
#include <stdio.h>

enum { LOBE_APP_CHART_POINTS = 64, LOBE_APP_CHART_COLOURS = 8 };

typedef struct lobe_app_series {
    const char *name;
    int count;
    double x[LOBE_APP_CHART_POINTS],
        y[LOBE_APP_CHART_POINTS];        /* above 0; x of any sign if linear */
    double error[LOBE_APP_CHART_POINTS]; /* of y; NAN: none */
    double slope;                        /* of the dashed line; NAN: none */
} lobe_app_series;

typedef struct lobe_app_chart {
    const char *x_title, *y_title;
    bool is_linear_in_x;
    bool has_ticks_at_points; /* those of the first series; else round numbers */
    int count;
    const lobe_app_series *series;
} lobe_app_chart;

/* CSS of the colours .s0, .s1, … for a page's style. */
extern const char lobe_app_chart_style[];

void lobe_app_write_chart(FILE *file, const lobe_app_chart *chart);

#endif
