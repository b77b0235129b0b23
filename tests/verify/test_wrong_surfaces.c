/* tests/verify/test_wrong_surfaces.c: mistakes in Beckmann and V-cavities. Each model is the library's own with
 * one defect; the engine accepts it without and rejects it with, by the test that is meant to see it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "tests/verify/support.h"

/* The right model that the defective functions call; one at a time. */
static lobe_reflection_subject right;
static lobe_reflection_f64 other; /* what a wrong sampler draws from */

static lobe_vec3_f64 vector(const double v[3]) {
    return (lobe_vec3_f64){v[0], v[1], v[2]};
}

/* A draw that agrees with the density and the value of the model: nothing is given away. */
static lobe_verify_draw sample_other(const lobe_verify_state *state, const double u[3]) {
    lobe_reflection_draw_f64 d = lobe_reflection_sample_f64(&other, u[0], u[1], u[2]);
    lobe_verify_draw draw = {{d.wo.x, d.wo.y, d.wo.z}, 0, 0};
    draw.pdf = right.model.density(state, draw.wo);
    draw.weight = draw.pdf > 0 ? right.model.value(state, draw.wo) / draw.pdf : 0;
    return draw;
}

static void draws_from(lobe_verify_model *model, lobe_reflection_options options, double alpha_y) {
    other =
        lobe_reflection_prepare_f64(options, vector(model->wi), right.parameters.alpha_x, alpha_y);
    model->sample = sample_other;
}

static void draws_by(lobe_verify_model *model, lobe_masking masking, lobe_method method) {
    lobe_reflection_options options = right.parameters.options;
    options.model.masking = masking;
    options.model.method = method;
    draws_from(model, options, right.parameters.alpha_y);
}

/* Both sides of a groove alike, also the one that is not seen. */
static void either_side(lobe_verify_model *model) {
    draws_by(model, LOBE_MASKING_VCAVITY, LOBE_METHOD_NDF);
}

/* The side that leaves, and the density of any side. */
static void side_that_leaves(lobe_verify_model *model) {
    draws_by(model, LOBE_MASKING_VCAVITY, LOBE_METHOD_VCAVITY_VALID);
}

/* Any side, and the density of the one that leaves. */
static void any_side(lobe_verify_model *model) {
    draws_by(model, LOBE_MASKING_VCAVITY, LOBE_METHOD_VCAVITY);
}

/* What a Smith surface shows instead of what a V-cavity does. */
static void smith_beckmann(lobe_verify_model *model) {
    draws_by(model, LOBE_MASKING_SMITH, LOBE_METHOD_NEWTON);
}

static void smith_ggx_caps(lobe_verify_model *model) {
    draws_by(model, LOBE_MASKING_SMITH, LOBE_METHOD_CAPS);
}

/* A Gaussian of variance 1 for the slopes across: theirs is 1/2. */
static void standard_gaussian(lobe_verify_model *model) {
    draws_from(model, right.parameters.options, right.parameters.alpha_y * sqrt(2));
}

/* Slopes of the other distribution. */
static void slopes_of_ggx(lobe_verify_model *model) {
    lobe_reflection_options options = right.parameters.options;
    options.model = (lobe_model){LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_METHOD_SLOPE};
    draws_from(model, options, right.parameters.alpha_y);
}

/* The masking function for a normaliser, also from behind. */
static void previous_normalization(lobe_verify_model *model) {
    static lobe_reflection_parameters previous;
    previous = right.parameters;
    previous.options.normalization = LOBE_NORMALIZATION_PREVIOUS;
    model->self = &previous;
}

/* Only from above the masking of both directions: value too bright from behind. */
static double value_without_shadowing(const lobe_verify_state *state, const double wo[3]) {
    lobe_reflection_eval_f64 e =
        lobe_reflection_eval_wo_f64((const void *)state->bytes, vector(wo));
    return e.g2 > 0 ? e.f_cos * e.g1_i / e.g2 : 0;
}

static double (*wrong_value)(const lobe_verify_state *state, const double wo[3]);

static lobe_verify_draw sample_wrong_value(const lobe_verify_state *state, const double u[3]) {
    lobe_verify_draw draw = right.model.sample(state, u);
    if (draw.pdf > 0) draw.weight = wrong_value(state, draw.wo) / draw.pdf;
    return draw;
}

static void set_value(lobe_verify_model *model,
                      double (*value)(const lobe_verify_state *state, const double wo[3])) {
    wrong_value = value;
    model->value = value;
    model->sample = sample_wrong_value;
}

static void without_shadowing(lobe_verify_model *model) {
    set_value(model, value_without_shadowing);
}

/* The rational fit of Beckmann's G1 that renderers use, off by up to 0.3 %. */
static double fitted_g1(double a) {
    if (a >= 1.6) return 1;
    return (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a);
}

static double value_of_the_fit(const lobe_verify_state *state, const double wo[3]) {
    lobe_reflection_eval_f64 e =
        lobe_reflection_eval_wo_f64((const void *)state->bytes, vector(wo));
    double a = wo[2] / (right.parameters.alpha_x * sqrt(fmax(1 - wo[2] * wo[2], 1e-30)));
    return e.g1_o > 0 ? e.f_cos * fitted_g1(a) / e.g1_o : 0;
}

static void rational_fit(lobe_verify_model *model) {
    set_value(model, value_of_the_fit);
}

/* cot(theta) where the direction has rounded to the normal. */
static lobe_verify_draw sample_by_cotangent(const lobe_verify_state *state, const double u[3]) {
    const lobe_reflection_f64 *prepared = (const void *)state->bytes;
    lobe_verify_draw draw = right.model.sample(state, u);
    double sine = sqrt(1 - prepared->wi.z * prepared->wi.z);
    if (sine == 0) draw.wo[0] += 0 / sine;
    return draw;
}

static void cotangent_at_the_pole(lobe_verify_model *model) {
    model->sample = sample_by_cotangent;
}

typedef struct wrong_model {
    const char *name;
    void (*damage)(lobe_verify_model *model);
    const char *test; /* the one that is meant to see it */
    lobe_model row;
    double alpha_x, alpha_y, theta, phi;
} wrong_model;

#define ROW(NDF, MASKING, METHOD)                                                                  \
    { LOBE_NDF_##NDF, LOBE_MASKING_##MASKING, LOBE_METHOD_##METHOD }

static const wrong_model WRONG[] = {
    {"either side of a groove", either_side, "chi2", ROW(GGX, VCAVITY, VCAVITY), 0.4, 0.4, 50, 20},
    {"density of any side", side_that_leaves, "rejected", ROW(GGX, VCAVITY, VCAVITY), 0.4, 0.4, 60,
     20},
    {"density of any side, Beckmann", side_that_leaves, "chi2", ROW(BECKMANN, VCAVITY, VCAVITY),
     0.3, 0.5, 70, 20},
    {"density of the side that leaves", any_side, "rejected", ROW(GGX, VCAVITY, VCAVITY_VALID), 0.4,
     0.4, 60, 20},
    {"Smith's normals", smith_ggx_caps, "chi2", ROW(GGX, VCAVITY, VCAVITY), 0.5, 0.5, 60, 0},
    {"Smith's normals, Beckmann", smith_beckmann, "chi2", ROW(BECKMANN, VCAVITY, VCAVITY), 0.5, 0.5,
     95, 0},
    {"a Gaussian of variance 1", standard_gaussian, "chi2", ROW(BECKMANN, SMITH, NEWTON), 0.3, 0.3,
     40, 0},
    {"slopes of GGX", slopes_of_ggx, "chi2", ROW(BECKMANN, SMITH, SLOPE), 0.3, 0.3, 40, 0},
    {"previous normalisation, Beckmann", previous_normalization, "normalization",
     ROW(BECKMANN, SMITH, NEWTON), 0.4, 0.7, 110, 20},
    {"previous normalisation, Beckmann, chi^2", previous_normalization, "chi2",
     ROW(BECKMANN, SMITH, HORIZON), 0.4, 0.7, 110, 20},
    {"hit probability left out", previous_normalization, "normalization",
     ROW(GGX, VCAVITY, VCAVITY), 0.4, 0.7, 110, 20},
    {"hit probability left out, chi^2", previous_normalization, "chi2",
     ROW(BECKMANN, VCAVITY, VCAVITY_VALID), 0.4, 0.7, 110, 20},
    {"V-cavities without shadowing", without_shadowing, "reciprocity", ROW(GGX, VCAVITY, VCAVITY),
     0.4, 0.4, 60, 0},
    {"rational fit of G1", rational_fit, "albedo", ROW(BECKMANN, SMITH, NEWTON), 1, 1, 0, 0},
    {"cot 0", cotangent_at_the_pole, "sound", ROW(BECKMANN, SMITH, NEWTON), 0.3, 0.3, 0, 0},
};
enum { WRONG_COUNT = sizeof WRONG / sizeof *WRONG };

static void check(const wrong_model *wrong, int is_damaged, lobe_report *report) {
    lobe_reflection_parameters parameters =
        ggx_parameters(wrong->row.method, wrong->alpha_x, wrong->alpha_y, wrong->theta, wrong->phi);
    parameters.options.model = wrong->row;
    lobe_reflection_subject_make(&right, parameters, LOBE_PRECISION_F64);
    lobe_verify_model model = right.model;
    call_one_by_one(&model);
    if (is_damaged) wrong->damage(&model);
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    settings.p_limit = LIST_P_LIMIT;
    run_engine(&model, &settings, report);
    print_message("%s: ", is_damaged ? wrong->name : "no defect");
    print_failures(&model, report);
}

static void wrong_models_are_rejected(void **state) {
    (void)state;
    for (int i = 0; i < WRONG_COUNT; ++i) {
        lobe_report report;
        check(&WRONG[i], 1, &report);
        const lobe_report_row *row = find_row(&report, WRONG[i].test);
        assert_non_null(row);
        if (lobe_report_row_passed(row)) fail_msg("%s: %s saw nothing", WRONG[i].name, row->test);
    }
}

static void the_same_models_without_a_defect_are_accepted(void **state) {
    (void)state;
    for (int i = 0; i < WRONG_COUNT; ++i) {
        lobe_report report;
        check(&WRONG[i], 0, &report);
        assert_int_equal(count_failures(&report), 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_models_are_rejected),
        cmocka_unit_test(the_same_models_without_a_defect_are_accepted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
