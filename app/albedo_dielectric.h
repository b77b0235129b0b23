/* app/albedo_dielectric.h: `lobe albedo --bsdf dielectric`: what is reflected, what is transmitted. */
#ifndef LOBE_APP_ALBEDO_DIELECTRIC_H
#define LOBE_APP_ALBEDO_DIELECTRIC_H

#include <lobe/dielectric.h>

#include <stdint.h>

#include "table.h"

/* mu, r, t, energy, furnace, all_r, all_t. */
extern const char *const lobe_app_dielectric_columns[];

typedef struct lobe_app_dielectric_surface {
    lobe_dielectric_options options; /* compensate: as the furnace shall be */
    double alpha[2], ior;
    uint64_t walks, seed; /* walks: 0, or how many follow all scatterings */
} lobe_app_dielectric_surface;

/* The row of one direction, on either side. false: standard output is closed, or interrupted. */
bool lobe_app_write_dielectric(const lobe_app_dielectric_surface *surface,
                               const lobe_app_table *table, lobe_vec3_f64 wi);

#endif
