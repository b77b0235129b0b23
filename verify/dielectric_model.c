#include "dielectric_model.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <lobe/dielectric_batch.h>

#include "rounded.h"

/* Of each roughness and of the index. */
static const double SPECIAL[] = {0.0, FLT_TRUE_MIN, 1e-7, 1e-4,     0.01,    1,        1 + 1e-6,
                                 1.5, 1e3,          -1,   -FLT_MIN, FLT_MAX, INFINITY, NAN};
enum { SPECIALS = sizeof SPECIAL / sizeof *SPECIAL };

/* Rows that the batches take in one call. */
enum { PAGE = 256 };
#define SAMPLE_BATCH NAME(lobe_dielectric_sample_batch)
#define SAMPLE_MANY NAME(lobe_dielectric_sample_many)
#define EVAL_BATCH NAME(lobe_dielectric_eval_batch)
#define EVAL_MANY NAME(lobe_dielectric_eval_many)
#define TAKE_POINTS(batch, array) ((batch).is_point.data = (array), (batch).is_point.stride = 1)

#define REAL float
#define NAME(stem) stem##_f32
#include "dielectric_model_template.h"

#define REAL double
#define NAME(stem) stem##_f64
#include "dielectric_model_template.h"

static double rounded(double x, lobe_precision precision) {
    return precision == LOBE_PRECISION_F32 ? lobe_rounded_to_float(x) : x;
}

static void incidence(const lobe_dielectric_parameters *p, double wi[3]) {
    const double degree = 0.01745329251994329577;
    double sine = sin(p->theta * degree);
    wi[0] = sine * cos(p->phi * degree);
    wi[1] = sine * sin(p->phi * degree);
    wi[2] = p->theta == 90 ? 0 : cos(p->theta * degree);
}

void lobe_dielectric_subject_name(lobe_dielectric_parameters parameters, lobe_precision precision,
                                  char *name, size_t name_size, char *configuration,
                                  size_t configuration_size) {
    const lobe_dielectric_parameters *p = &parameters;
    const lobe_dielectric_options *o = &p->options;
    snprintf(name, name_size, "dielectric %s", precision == LOBE_PRECISION_F32 ? "f32" : "f64");
    snprintf(configuration, configuration_size, "alpha=%g,%g ior=%g theta=%g phi=%g g2=%s %s%s%s",
             p->alpha_x, p->alpha_y, p->ior, p->theta, p->phi,
             o->g2 == LOBE_G2_SEPARABLE ? "separable" : "correlated",
             o->transport == LOBE_TRANSPORT_IMPORTANCE ? "importance" : "radiance",
             o->thin ? " thin" : "", o->compensate ? " compensate" : "");
}

static void round_parameters(lobe_dielectric_parameters *p, lobe_precision precision) {
    p->alpha_x = rounded(p->alpha_x, precision);
    p->alpha_y = rounded(p->alpha_y, precision);
    p->ior = rounded(p->ior, precision);
}

/* What refraction does to radiance is all that lifts a weight above 1. */
static double weight_bound(const lobe_dielectric_parameters *p) {
    if (p->options.compensate && !p->options.thin) return INFINITY;
    int is_scaled = p->options.transport == LOBE_TRANSPORT_RADIANCE && !p->options.thin;
    double eta = p->theta > 90 ? 1 / p->ior : p->ior;
    return is_scaled ? fmax(1, 1 / (eta * eta)) : 1;
}

/* Light that goes through shrinks or spreads with the square of the index. What makes up for lost
 * energy depends on wi alone. */
static void set_reciprocity(lobe_verify_model *model, const lobe_dielectric_parameters *p) {
    double squared = p->ior * p->ior;
    model->is_reciprocal = !p->options.compensate || p->options.thin;
    model->passing = p->options.transport == LOBE_TRANSPORT_IMPORTANCE ? squared : 1 / squared;
}

void lobe_dielectric_subject_make(lobe_dielectric_subject *subject,
                                  lobe_dielectric_parameters parameters, lobe_precision precision) {
    lobe_dielectric_subject_name(parameters, precision, subject->name, sizeof subject->name,
                                 subject->configuration, sizeof subject->configuration);
    round_parameters(&parameters, precision);
    subject->parameters = parameters;
    lobe_verify_model *model = &subject->model;
    *model = lobe_verify_plain_model();
    model->name = subject->name;
    model->configuration = subject->configuration;
    model->self = &subject->parameters;
    incidence(&parameters, model->wi);
    for (int k = 0; k < 3; ++k) model->wi[k] = rounded(model->wi[k], precision);
    double least = rounded(LOBE_ALPHA_MIN, precision);
    lobe_dielectric_chart_make(&subject->chart, model->wi, fmax(parameters.alpha_x, least),
                               fmax(parameters.alpha_y, least), parameters.ior,
                               !parameters.options.thin);
    model->chart = lobe_dielectric_chart_view(&subject->chart);
    model->weight_bound = weight_bound(&parameters);
    set_reciprocity(model, &parameters);
    model->covers_sphere = 1;
    model->has_jumps = 1; /* where one of the two directions ceases to be possible */

    subject->twin = *model;
    set_functions_f64(&subject->twin);
    if (precision == LOBE_PRECISION_F64) {
        set_functions_f64(model);
    } else {
        set_functions_f32(model);
        model->rounding = FLT_EPSILON;
        model->random_bits = 24;
        model->twin = &subject->twin;
    }
}
