/* The chart of reflections above two planes: the shading surface and a geometric one.
 *
 * In the stretched frame, i' = A i / |A i|, the normals that reflect above the shading surface are a
 * convex cone m^T Q m >= 0 (ggx_chart.h), and those that reflect above a plane of normal g another,
 * Q_g = i' g'^T + g' i'^T - (i.g)/|A i| A^2, g' = A g. About an axis inside both, their intersection is
 * seen out to an angle that is known in closed form for each azimuth: the chart maps the unit disk
 * onto it, evenly in solid angle along each azimuth. It has a kink where one plane takes over from
 * the other and no jump anywhere. */
#ifndef LOBE_VERIFY_PLANE_CHART_H
#define LOBE_VERIFY_PLANE_CHART_H

#include "chart.h"

typedef struct lobe_plane_chart {
    double alpha[2];
    double wi[3], i_std[3];
    double length;        /* |A i| */
    double form[2][3][3]; /* Q, Q_g, each over its largest eigenvalue */
    double axis[3][3];    /* two across, and the axis itself */
} lobe_plane_chart;

/* wi unit, above the plane of the unit normal g, not straight down; alpha > 0. */
lobe_plane_chart lobe_plane_chart_prepare(const double wi[3], const double g[3], double alpha_x,
                                          double alpha_y);

/* The chart that reads `plane`, which must outlive it. */
lobe_verify_chart lobe_plane_chart_view(const lobe_plane_chart *plane);

#endif
