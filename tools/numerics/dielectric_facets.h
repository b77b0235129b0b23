/* tools/numerics/dielectric_facets.h: what facets of a compensated rough dielectric scatter properly, for the makers
 * of its tables. */
#ifndef TOOLS_DIELECTRIC_FACETS_H
#define TOOLS_DIELECTRIC_FACETS_H

#include "kernel/bind/c_f64.h"

#include "kernel/ggx_dielectric.h"

#include <math.h>

/* Smallest roughness of the model, also for the first entries of the tables. */
static const double LEAST_ALPHA = 1e-4;

/* The choice between reflection and transmission is integrated exactly. */
static double facet_energy(const ggx_dielectric *s, double u1, double u2) {
    dielectric_facet f = ggx_dielectric_drawn(*s, u1, u2);
    double reflected = f.reflects ? dielectric_ratio_r(s->side, f) : 0;
    double transmitted = f.passes ? dielectric_ratio_t(s->side, f) : 0;
    return reflected + transmitted;
}

static ggx_dielectric model(double azimuth, double cosine, double alpha_x, double alpha_y,
                            double eta, int separable) {
    int inside = eta < 1;
    double sine = sqrt((1 - cosine) * (1 + cosine));
    double least = inside ? -fmax(cosine, 1e-300) : cosine;
    v3 wi = v3_of(sine * cos(azimuth), sine * sin(azimuth), least);
    dielectric_options options = {separable, true, false, true};
    return ggx_dielectric_prepare(wi, alpha_x, alpha_y, inside ? 1 / eta : eta, options);
}

#endif
