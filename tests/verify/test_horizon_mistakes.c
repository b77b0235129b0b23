/* tests/verify/test_horizon_mistakes.c: mistakes that are easily made in horizon sampling. Each is the library's
 * own sampler beside a density with the mistake; the engine accepts the pair without it, and with it the
 * named test of `--quick` fails. */
#include "kernel/bind/c_f64.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/ggx_horizon.h"
#include "kernel/ggx_horizon_mirror.h"
#include "kernel/ggx_horizon_uniform.h"
#include "tests/verify/support.h"

/* The right model; one at a time. */
static lobe_reflection_subject right;

static const double SAMPLERS_FLOOR = 0.1, OTHER_FLOOR = 0.25;

static ggx_base base_of(const lobe_verify_state *state, double floor_share) {
    const lobe_reflection_f64 *r = (const void *)state->bytes;
    facet_options options = facet_options_of(false, false);
    options.floor_share = floor_share;
    return ggx_base_of(v3_of(r->wi.x, r->wi.y, r->wi.z), r->alpha_x, r->alpha_y, options);
}

static facet_pair pair_of(ggx_base g, const double wo[3]) {
    return ggx_pair_of_wo(g, v3_of(wo[0], wo[1], wo[2]));
}

static double usable(facet_pair pair, double pdf) {
    return pair.leaves ? k_usable(pdf) : 0;
}

/* D/(4 L a b) in place of D/(4 L a b nu). */
static double density_without_nu(const lobe_verify_state *state, const double wo[3]) {
    ggx_base g = base_of(state, 1);
    facet_pair pair = pair_of(g, wo);
    ggx_horizon_mirror s = ggx_horizon_mirror_prepare(g);
    return usable(pair, s.f.nu * ggx_horizon_mirror_pdf(s, pair));
}

/* The axes of the ellipse exchanged, their lengths not. */
static double density_of_exchanged_axes(const lobe_verify_state *state, const double wo[3]) {
    ggx_base g = base_of(state, SAMPLERS_FLOOR);
    facet_pair pair = pair_of(g, wo);
    ggx_horizon s = ggx_horizon_prepare(g);
    v3 e1 = s.f.e1;
    s.f.e1 = s.f.e2;
    s.f.e2 = e1;
    return usable(pair, ggx_horizon_pdf(s, pair));
}

/* Shadowing followed down to another floor than the sampler's. */
static double density_of_other_floor(const lobe_verify_state *state, const double wo[3]) {
    ggx_base g = base_of(state, OTHER_FLOOR);
    facet_pair pair = pair_of(g, wo);
    return usable(pair, ggx_horizon_pdf(ggx_horizon_prepare(g), pair));
}

/* |d|^2 held to 0.98 by the sampler only. */
static double density_of_unclamped_shift(const lobe_verify_state *state, const double wo[3]) {
    ggx_base g = base_of(state, 1);
    facet_pair pair = pair_of(g, wo);
    ggx_horizon_uniform s = ggx_horizon_uniform_prepare(g);
    ggx_horizon_height at = ggx_horizon_height_of(s.set, pair, pair.wo.z);
    ggx_horizon_angle e = ggx_horizon_angle_of(v3_dot(at.w, s.back.d1), v3_dot(at.w, s.back.d2));
    double inv = 1 / (at.v + at.rest * s.squeeze), reach = sqrt(at.rest * inv);
    ggx_horizon_shift d = {s.f.k1 * reach, s.f.k2 * reach, (at.v + at.rest * s.slack) * inv};
    double z = ggx_horizon_disk_z(s.f, at.v, at.rest, e);
    double spread = ggx_horizon_spread(ggx_horizon_shift_density(d, e.c, e.s), z, at.im);
    return usable(pair, ggx_horizon_density(s.set, pair, spread));
}

typedef struct mistake {
    const char *name;
    double (*density)(const lobe_verify_state *state, const double wo[3]);
    int is_consistent; /* the draws tell the wrong density too */
    const char *test;  /* the one that is meant to see it */
    lobe_method method;
    double alpha_x, alpha_y, theta, phi;
} mistake;

static const mistake MISTAKES[] = {
    {"nu left out", density_without_nu, 1, "normalization", LOBE_METHOD_HORIZON_MIRROR, 0.4, 0.7,
     40, 30},
    {"nu left out, chi^2", density_without_nu, 1, "chi2", LOBE_METHOD_HORIZON_EXACT, 0.4, 0.7, 40,
     30},
    {"nu left out, the draws not", density_without_nu, 0, "density", LOBE_METHOD_HORIZON_MIRROR,
     0.4, 0.7, 40, 30},
    {"axes exchanged", density_of_exchanged_axes, 1, "chi2", LOBE_METHOD_HORIZON, 0.3, 0.9, 50, 30},
    {"axes exchanged, integral", density_of_exchanged_axes, 1, "normalization", LOBE_METHOD_HORIZON,
     0.3, 0.9, 50, 30},
    {"other floor", density_of_other_floor, 1, "chi2", LOBE_METHOD_HORIZON, 0.4, 0.7, 60, 30},
    {"other floor, the draws not", density_of_other_floor, 0, "density", LOBE_METHOD_HORIZON, 0.4,
     0.7, 60, 30},
    {"shift held by the sampler only", density_of_unclamped_shift, 0, "density",
     LOBE_METHOD_HORIZON_UNIFORM, 0.6, 0.6, 100, 30},
};
enum { MISTAKE_COUNT = sizeof MISTAKES / sizeof *MISTAKES };

static double (*told)(const lobe_verify_state *state, const double wo[3]);

static lobe_verify_draw consistent_sample(const lobe_verify_state *state, const double u[3]) {
    lobe_verify_draw draw = right.model.sample(state, u);
    if (draw.pdf > 0) {
        draw.pdf = told(state, draw.wo);
        draw.weight = draw.pdf > 0 ? right.model.value(state, draw.wo) / draw.pdf : 0;
    }
    return draw;
}

static void check(const mistake *m, int is_made, lobe_report *report) {
    lobe_reflection_parameters parameters =
        ggx_parameters(m->method, m->alpha_x, m->alpha_y, m->theta, m->phi);
    parameters.options.floor = SAMPLERS_FLOOR;
    lobe_reflection_subject_make(&right, parameters, LOBE_PRECISION_F64);
    lobe_verify_model model = right.model;
    call_one_by_one(&model);
    if (is_made) {
        model.density = m->density;
        told = m->density;
        if (m->is_consistent) model.sample = consistent_sample;
    }
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    settings.p_limit = LIST_P_LIMIT;
    run_engine(&model, &settings, report);
    print_message("%s: ", is_made ? m->name : "no mistake");
    print_failures(&model, report);
}

static void mistakes_are_rejected(void **state) {
    (void)state;
    for (int i = 0; i < MISTAKE_COUNT; ++i) {
        lobe_report report;
        check(&MISTAKES[i], 1, &report);
        const lobe_report_row *row = find_row(&report, MISTAKES[i].test);
        assert_non_null(row);
        if (lobe_report_row_passed(row))
            fail_msg("%s: %s saw nothing", MISTAKES[i].name, row->test);
    }
}

static void the_same_without_are_accepted(void **state) {
    (void)state;
    for (int i = 0; i < MISTAKE_COUNT; ++i) {
        lobe_report report;
        check(&MISTAKES[i], 0, &report);
        assert_int_equal(count_failures(&report), 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(mistakes_are_rejected),
                                       cmocka_unit_test(the_same_without_are_accepted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
