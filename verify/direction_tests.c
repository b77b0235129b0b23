/* Values at single directions.
 *
 * A sampled direction is rounded, so the density there is not exactly the density of the draw. How
 * much that may be is a property of the function and not of its code: the condition. Errors are
 * counted in units of (rounding unit) x (value + condition). */
#include <math.h>

#include <lobe/random.h>

#include "draws.h"
#include "rounded.h"
#include "tests.h"

/* Roundings in sequence that a result may collect. */
static const double LIMIT = 32;

typedef struct pair {
    const lobe_verify_model *model;
    lobe_verify_state state;
    const lobe_verify_model *exact; /* the twin, or the model itself */
    lobe_verify_state exact_state;
} pair;

/* Largest errors, in units, and where single things go wrong. */
typedef struct worst {
    double density, weight, reciprocity, precision_density, precision_value;
    double largest_weight, length;
    int compared, below;
} worst;

static void prepare_pair(pair *p, const lobe_verify_model *model, const double wi[3]) {
    p->model = model;
    p->exact = model->twin != NULL ? model->twin : model;
    model->prepare(model->self, wi, &p->state);
    p->exact->prepare(p->exact->self, wi, &p->exact_state);
}

/* Functions of direction, by the exact one of the pair. */
typedef double (*direction_function)(const pair *p, const double wo[3]);

static double density_at(const pair *p, const double wo[3]) {
    return p->exact->density(&p->exact_state, wo);
}

static double value_at(const pair *p, const double wo[3]) {
    return p->exact->value(&p->exact_state, wo);
}

static double weight_at(const pair *p, const double wo[3]) {
    double density = density_at(p, wo);
    return density > 0 ? value_at(p, wo) / density : 0;
}

/* Value and condition: the sum of the changes for a unit step along each axis, by differences. To
 * either side: at an extremum a central difference would see nothing. */
static double scale(const pair *p, direction_function function, const double wo[3]) {
    const double step = 0x1p-24;
    double here = function(p, wo);
    double sum = here;
    for (int k = 0; k < 3; ++k) {
        double up[3] = {wo[0], wo[1], wo[2]};
        double down[3] = {wo[0], wo[1], wo[2]};
        up[k] += step;
        down[k] -= step;
        sum += (fabs(function(p, up) - here) + fabs(function(p, down) - here)) / step;
    }
    return sum;
}

/* The unit of an error. A number below the fourth power of the rounding unit is as good as none: that
 * much of it an underflow may take. */
static double unit_of(const lobe_verify_model *model, double scale) {
    const double square = model->rounding * model->rounding;
    return model->rounding * scale + square * square;
}

static void raise_to(double *worst, double error, double unit) {
    *worst = lobe_worse(*worst, error / unit);
}

/* Where rounding the direction changes the density by a good part, as about straight back, the
 * direction does not say what the density of the draw was. */
static int is_blurred(const lobe_verify_model *model, double density, double density_scale) {
    return model->rounding * (density_scale - density) > 0.25 * density;
}

static void check_draw(const pair *p, const lobe_verify_draw *draw, worst *w) {
    const lobe_verify_model *model = p->model;
    double density = model->density(&p->state, draw->wo);
    double value = model->value(&p->state, draw->wo);
    double density_scale = scale(p, density_at, draw->wo);
    w->largest_weight = lobe_worse(w->largest_weight, draw->weight);
    const double *o = draw->wo;
    double length2 = o[0] * o[0] + o[1] * o[1] + o[2] * o[2];
    w->length = lobe_worse(w->length, fabs(length2 - 1) / model->rounding);
    if (is_blurred(model, density_at(p, draw->wo), density_scale)) return;
    /* The weight was rounded at the drawn normal, the other two at the direction. */
    double weight_scale = scale(p, value_at, draw->wo) + density * scale(p, weight_at, draw->wo);
    raise_to(&w->density, fabs(draw->pdf - density), unit_of(model, density_scale));
    raise_to(&w->weight, fabs(draw->weight * density - value), unit_of(model, weight_scale));
    w->compared += 1;
}

static double error_at(const pair *p, direction_function function, const double wo[3],
                       double result) {
    return fabs(result - function(p, wo)) / unit_of(p->model, scale(p, function, wo));
}

/* Error of a result of the model, in units. At a jump the model may have come out on the other side by the
 * rounding of what decides: there it is held to the nearest of what the exact one says to either side, as far
 * off as that rounding moves the jump. Beyond, a wrong side is an error. */
static double precision_error(const pair *p, direction_function function, const double wo[3],
                              double result) {
    const double step = 4 * p->model->rounding;
    double error = error_at(p, function, wo, result);
    if (!p->model->has_jumps || error <= LIMIT) return error;
    for (int k = 0; k < 6; ++k) {
        double aside[3] = {wo[0], wo[1], wo[2]};
        aside[k % 3] += k < 3 ? step : -step;
        error = fmin(error, error_at(p, function, aside, result));
    }
    return error;
}

static void check_precision(const pair *p, const double wo[3], worst *w) {
    if (p->exact == p->model) return;
    double density = p->model->density(&p->state, wo), value = p->model->value(&p->state, wo);
    w->precision_density =
        lobe_worse(w->precision_density, precision_error(p, density_at, wo, density));
    w->precision_value = lobe_worse(w->precision_value, precision_error(p, value_at, wo, value));
}

static int has_two_sides(const lobe_verify_model *model) {
    return model->covers_sphere || lobe_verify_is_sphere(model);
}

/* From below where the model has a below. */
static int is_reciprocal(const lobe_verify_model *model) {
    return model->is_reciprocal && (model->wi[2] > 0 || has_two_sides(model));
}

/* f(wi, wo)/f(wo, wi); 0: unknown. */
static double reciprocal_ratio(const lobe_verify_model *model, const double wo[3]) {
    double sides = model->wi[2] * wo[2];
    if (!is_reciprocal(model) || sides == 0) return 0;
    if (sides > 0) return 1;
    return model->passing > 0 && model->wi[2] < 0 ? 1 / model->passing : model->passing;
}

/* f = value / |cos| from both sides. */
static void check_reciprocity(const pair *p, const double wo[3], worst *w) {
    const double *wi = p->model->wi;
    double ratio = reciprocal_ratio(p->model, wo);
    if (!(ratio > 0)) return;
    pair back;
    prepare_pair(&back, p->model, wo);
    double there = p->model->value(&p->state, wo) / fabs(wo[2]);
    double here = ratio * p->model->value(&back.state, wi) / fabs(wi[2]);
    double both =
        scale(p, value_at, wo) / fabs(wo[2]) + ratio * scale(&back, value_at, wi) / fabs(wi[2]);
    raise_to(&w->reciprocity, fabs(there - here), unit_of(p->model, both));
}

static void check_support(const pair *p, const double wo[3], worst *w) {
    double below[3] = {wo[0], wo[1], -wo[2]};
    w->below += p->model->density(&p->state, below) != 0 || p->model->value(&p->state, below) != 0;
}

void lobe_hemisphere_direction(const lobe_verify_model *model, const lobe_settings *settings,
                               uint64_t index, double wo[3]) {
    /* Counted from the far end: the draws of the same stream start at 0. */
    lobe_random4 r = lobe_random(settings->seed, settings->stream, UINT64_MAX - index);
    double z = lobe_random_unit_f64(r.word[0], r.word[1]);
    double angle = 6.283185307179586477 * lobe_random_unit_f64(r.word[2], r.word[3]);
    double radius = sqrt((1 - z) * (1 + z));
    wo[0] = radius * cos(angle);
    wo[1] = radius * sin(angle);
    wo[2] = z;
    /* What a model in single precision is given is what its twin is given. One in double is given
     * unit length in double. */
    for (int k = 0; k < 3 && model->random_bits == 24; ++k) wo[k] = lobe_rounded_to_float(wo[k]);
}

static void report_directions(const lobe_verify_model *model, const worst *w, int checks,
                              lobe_report *report) {
    lobe_report_error(report, "density", w->density, LIMIT, "%d draws", w->compared);
    lobe_report_error(report, "weight", w->weight, LIMIT, "%d draws", w->compared);
    if (isfinite(model->weight_bound)) {
        lobe_report_error(report, "bound", w->largest_weight,
                          model->weight_bound * (1 + LIMIT * model->rounding), "%d draws",
                          w->compared);
    }
    if (is_reciprocal(model)) {
        lobe_report_error(report, "reciprocity", w->reciprocity, LIMIT, "%d pairs", checks);
    }
    if (model->twin != NULL) {
        lobe_report_error(report, "precision", fmax(w->precision_density, w->precision_value),
                          LIMIT, "density %.3g, value %.3g", w->precision_density,
                          w->precision_value);
    }
    lobe_report_error(report, "length", w->length, LIMIT, "of the drawn directions");
    if (has_two_sides(model)) return;
    lobe_report_error(report, "support", (double)w->below / checks, 0, "%d directions below",
                      checks);
}

void lobe_test_directions(const lobe_verify_model *model, const lobe_settings *settings,
                          lobe_report *report) {
    pair p;
    prepare_pair(&p, model, model->wi);
    worst w = {0};
    for (int i = 0; i < settings->checks; ++i) {
        double u[3], wo[3];
        lobe_random_numbers(model, settings, (uint64_t)i, u);
        lobe_verify_draw draw = model->sample(&p.state, u);
        if (draw.pdf > 0) {
            check_draw(&p, &draw, &w);
            check_precision(&p, draw.wo, &w);
            check_reciprocity(&p, draw.wo, &w);
        }
        lobe_hemisphere_direction(model, settings, (uint64_t)i, wo);
        if (has_two_sides(model) && i % 2 == 1) wo[2] = -wo[2];
        check_precision(&p, wo, &w);
        check_reciprocity(&p, wo, &w);
        if (!has_two_sides(model)) check_support(&p, wo, &w);
    }
    report_directions(model, &w, settings->checks, report);
}
