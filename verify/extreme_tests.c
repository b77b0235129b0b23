/* Special numbers in every argument, and the exact mirror. */
#include <float.h>
#include <math.h>

#include "tests.h"

static const double SPECIAL[] = {
    0.0, -0.0, FLT_TRUE_MIN, DBL_TRUE_MIN, FLT_MIN,  -FLT_MIN, FLT_EPSILON, 0.5, 1 - 0x1p-24,
    1.0, -1.0, 2.0,          FLT_MAX,      -FLT_MAX, INFINITY, -INFINITY,   NAN};
enum { SPECIALS = sizeof SPECIAL / sizeof *SPECIAL, TRIPLES = SPECIALS * SPECIALS * SPECIALS };

static void triple(int index, double v[3]) {
    v[0] = SPECIAL[index % SPECIALS];
    v[1] = SPECIAL[index / SPECIALS % SPECIALS];
    v[2] = SPECIAL[index / SPECIALS / SPECIALS];
}

static int is_number(double x) {
    return isfinite(x) && x >= 0;
}

/* Whether a draw breaks a promise: finite throughout, no weight without a density. */
static int is_bad_draw(const lobe_verify_draw *draw) {
    int is_finite = isfinite(draw->wo[0]) && isfinite(draw->wo[1]) && isfinite(draw->wo[2]);
    return !is_finite || !is_number(draw->pdf) || !is_number(draw->weight) ||
           (draw->pdf == 0 && draw->weight != 0);
}

static int bad_draw(const lobe_verify_model *model, const lobe_verify_state *state,
                    const double u[3]) {
    lobe_verify_draw draw = model->sample(state, u);
    return is_bad_draw(&draw);
}

static int bad_value(const lobe_verify_model *model, const lobe_verify_state *state,
                     const double wo[3]) {
    return !is_number(model->density(state, wo)) || !is_number(model->value(state, wo));
}

/* A few ordinary arguments for a model that was prepared from special ones. */
static int bad_model(const lobe_verify_model *model, const lobe_verify_state *state) {
    static const double U[4][3] = {
        {0.3, 0.6, 0.5}, {0, 0, 0}, {0.99999994, 0.99999994, 0}, {0, 0.5, 0}};
    static const double WO[4][3] = {{0, 0, 1}, {0.6, 0, 0.8}, {0, -1, 1e-6}, {0.8, 0, -0.6}};
    int bad = 0;
    for (int i = 0; i < 4; ++i)
        bad += bad_draw(model, state, U[i]) + bad_value(model, state, WO[i]);
    return bad;
}

void lobe_test_extreme(const lobe_verify_model *model, lobe_report *report) {
    lobe_verify_state state;
    model->prepare(model->self, model->wi, &state);
    int bad_u = 0, bad_wo = 0, bad_wi = 0, bad_parameter = 0;
    for (int i = 0; i < TRIPLES; ++i) {
        double v[3];
        triple(i, v);
        bad_u += bad_draw(model, &state, v);
        bad_wo += bad_value(model, &state, v);
        lobe_verify_state other;
        model->prepare(model->self, v, &other);
        bad_wi += bad_model(model, &other);
    }
    lobe_verify_state special;
    for (size_t i = 0; model->prepare_special != NULL &&
                       model->prepare_special(model->self, model->wi, i, &special);
         ++i) {
        bad_parameter += bad_model(model, &special);
    }
    lobe_report_error(report, "extreme", bad_u + bad_wo + bad_wi + bad_parameter, 0,
                      "u %d, wo %d, wi %d, parameters %d", bad_u, bad_wo, bad_wi, bad_parameter);
}

/* Every draw is the mirrored direction with weight 1, or rejected where that lies below. */
void lobe_test_mirror(const lobe_verify_model *model, const lobe_settings *settings,
                      lobe_report *report) {
    lobe_verify_state state;
    model->prepare(model->self, model->wi, &state);
    const double *wi = model->wi;
    double mirrored[3] = {-wi[0], -wi[1], wi[2]};
    double expected = wi[2] > 0 ? 1 : 0;
    double worst = 0;
    for (int i = 0; i < settings->checks; ++i) {
        double u[3];
        lobe_random_numbers(model, settings, (uint64_t)i, u);
        lobe_verify_draw draw = model->sample(&state, u);
        double error = fabs(draw.weight - expected) + fabs(draw.pdf - expected) +
                       model->density(&state, draw.wo) + model->value(&state, draw.wo);
        for (int k = 0; k < 3; ++k) error += expected * fabs(draw.wo[k] - mirrored[k]);
        worst = lobe_worse(worst, error);
    }
    lobe_report_error(report, "mirror", worst, 4 * model->rounding, "%d draws", settings->checks);
}
