/* tests/verify/test_draws.c: many random numbers, draws and values are those of one at a time. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/verify/support.h"
#include "verify/dielectric_model.h"
#include "verify/draws.h"
#include "verify/tally.h"

enum { COUNT = 1000 };

static void numbers_agree(void **state) {
    (void)state;
    static double many[3 * COUNT];
    lobe_verify_model model = lobe_verify_plain_model();
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    settings.stream = 7;
    for (int bits = 24; bits <= 53; bits += 29) {
        model.random_bits = bits;
        for (uint64_t first = 0; first < 6; ++first) {
            lobe_many_random_numbers(&model, &settings, first, COUNT - first, many);
            for (uint64_t i = 0; i < COUNT - first; ++i) {
                double u[3];
                lobe_random_numbers(&model, &settings, first + i, u);
                assert_memory_equal(u, many + 3 * i, sizeof u);
                for (int k = 0; k < 3; ++k) assert_true(u[k] >= 0 && u[k] < 1);
            }
        }
    }
}

static int batches;

static lobe_reflection_subject subject;

static void sample_many(const lobe_verify_state *state, size_t count, const double *u,
                        lobe_verify_draw *draws) {
    batches += 1;
    for (size_t i = 0; i < count; ++i) draws[i] = subject.model.sample(state, u + 3 * i);
}

static void tally(const lobe_verify_model *model, const lobe_bins *bins, lobe_tally *result) {
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    settings.draws = 99999;
    lobe_monitor monitor = {.total_draws = 1};
    assert_true(lobe_tally_make(result, model, bins, &settings, &monitor));
}

/* A model's own batches are what is tallied. */
static void batches_are_used(void **state) {
    (void)state;
    lobe_reflection_subject_make(&subject, ggx_parameters(LOBE_METHOD_BOUNDED, 0.3, 0.8, 55, 40),
                                 LOBE_PRECISION_F32);
    lobe_bins bins;
    assert_true(lobe_bins_make(&bins, &subject.model, 8, 2));
    lobe_tally one, many;
    subject.model.sample_many = NULL;
    tally(&subject.model, &bins, &one);
    lobe_verify_model model = subject.model;
    model.sample_many = sample_many;
    tally(&model, &bins, &many);
    assert_true(batches > 100 && batches < 1000);
    assert_memory_equal(one.counts, many.counts, (bins.count + 1) * sizeof *one.counts);
    assert_true(one.weight_sum == many.weight_sum);
    lobe_tally_free(&one);
    lobe_tally_free(&many);
    lobe_bins_free(&bins);
}

static void compare_with_batches(const lobe_verify_model *model) {
    static double u[3 * COUNT], wo[3 * COUNT], density[COUNT], value[COUNT];
    static lobe_verify_draw draws[COUNT];
    lobe_verify_state prepared;
    model->prepare(model->self, model->wi, &prepared);
    const lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    lobe_many_random_numbers(model, &settings, 0, COUNT, u);
    assert_non_null(model->sample_many);
    lobe_draw_many(model, &prepared, COUNT, u, draws);
    for (int i = 0; i < COUNT; ++i) {
        const lobe_verify_draw one = model->sample(&prepared, u + 3 * i);
        assert_memory_equal(&one, &draws[i], sizeof one);
        memcpy(wo + 3 * i, one.wo, sizeof one.wo);
    }
    assert_non_null(model->evaluate_many);
    lobe_evaluate_many(model, &prepared, COUNT, wo, density, value);
    for (int i = 0; i < COUNT; ++i) {
        const double d = model->density(&prepared, wo + 3 * i);
        const double v = model->value(&prepared, wo + 3 * i);
        assert_memory_equal(&d, &density[i], sizeof d);
        assert_memory_equal(&v, &value[i], sizeof v);
    }
}

/* The library's batches give the bits of its single calls. */
static void batches_are_the_calls(void **state) {
    (void)state;
    for (int row = 0; row < lobe_model_count(); ++row) {
        for (int precision = 0; precision < LOBE_PRECISION_COUNT; ++precision) {
            lobe_reflection_parameters parameters =
                ggx_parameters(LOBE_METHOD_CAPS, 0.3, 0.8, 75, 40);
            parameters.options.model = lobe_model_at(row);
            lobe_reflection_subject_make(&subject, parameters, (lobe_precision)precision);
            compare_with_batches(&subject.model);
        }
    }
}

/* A thin wall, too, whose transmission is a point mass. */
static void batches_are_the_calls_of_dielectrics(void **state) {
    (void)state;
    for (int k = 0; k < 2 * LOBE_PRECISION_COUNT; ++k) {
        lobe_dielectric_parameters parameters = {
            lobe_dielectric_default_options(), 0.3, 0.8, 1.5, 60, 40};
        parameters.options.thin = k % 2;
        lobe_dielectric_subject glass;
        lobe_dielectric_subject_make(&glass, parameters, (lobe_precision)(k / 2));
        compare_with_batches(&glass.model);
    }
}

static void soundness_is_what_every_draw_promises(void **state) {
    (void)state;
    lobe_verify_draw right = {{0, 0.6, 0.8}, 0.5, 1}, draw = right;
    assert_true(lobe_draw_is_sound(&draw));
    draw.weight = -1e-300;
    assert_false(lobe_draw_is_sound(&draw));
    draw = right;
    draw.pdf = NAN;
    assert_false(lobe_draw_is_sound(&draw));
    draw = right;
    draw.wo[1] = INFINITY;
    assert_false(lobe_draw_is_sound(&draw));
    draw = right;
    draw.pdf = 0;
    assert_false(lobe_draw_is_sound(&draw));
    draw.weight = 0;
    assert_true(lobe_draw_is_sound(&draw));
}

/* A lobe of a thousandth of a radian without any tail about a direction d: the density falls with
 * the square of the chord s to 0 at s = R. Solid angle is pi d(s^2), so its integral is 1. */
static const double R2 = 1e-6;
static const double PI = 3.14159265358979323846;
static const double D[3] = {0.48, -0.36, 0.8};
static const double P[3] = {0.6, 0.8, 0}, Q[3] = {-0.64, 0.48, 0.6}; /* across d */

static void needle_prepare(const void *self, const double wi[3], lobe_verify_state *state) {
    (void)self, (void)wi, (void)state;
}

static double needle_density(const lobe_verify_state *state, const double wo[3]) {
    (void)state;
    double x = wo[0] - D[0], y = wo[1] - D[1], z = wo[2] - D[2];
    return fmax(1 - (x * x + y * y + z * z) / R2, 0) * 2 / (PI * R2);
}

static lobe_verify_draw needle_sample(const lobe_verify_state *state, const double u[3]) {
    double s2 = R2 * (1 - sqrt(1 - u[0]));
    double c = cos(2 * PI * u[1]) * sqrt(s2 * (1 - s2 / 4));
    double s = sin(2 * PI * u[1]) * sqrt(s2 * (1 - s2 / 4));
    lobe_verify_draw draw = {{0, 0, 0}, 0, 1};
    for (int k = 0; k < 3; ++k) draw.wo[k] = (1 - s2 / 2) * D[k] + c * P[k] + s * Q[k];
    draw.pdf = needle_density(state, draw.wo);
    return draw;
}

static void pilot_draws_find_a_narrow_lobe(void **state) {
    (void)state;
    lobe_verify_model model = lobe_verify_plain_model();
    model.prepare = needle_prepare;
    model.sample = needle_sample;
    model.density = needle_density;
    model.value = needle_density;
    lobe_bins blind, guided;
    assert_true(lobe_bins_make(&blind, &model, 16, 2));
    model.pilot_draws = 65536;
    assert_true(lobe_bins_make(&guided, &model, 16, 2));
    assert_true(blind.density == 0);
    if (!(fabs(guided.density - 1) < 1e-5)) fail_msg("integral %.9g", guided.density);
    double area = 0;
    for (size_t i = 0; i < guided.count; ++i) area += guided.area[i];
    assert_true(fabs(area - 3.14159265358979323846) < 1e-12);
    lobe_bins_free(&blind);
    lobe_bins_free(&guided);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_agree),
                                       cmocka_unit_test(batches_are_used),
                                       cmocka_unit_test(batches_are_the_calls),
                                       cmocka_unit_test(batches_are_the_calls_of_dielectrics),
                                       cmocka_unit_test(soundness_is_what_every_draw_promises),
                                       cmocka_unit_test(pilot_draws_find_a_narrow_lobe)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
