/* The library's rough dielectric as a model to verify. */
#ifndef LOBE_VERIFY_DIELECTRIC_MODEL_H
#define LOBE_VERIFY_DIELECTRIC_MODEL_H

#include <lobe/dielectric.h>

#include "dielectric_chart.h"
#include "reflection_model.h"
#include "model.h"

typedef struct lobe_dielectric_parameters {
    lobe_dielectric_options options;
    double alpha_x, alpha_y;
    double ior;
    double theta, phi; /* of wi, degrees; beyond 90: inside */
} lobe_dielectric_parameters;

/* Stays where it is made: the model points into it. */
typedef struct lobe_dielectric_subject {
    lobe_dielectric_parameters parameters;
    lobe_dielectric_chart chart;
    lobe_verify_model twin;
    lobe_verify_model model;
    char name[48];
    char configuration[144];
} lobe_dielectric_subject;

/* Draws that are point masses, as through a thin wall, count as rejected. */
void lobe_dielectric_subject_make(lobe_dielectric_subject *subject,
                                  lobe_dielectric_parameters parameters, lobe_precision precision);

/* "dielectric f32" and "alpha=0.5,0.2 ior=1.5 theta=40 phi=30 g2=correlated radiance". */
void lobe_dielectric_subject_name(lobe_dielectric_parameters parameters, lobe_precision precision,
                                  char *name, size_t name_size, char *configuration,
                                  size_t configuration_size);

#endif
