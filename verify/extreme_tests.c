/* Special numbers in every argument, and the exact mirror. */
#include <float.h>
#include <math.h>

#include "draws.h"
#include "tests.h"

static const double SPECIAL[] = {
    0.0, -0.0, FLT_TRUE_MIN, DBL_TRUE_MIN, FLT_MIN,  -FLT_MIN, FLT_EPSILON, 0.5, 1 - 0x1p-24,
    1.0, -1.0, 2.0,          FLT_MAX,      -FLT_MAX, INFINITY, -INFINITY,   NAN};
enum { SPECIALS = sizeof SPECIAL / sizeof *SPECIAL };

/* The edges of what is legal: random numbers below 1, directions of unit length. */
static const double LEGAL_U[] = {0, 0x1p-32, 0x1p-24, 0.25, 0.5, 1 - 0x1p-23, 1 - 0x1p-24};
static const double LEGAL_DIRECTION[][3] = {
    {0, 0, 1},     {0, 0, -1},     {1, 0, 0},       {0, -1, 0},   {0.6, 0, 0.8},
    {0, 0.8, 0.6}, {0.6, 0, -0.8}, {-0.8, 0, -0.6}, {1, 0, 1e-8}, {0, -1, 1e-20},
    {0, 1, -1e-8}, {1e-5, 0, 1},   {-1e-20, 0, 1}};
enum {
    LEGAL_US = sizeof LEGAL_U / sizeof *LEGAL_U,
    LEGAL_DIRECTIONS = sizeof LEGAL_DIRECTION / sizeof *LEGAL_DIRECTION
};

static void triple(const double *numbers, int count, int index, double v[3]) {
    v[0] = numbers[index % count];
    v[1] = numbers[index / count % count];
    v[2] = numbers[index / count / count];
}

/* The legal ones of a model: the list, then wi, what it meets head on, and its mirrored ones. */
static int legal_direction(const lobe_verify_model *model, int index, double v[3]) {
    static const double SIGN[4][3] = {{1, 1, 1}, {-1, -1, -1}, {-1, -1, 1}, {1, 1, -1}};
    if (index >= LEGAL_DIRECTIONS + 4) return 0;
    for (int k = 0; k < 3; ++k) {
        v[k] = index < LEGAL_DIRECTIONS ? LEGAL_DIRECTION[index][k]
                                        : SIGN[index - LEGAL_DIRECTIONS][k] * model->wi[k];
    }
    return 1;
}

static int is_number(double x) {
    return isfinite(x) && x >= 0;
}

static int bad_draw(const lobe_verify_model *model, const lobe_verify_state *state,
                    const double u[3]) {
    lobe_verify_draw draw = model->sample(state, u);
    return !lobe_draw_is_sound(&draw);
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

/* Bad results by the argument that was special. */
typedef struct bad_counts {
    int u, wo, wi, parameter;
} bad_counts;

static void try_direction(const lobe_verify_model *model, const lobe_verify_state *state,
                          const double v[3], bad_counts *bad) {
    lobe_verify_state other;
    model->prepare(model->self, v, &other);
    bad->wo += bad_value(model, state, v);
    bad->wi += bad_model(model, &other) + bad_value(model, &other, model->wi);
    double back[3] = {-v[0], -v[1], -v[2]};
    bad->wi += bad_value(model, &other, back);
}

static void try_any_numbers(const lobe_verify_model *model, const lobe_verify_state *state,
                            bad_counts *bad) {
    for (int i = 0; i < SPECIALS * SPECIALS * SPECIALS; ++i) {
        double v[3];
        triple(SPECIAL, SPECIALS, i, v);
        bad->u += bad_draw(model, state, v);
        try_direction(model, state, v, bad);
    }
}

static void try_legal_numbers(const lobe_verify_model *model, const lobe_verify_state *state,
                              bad_counts *bad) {
    double v[3];
    for (int i = 0; i < LEGAL_US * LEGAL_US * LEGAL_US; ++i) {
        triple(LEGAL_U, LEGAL_US, i, v);
        bad->u += bad_draw(model, state, v);
    }
    for (int i = 0; legal_direction(model, i, v); ++i) try_direction(model, state, v, bad);
}

void lobe_test_extreme(const lobe_verify_model *model, lobe_report *report) {
    lobe_verify_state state;
    model->prepare(model->self, model->wi, &state);
    bad_counts bad = {0};
    try_legal_numbers(model, &state, &bad);
    if (!model->takes_legal_only) try_any_numbers(model, &state, &bad);
    lobe_verify_state special;
    for (size_t i = 0; model->prepare_special != NULL &&
                       model->prepare_special(model->self, model->wi, i, &special);
         ++i) {
        bad.parameter += bad_model(model, &special);
    }
    lobe_report_error(report, "extreme", bad.u + bad.wo + bad.wi + bad.parameter, 0,
                      "u %d, wo %d, wi %d, parameters %d", bad.u, bad.wo, bad.wi, bad.parameter);
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
