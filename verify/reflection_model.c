#include "reflection_model.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <lobe/batch.h>

#include "reflection_oracles.h"
#include "rounded.h"

static const double SPECIAL_ALPHA[] = {
    0.0, -0.0,    FLT_TRUE_MIN, DBL_TRUE_MIN, FLT_MIN,  1e-7,     1e-4,      0.01, 1,
    1e4, FLT_MAX, -FLT_MIN,     -1,           -FLT_MAX, INFINITY, -INFINITY, NAN};
enum { SPECIAL_ALPHAS = sizeof SPECIAL_ALPHA / sizeof *SPECIAL_ALPHA };

/* The degrees of a table are exact at the axes; their sines and cosines shall be too. */
static void direction_at(double theta, double phi, double d[3]) {
    const double degree = 0.01745329251994329577;
    double sine = sin(theta * degree);
    d[0] = sine * cos(phi * degree);
    d[1] = sine * sin(phi * degree);
    d[2] = theta == 90 ? 0 : cos(theta * degree);
}

/* Rows that the batches take in one call. */
enum { PAGE = 256 };
#define SAMPLE_BATCH NAME(lobe_sample_batch)
#define SAMPLE_MANY NAME(lobe_reflection_sample_batch)
#define EVAL_BATCH NAME(lobe_eval_batch)
#define EVAL_MANY NAME(lobe_reflection_eval_batch)
#define TAKE_POINTS(batch, array) ((void)(batch))

#define REAL float
#define NAME(stem) stem##_f32
#include "reflection_model_template.h"

#define REAL double
#define NAME(stem) stem##_f64
#include "reflection_model_template.h"

static double rounded(double x, lobe_precision precision) {
    return precision == LOBE_PRECISION_F32 ? lobe_rounded_to_float(x) : x;
}

void lobe_reflection_model_name(lobe_model model, char *name, size_t name_size) {
    const char *ndf = model.ndf == LOBE_NDF_GGX ? "" : lobe_ndf_name(model.ndf);
    const char *masking =
        model.masking == LOBE_MASKING_SMITH ? "" : lobe_masking_name(model.masking);
    snprintf(name, name_size, "%s%s%s%s%s", ndf, *ndf ? " " : "", masking, *masking ? " " : "",
             lobe_method_name(model.method));
}

void lobe_reflection_subject_name(lobe_reflection_parameters parameters, lobe_precision precision,
                                  char *name, size_t name_size, char *configuration,
                                  size_t configuration_size) {
    const lobe_reflection_parameters *p = &parameters;
    lobe_reflection_model_name(p->options.model, name, name_size);
    size_t length = strlen(name);
    snprintf(name + length, name_size - length, " %s",
             precision == LOBE_PRECISION_F32 ? "f32" : "f64");
    char tilt[40] = "";
    if (p->tilt != 0) snprintf(tilt, sizeof tilt, " tilt=%g,%g", p->tilt, p->tilt_azimuth);
    snprintf(configuration, configuration_size, "alpha=%g,%g theta=%g phi=%g%s g2=%s", p->alpha_x,
             p->alpha_y, p->theta, p->phi, tilt,
             p->options.g2 == LOBE_G2_SEPARABLE ? "separable" : "correlated");
}

static void geometric_normal(const lobe_reflection_parameters *p, lobe_precision precision,
                             double g[3]) {
    direction_at(p->tilt, p->tilt_azimuth, g);
    for (int k = 0; k < 3; ++k) g[k] = rounded(g[k], precision);
}

static void round_parameters(lobe_reflection_parameters *p, lobe_precision precision) {
    p->alpha_x = rounded(p->alpha_x, precision);
    p->alpha_y = rounded(p->alpha_y, precision);
}

/* G1 of a V-cavity has a kink, and `vcavity-valid` jumps where the other side begins to leave; the density of
 * Beckmann's `horizon` has no bound at two points of the horizon. */
static int is_rough(lobe_model row) {
    int is_beckmann_horizon = row.ndf == LOBE_NDF_BECKMANN && row.method == LOBE_METHOD_HORIZON;
    return row.masking == LOBE_MASKING_VCAVITY || is_beckmann_horizon;
}

void lobe_reflection_subject_make(lobe_reflection_subject *subject,
                                  lobe_reflection_parameters parameters, lobe_precision precision) {
    lobe_reflection_subject_name(parameters, precision, subject->name, sizeof subject->name,
                                 subject->configuration, sizeof subject->configuration);
    round_parameters(&parameters, precision);
    subject->parameters = parameters;
    lobe_verify_model *model = &subject->model;
    *model = lobe_verify_plain_model();
    model->name = subject->name;
    model->configuration = subject->configuration;
    model->self = &subject->parameters;
    direction_at(parameters.theta, parameters.phi, model->wi);
    for (int k = 0; k < 3; ++k) model->wi[k] = rounded(model->wi[k], precision);
    double ax = fmax(parameters.alpha_x, rounded(LOBE_ALPHA_MIN, precision));
    double ay = fmax(parameters.alpha_y, rounded(LOBE_ALPHA_MIN, precision));
    subject->chart = lobe_ggx_chart_prepare(model->wi, ax, ay);
    model->chart = lobe_ggx_chart_view(&subject->chart);
    if (parameters.tilt != 0) {
        double plane[3];
        geometric_normal(&parameters, precision, plane);
        subject->plane_chart = lobe_plane_chart_prepare(model->wi, plane, ax, ay);
        model->chart = lobe_plane_chart_view(&subject->plane_chart);
        model->has_jumps = 1; /* kinks, where one plane takes over from the other */
    }
    if (is_rough(parameters.options.model)) model->has_jumps = 1;
    model->is_reciprocal = 1;
    model->is_mirror = fmax(parameters.alpha_x, parameters.alpha_y) < LOBE_ALPHA_MIN;

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
    lobe_reflection_set_oracles(subject);
}
