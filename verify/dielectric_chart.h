/* The chart of a rough dielectric of GGX facets: above, the visible normals that reflect upward
 * (ggx_chart.h); below, the visible normals that refract. In both the densities of visible-normal
 * sampling are smooth and nearly constant at any roughness, incidence and index. */
#ifndef LOBE_VERIFY_DIELECTRIC_CHART_H
#define LOBE_VERIFY_DIELECTRIC_CHART_H

#include "ggx_chart.h"
#include "sphere_chart.h"

typedef struct lobe_refraction_chart {
    double alpha[2];
    double wi[3];      /* above */
    double axis[3][3]; /* across, up, along the stretched wi */
    double stretch;    /* (1 + stretched wi.z)/2 */
    double n_i, n_o;   /* indices on both sides; equal: nothing is spread out there */
} lobe_refraction_chart;

/* Stays where it is made. */
typedef struct lobe_dielectric_chart {
    double side; /* -1: wi is below, and the frame upside down */
    lobe_ggx_chart reflection;
    lobe_refraction_chart refraction;
    lobe_double_chart both;
} lobe_dielectric_chart;

/* ior: below over above. transmits: 0 where the lower side is left out. */
void lobe_dielectric_chart_make(lobe_dielectric_chart *chart, const double wi[3], double alpha_x,
                                double alpha_y, double ior, int transmits);
lobe_verify_chart lobe_dielectric_chart_view(const lobe_dielectric_chart *chart);

#endif
