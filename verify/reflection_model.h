/* The library's reflection as a model to verify: one method, roughness and incidence. */
#ifndef LOBE_VERIFY_REFLECTION_MODEL_H
#define LOBE_VERIFY_REFLECTION_MODEL_H

#include <lobe/reflection.h>

#include "ggx_chart.h"
#include "model.h"
#include "plane_chart.h"

typedef enum lobe_precision {
    LOBE_PRECISION_F32,
    LOBE_PRECISION_F64,
    LOBE_PRECISION_COUNT
} lobe_precision;

typedef struct lobe_reflection_parameters {
    lobe_reflection_options options;
    double alpha_x, alpha_y;
    double theta, phi;         /* of wi, degrees */
    double tilt, tilt_azimuth; /* of the geometric normal, degrees; tilt 0: there is none */
} lobe_reflection_parameters;

/* Stays where it is made: the model points into it. */
typedef struct lobe_reflection_subject {
    lobe_reflection_parameters parameters;
    lobe_ggx_chart chart;
    lobe_plane_chart plane_chart; /* where the geometric normal is tilted */
    lobe_verify_model twin;
    lobe_verify_model model;
    char name[48];
    char configuration[96];
} lobe_reflection_subject;

void lobe_reflection_subject_make(lobe_reflection_subject *subject,
                                  lobe_reflection_parameters parameters, lobe_precision precision);

/* "bounded", "beckmann newton": what is not GGX or not Smith is named. */
void lobe_reflection_model_name(lobe_model model, char *name, size_t name_size);

/* "bounded f32" and "alpha=0.5,0.2 theta=40 phi=30 g2=correlated". */
void lobe_reflection_subject_name(lobe_reflection_parameters parameters, lobe_precision precision,
                                  char *name, size_t name_size, char *configuration,
                                  size_t configuration_size);

#endif
