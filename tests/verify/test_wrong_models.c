/* tests/verify/test_wrong_models.c: the engine can fail. Each model is the library's own with one defect; the
 * engine must accept it without the defect and reject it with, by the test that is meant to see
 * it. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "tests/verify/support.h"

/* The right model that the defective functions call; one at a time. */
static lobe_reflection_subject right;
static double factor;

static const lobe_reflection_f64 *prepared(const lobe_verify_state *state) {
    return (const void *)state->bytes;
}

static lobe_reflection_eval_f64 eval(const lobe_verify_state *state, const double wo[3]) {
    return lobe_reflection_eval_wo_f64(prepared(state), (lobe_vec3_f64){wo[0], wo[1], wo[2]});
}

/* A draw that keeps up with a defective density or value: the defect is not given away by the
 * draw's own numbers. */
static double (*wrong_density)(const lobe_verify_state *state, const double wo[3]);
static double (*wrong_value)(const lobe_verify_state *state, const double wo[3]);

static lobe_verify_draw consistent(const lobe_verify_state *state, lobe_verify_draw draw) {
    if (draw.pdf > 0) {
        draw.pdf = wrong_density(state, draw.wo);
        draw.weight = draw.pdf > 0 ? wrong_value(state, draw.wo) / draw.pdf : 0;
    }
    return draw;
}

static lobe_verify_draw consistent_sample(const lobe_verify_state *state, const double u[3]) {
    return consistent(state, right.model.sample(state, u));
}

static void make_consistent(lobe_verify_model *model) {
    wrong_density = model->density;
    wrong_value = model->value;
    model->sample = consistent_sample;
}

/* Density of the normal returned as the density of the direction. */
static double density_without_jacobian(const lobe_verify_state *state, const double wo[3]) {
    lobe_reflection_eval_f64 e = eval(state, wo);
    return e.pdf > 0 ? e.pdf_m : 0;
}

static void without_jacobian(lobe_verify_model *model) {
    model->density = density_without_jacobian;
    make_consistent(model);
}

/* Visible normals without their normaliser: <i,m> D / i_z. */
static double density_without_g1(const lobe_verify_state *state, const double wo[3]) {
    lobe_reflection_eval_f64 e = eval(state, wo);
    return e.pdf / e.g1_i;
}

static void without_g1(lobe_verify_model *model) {
    model->density = density_without_g1;
    make_consistent(model);
}

static double scaled_density(const lobe_verify_state *state, const double wo[3]) {
    return factor * right.model.density(state, wo);
}

/* The sampler cuts its cap by k, the density by the k of the larger roughness. */
static double cap_height(double a) {
    const double *wi = right.model.wi;
    double s = 1 + sqrt(wi[0] * wi[0] + wi[1] * wi[1]);
    double k = (1 - a * a) * s * s / (s * s + a * a * wi[2] * wi[2]);
    return 1 + k * wi[2] / right.chart.length;
}

static void other_k(lobe_verify_model *model) {
    const lobe_reflection_parameters *p = &right.parameters;
    factor = cap_height(fmin(p->alpha_x, p->alpha_y)) / cap_height(fmax(p->alpha_x, p->alpha_y));
    model->density = scaled_density;
    make_consistent(model);
}

/* The cap of the sampler ends 1 % above where the density says. */
static lobe_verify_draw sample_shorter_cap(const lobe_verify_state *state, const double u[3]) {
    double shorter[3] = {u[0], 0.99 * u[1], u[2]};
    return right.model.sample(state, shorter);
}

static void shorter_cap(lobe_verify_model *model) {
    model->sample = sample_shorter_cap;
}

/* A sampler in a mirrored frame: the right lobe on the wrong side. */
static lobe_verify_draw sample_flipped(const lobe_verify_state *state, const double u[3]) {
    lobe_verify_draw draw = right.model.sample(state, u);
    draw.wo[1] = -draw.wo[1];
    return consistent(state, draw);
}

static void flipped_azimuth(lobe_verify_model *model) {
    make_consistent(model);
    model->sample = sample_flipped;
}

/* Rejected draws are drawn again, with other numbers, and the density stays as it was. */
static lobe_verify_draw sample_again(const lobe_verify_state *state, const double u[3]) {
    double v[3] = {u[0], u[1], u[2]};
    lobe_verify_draw draw = right.model.sample(state, v);
    for (int i = 0; i < 100 && !(draw.pdf > 0); ++i) {
        v[0] = fmod(v[0] + 0.61803398874989485, 1);
        v[1] = fmod(v[1] + 0.75487766624669276, 1);
        draw = right.model.sample(state, v);
    }
    return draw;
}

static void redrawn(lobe_verify_model *model) {
    model->sample = sample_again;
}

/* The value without shadowing: energy that is not there. */
static double value_without_shadowing(const lobe_verify_state *state, const double wo[3]) {
    lobe_reflection_eval_f64 e = eval(state, wo);
    return e.g2 > 0 ? e.f_cos * e.g1_i / e.g2 : 0;
}

static void without_shadowing(lobe_verify_model *model) {
    model->value = value_without_shadowing;
    make_consistent(model);
}

/* The weight of one G2, the value of the other. */
static lobe_verify_draw sample_separable_weight(const lobe_verify_state *state, const double u[3]) {
    lobe_verify_draw draw = right.model.sample(state, u);
    if (draw.pdf > 0)
        draw.weight *=
            eval(state, draw.wo).g1_o * eval(state, draw.wo).g1_i / eval(state, draw.wo).g2;
    return draw;
}

static void other_g2_in_weight(lobe_verify_model *model) {
    model->sample = sample_separable_weight;
}

/* The value divided by the wrong cosine. */
static double value_of_wrong_cosine(const lobe_verify_state *state, const double wo[3]) {
    return wo[2] > 0 ? right.model.value(state, wo) * prepared(state)->wi.z / wo[2] : 0;
}

static void wrong_cosine(lobe_verify_model *model) {
    model->value = value_of_wrong_cosine;
    make_consistent(model);
}

static double value_a_thousandth_high(const lobe_verify_state *state, const double wo[3]) {
    return 1.001 * right.model.value(state, wo);
}

static void thousandth_too_bright(lobe_verify_model *model) {
    model->value = value_a_thousandth_high;
    make_consistent(model);
}

/* A twin of another roughness, as a wrong conversion of precision would be. */
static void other_twin(lobe_verify_model *model) {
    static lobe_reflection_subject twin;
    lobe_reflection_parameters parameters = right.parameters;
    parameters.alpha_x *= 1.0001;
    lobe_reflection_subject_make(&twin, parameters, LOBE_PRECISION_F64);
    model->rounding = FLT_EPSILON;
    model->twin = &twin.model;
}

static double density_below_too(const lobe_verify_state *state, const double wo[3]) {
    double up[3] = {wo[0], wo[1], fabs(wo[2])};
    return right.model.density(state, up);
}

static void density_below(lobe_verify_model *model) {
    model->density = density_below_too;
}

static lobe_verify_draw sample_nan_at_one(const lobe_verify_state *state, const double u[3]) {
    lobe_verify_draw draw = right.model.sample(state, u);
    if (u[1] == 1) draw.pdf = NAN;
    return draw;
}

static void nan_at_one(lobe_verify_model *model) {
    model->sample = sample_nan_at_one;
}

static lobe_verify_draw sample_black_mirror(const lobe_verify_state *state, const double u[3]) {
    lobe_verify_draw draw = right.model.sample(state, u);
    draw.weight = 0.5;
    return draw;
}

static void black_mirror(lobe_verify_model *model) {
    model->sample = sample_black_mirror;
}

static void promised_bound(lobe_verify_model *model) {
    model->weight_bound = 1;
}

static void previous_normalization(lobe_verify_model *model) {
    static lobe_reflection_parameters previous;
    previous = right.parameters;
    previous.options.normalization = LOBE_NORMALIZATION_PREVIOUS;
    model->self = &previous;
}

static lobe_verify_draw sample_other_pdf(const lobe_verify_state *state, const double u[3]) {
    lobe_verify_draw draw = right.model.sample(state, u);
    draw.pdf *= 1 + 1e-12;
    return draw;
}

static void other_pdf(lobe_verify_model *model) {
    model->sample = sample_other_pdf;
}

static void millionth_too_dense(lobe_verify_model *model) {
    factor = 1 + 1e-6;
    model->density = scaled_density;
    make_consistent(model);
}

static void other_closed_form(lobe_verify_model *model) {
    model->accepted *= 1 + 1e-8;
}

/* A millionth too long: rsqrt without a Newton step. */
static lobe_verify_draw sample_long(const lobe_verify_state *state, const double u[3]) {
    lobe_verify_draw draw = right.model.sample(state, u);
    for (int k = 0; k < 3; ++k) draw.wo[k] *= 1 + 1e-6;
    return draw;
}

static void too_long(lobe_verify_model *model) {
    model->sample = sample_long;
}

static lobe_verify_draw sample_rarely_negative(const lobe_verify_state *state, const double u[3]) {
    lobe_verify_draw draw = right.model.sample(state, u);
    if (u[0] > 0.9999) draw.weight = -draw.weight;
    return draw;
}

static void rarely_negative(lobe_verify_model *model) {
    model->sample = sample_rarely_negative;
}

/* No draw within 3 degrees of the horizon, where a hundredth of the light is. */
static double density_above_horizon(const lobe_verify_state *state, const double wo[3]) {
    return wo[2] > 0.05 ? right.model.density(state, wo) : 0;
}

static void blind_at_the_horizon(lobe_verify_model *model) {
    model->density = density_above_horizon;
    make_consistent(model);
}

static void no_defect(lobe_verify_model *model) {
    (void)model;
}

typedef struct wrong_model {
    const char *name;
    void (*damage)(lobe_verify_model *model);
    const char *test; /* the one that is meant to see it */
    lobe_method method;
    double alpha_x, alpha_y, theta, phi;
} wrong_model;

static const wrong_model WRONG[] = {
    {"density without the Jacobian", without_jacobian, "normalization", LOBE_METHOD_CAPS, 0.4, 0.4,
     40, 20},
    {"density without the Jacobian, chi^2", without_jacobian, "chi2", LOBE_METHOD_NDF, 0.4, 0.4, 40,
     20},
    {"G1 left out", without_g1, "normalization", LOBE_METHOD_ELLIPSOID, 0.5, 0.3, 70, 20},
    {"G1 left out, chi^2", without_g1, "chi2", LOBE_METHOD_SLOPE, 0.5, 0.3, 70, 20},
    {"k of the larger roughness", other_k, "rejected", LOBE_METHOD_BOUNDED, 0.5, 0.6, 40, 20},
    {"cap 1 % short", shorter_cap, "chi2", LOBE_METHOD_CAPS, 0.1, 0.1, 40, 0},
    {"bounded cap 1 % short", shorter_cap, "rejected", LOBE_METHOD_BOUNDED, 0.2, 0.8, 40, 45},
    {"optimal cap 1 % short", shorter_cap, "chi2", LOBE_METHOD_OPTIMAL, 0.2, 0.8, 40, 45},
    {"azimuth flipped", flipped_azimuth, "chi2", LOBE_METHOD_BOUNDED, 0.3, 0.6, 30, 10},
    {"rejected draws redrawn", redrawn, "rejected", LOBE_METHOD_CAPS, 0.3, 0.3, 40, 0},
    {"rejected draws redrawn, furnace", redrawn, "furnace", LOBE_METHOD_NDF, 0.3, 0.3, 40, 0},
    {"value without shadowing", without_shadowing, "reciprocity", LOBE_METHOD_CAPS, 0.5, 0.5, 60,
     0},
    {"weight of the other G2", other_g2_in_weight, "weight", LOBE_METHOD_CAPS, 0.5, 0.5, 60, 0},
    {"divided by the wrong cosine", wrong_cosine, "reciprocity", LOBE_METHOD_CAPS, 0.5, 0.5, 60, 0},
    {"pdf of a draw 1e-12 high", other_pdf, "density", LOBE_METHOD_CAPS, 1, 1, 60, 0},
    {"density 1e-6 high", millionth_too_dense, "uniform", LOBE_METHOD_BOUNDED, 1, 1, 60, 0},
    {"closed form 1e-8 high", other_closed_form, "share", LOBE_METHOD_CAPS, 0.3, 0.3, 0, 0},
    {"value 0.1 % high", thousandth_too_bright, "albedo", LOBE_METHOD_CAPS, 1, 1, 60, 0},
    {"0.01 % off in f32", other_twin, "precision", LOBE_METHOD_CAPS, 0.3, 0.3, 40, 0},
    {"density below the surface", density_below, "support", LOBE_METHOD_CAPS, 0.5, 0.5, 60, 0},
    {"NaN at u = 1", nan_at_one, "extreme", LOBE_METHOD_CAPS, 0.5, 0.5, 60, 0},
    {"half a mirror", black_mirror, "mirror", LOBE_METHOD_CAPS, 0, 0, 40, 0},
    {"a bound that does not hold", promised_bound, "bound", LOBE_METHOD_NDF, 0.5, 0.5, 60, 0},
    {"a millionth too long", too_long, "length", LOBE_METHOD_CAPS, 0.5, 0.5, 60, 0},
    {"negative one time in 10^4", rarely_negative, "sound", LOBE_METHOD_CAPS, 0.5, 0.5, 60, 0},
    {"blind at the horizon", blind_at_the_horizon, "coverage", LOBE_METHOD_CAPS, 0.8, 0.8, 60, 0},
    {"previous normalisation", previous_normalization, "chi2", LOBE_METHOD_CAPS, 0.4, 0.7, 110, 20},
};
enum { WRONG_COUNT = sizeof WRONG / sizeof *WRONG };

static lobe_settings quick_settings(void) {
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    settings.p_limit = LIST_P_LIMIT;
    return settings;
}

static void check(const wrong_model *wrong, void (*damage)(lobe_verify_model *model),
                  lobe_report *report) {
    lobe_reflection_parameters parameters =
        ggx_parameters(wrong->method, wrong->alpha_x, wrong->alpha_y, wrong->theta, wrong->phi);
    lobe_reflection_subject_make(&right, parameters, LOBE_PRECISION_F64);
    lobe_verify_model model = right.model;
    call_one_by_one(&model);
    damage(&model);
    lobe_settings settings = quick_settings();
    run_engine(&model, &settings, report);
    print_message("%s: ", damage == no_defect ? "no defect" : wrong->name);
    print_failures(&model, report);
}

static void wrong_models_are_rejected(void **state) {
    (void)state;
    for (int i = 0; i < WRONG_COUNT; ++i) {
        lobe_report report;
        check(&WRONG[i], WRONG[i].damage, &report);
        const lobe_report_row *row = find_row(&report, WRONG[i].test);
        assert_non_null(row);
        if (lobe_report_row_passed(row)) fail_msg("%s: %s saw nothing", WRONG[i].name, row->test);
    }
}

static int is_meant_to_see_one(const char *test) {
    for (int i = 0; i < WRONG_COUNT; ++i) {
        if (strcmp(WRONG[i].test, test) == 0) return 1;
    }
    return 0;
}

/* And every test that runs has a model to reject: if one were blind, the list above would tell. */
static void the_same_models_without_a_defect_are_accepted(void **state) {
    (void)state;
    for (int i = 0; i < WRONG_COUNT; ++i) {
        lobe_report report;
        check(&WRONG[i], no_defect, &report);
        assert_int_equal(count_failures(&report), 0);
        for (int k = 0; k < report.count; ++k) {
            const char *test = report.rows[k].test;
            if (!is_meant_to_see_one(test)) fail_msg("no wrong model for %s", test);
        }
    }
}

static void every_method_is_accepted(void **state) {
    (void)state;
    for (int row = 0; row < lobe_model_count(); ++row) {
        for (int precision = 0; precision < LOBE_PRECISION_COUNT; ++precision) {
            lobe_reflection_parameters parameters =
                ggx_parameters(LOBE_METHOD_CAPS, 0.3, 0.8, 55, 40);
            parameters.options.model = lobe_model_at(row);
            lobe_reflection_subject_make(&right, parameters, (lobe_precision)precision);
            lobe_settings settings = quick_settings();
            lobe_report report;
            run_engine(&right.model, &settings, &report);
            print_failures(&right.model, &report);
            assert_int_equal(count_failures(&report), 0);
        }
    }
}

/* The rational fit is off by 1e-3 in the distribution: too little for quick, enough for 2 10^6. */
static void published_slopes_fail_at_more_draws(void **state) {
    (void)state;
    lobe_reflection_subject_make(
        &right, ggx_parameters(LOBE_METHOD_SLOPE_PUBLISHED, 0.3, 0.1, 95, 200), LOBE_PRECISION_F64);
    lobe_settings settings = quick_settings();
    settings.draws = 2000000;
    lobe_report report;
    run_engine(&right.model, &settings, &report);
    print_failures(&right.model, &report);
    assert_false(lobe_report_row_passed(find_row(&report, "chi2")));

    lobe_reflection_subject_make(&right, ggx_parameters(LOBE_METHOD_SLOPE, 0.3, 0.1, 95, 200),
                                 LOBE_PRECISION_F64);
    run_engine(&right.model, &settings, &report);
    assert_int_equal(count_failures(&report), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_models_are_rejected),
        cmocka_unit_test(the_same_models_without_a_defect_are_accepted),
        cmocka_unit_test(every_method_is_accepted),
        cmocka_unit_test(published_slopes_fail_at_more_draws)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
