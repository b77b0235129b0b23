/* tests/verify/test_jumps.c: float against double where the density jumps: a side that rounding decides is no
 * error, any other wrong side is. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "tests/verify/support.h"
#include "verify/tests.h"

/* What a model in single precision is asked about are floats, for its twin as well. */
static void directions_are_floats(void **state) {
    (void)state;
    lobe_verify_model model = lobe_verify_plain_model();
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    model.random_bits = 24;
    for (uint64_t k = 0; k < 100; ++k) {
        double wo[3];
        lobe_hemisphere_direction(&model, &settings, k, wo);
        for (int j = 0; j < 3; ++j) {
            volatile float narrow = (float)wo[j];
            assert_true(wo[j] == (double)narrow);
        }
    }
}

/* A density of 1 beyond a plane and 2 on this side of it, a factor on both. Nothing is drawn. */
typedef struct stair {
    double place, factor;
} stair;

static const double AXIS[3] = {0.48, -0.6, 0.64};

static double along_axis(const double wo[3]) {
    return AXIS[0] * wo[0] + AXIS[1] * wo[1] + AXIS[2] * wo[2];
}

static void prepare(const void *self, const double wi[3], lobe_verify_state *state) {
    (void)wi;
    memcpy(state->bytes, self, sizeof(stair));
}

static lobe_verify_draw sample(const lobe_verify_state *state, const double u[3]) {
    (void)state;
    (void)u;
    return (lobe_verify_draw){{0, 0, 1}, 0, 0};
}

static double density(const lobe_verify_state *state, const double wo[3]) {
    stair s;
    memcpy(&s, state->bytes, sizeof s);
    return s.factor * (along_axis(wo) < s.place ? 2 : 1);
}

static lobe_verify_model model_of(const stair *s) {
    lobe_verify_model model = lobe_verify_plain_model();
    model.name = "stair";
    model.configuration = "";
    model.self = s;
    model.wi[2] = 1;
    model.rounding = FLT_EPSILON;
    model.random_bits = 24;
    model.has_jumps = 1;
    model.covers_sphere = 1;
    model.prepare = prepare;
    model.sample = sample;
    model.density = density;
    model.value = density;
    return model;
}

/* The jump of the exact density is just past a direction that is asked about, that of the other one
 * `off` before it. */
static int is_accepted(double off, double factor, int has_jumps) {
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    stair exact = {0, 1};
    lobe_verify_model twin = model_of(&exact);
    double wo[3];
    lobe_hemisphere_direction(&twin, &settings, 8, wo);
    exact.place = along_axis(wo) + 2 * FLT_EPSILON;
    const stair rounded = {exact.place - off, factor};
    lobe_verify_model model = model_of(&rounded);
    model.twin = &twin;
    model.has_jumps = has_jumps;
    lobe_report report = {0};
    lobe_test_directions(&model, &settings, &report);
    const lobe_report_row *row = find_row(&report, "precision");
    assert_non_null(row);
    return lobe_report_row_passed(row);
}

static void rounding_may_decide_a_side(void **state) {
    (void)state;
    assert_true(is_accepted(0, 1, 0));
    assert_true(is_accepted(0, 1, 1));
    assert_true(is_accepted(3 * FLT_EPSILON, 1, 1));
    /* promised to be continuous */
    assert_false(is_accepted(3 * FLT_EPSILON, 1, 0));
}

static void other_errors_are_caught(void **state) {
    (void)state;
    for (int has_jumps = 0; has_jumps < 2; ++has_jumps) {
        /* the wrong side, farther from the jump than rounding reaches */
        assert_false(is_accepted(2, 1, has_jumps));
        assert_false(is_accepted(-0.1, 1, has_jumps));
        /* lost digits, away from the jump and next to it */
        assert_false(is_accepted(0, 1 + 64 * FLT_EPSILON, has_jumps));
        assert_false(is_accepted(3 * FLT_EPSILON, 1 + 64 * FLT_EPSILON, has_jumps));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(directions_are_floats),
                                       cmocka_unit_test(rounding_may_decide_a_side),
                                       cmocka_unit_test(other_errors_are_caught)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
