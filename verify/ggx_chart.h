/* The chart of Smith-GGX reflection: the visible normals that reflect upward.
 *
 * In the stretched frame, i' = A i / |A i|, A = diag(alpha_x, alpha_y, 1), these normals are a cone
 * m^T Q m >= 0 with one positive eigenvalue, so seen along its eigenvector they fill an ellipse.
 * The chart maps the unit disk onto it. There the density of every visible-normal method is
 * smooth and nearly constant, at any roughness and incidence, and no point is wasted below the
 * surface. It is a change of variables only: any density can be integrated in it. */
#ifndef LOBE_VERIFY_GGX_CHART_H
#define LOBE_VERIFY_GGX_CHART_H

#include "chart.h"

typedef struct lobe_ggx_chart {
    double alpha[2];
    double wi[3];
    double length;       /* |A i| */
    double axis[3][3];   /* e1, e2, n */
    double half_axis[2]; /* a, b */
    double gap[2];       /* 1 - a^2, 1 - b^2 */
    double slant[2];     /* a i'.e1 / nu, b i'.e2 / nu */
    double nu;           /* i'.n */
    double lambda;       /* positive eigenvalue of Q */
    double inverse_alpha[2];
    double inverse_half_axis[2];
} lobe_ggx_chart;

/* wi unit, above or below the surface, but not straight down. alpha > 0. */
lobe_ggx_chart lobe_ggx_chart_prepare(const double wi[3], double alpha_x, double alpha_y);

/* The chart that reads `ggx`, which must outlive it. */
lobe_verify_chart lobe_ggx_chart_view(const lobe_ggx_chart *ggx);

/* Share of the visible normals that reflect upward: 2 a b nu / (1 + i'.z). */
double lobe_ggx_chart_visible_share(const lobe_ggx_chart *ggx);

#endif
