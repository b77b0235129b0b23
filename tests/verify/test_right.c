/* tests/verify/test_right.c: the engine accepts right models, among them one that is not the
 * library's, and its p-values are uniform: neither blind nor jumpy. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/verify/support.h"
#include "verify/tests.h"

static const double PI = 3.14159265358979323846;

/* Lambert with cosine-weighted draws: nothing but the three functions. */
static void lambert_prepare(const void *self, const double wi[3], lobe_verify_state *state) {
    (void)self;
    memcpy(state->bytes, wi, 3 * sizeof *wi);
}

static double lambert_density(const lobe_verify_state *state, const double wo[3]) {
    (void)state;
    return isfinite(wo[2]) ? fmax(wo[2], 0) / PI : 0;
}

static lobe_verify_draw lambert_sample(const lobe_verify_state *state, const double u[3]) {
    double a = u[0] >= 0 && u[0] < 1 ? u[0] : 0;
    double b = u[1] >= 0 && u[1] < 1 ? u[1] : 0;
    double radius = sqrt(a);
    double z = sqrt(1 - a);
    lobe_verify_draw draw = {{radius * cos(2 * PI * b), radius * sin(2 * PI * b), z}, z / PI, 1};
    draw.pdf = lambert_density(state, draw.wo);
    return draw;
}

static lobe_verify_model lambert(void) {
    lobe_verify_model model = lobe_verify_plain_model();
    model.name = "lambert";
    model.configuration = "albedo=1";
    model.wi[0] = 0.6;
    model.wi[2] = 0.8;
    model.prepare = lambert_prepare;
    model.sample = lambert_sample;
    model.density = lambert_density;
    model.value = lambert_density;
    model.weight_bound = 1;
    model.accepted = 1;
    model.albedo_oracle = 1;
    model.is_reciprocal = 1;
    return model;
}

static void lambert_is_accepted(void **state) {
    (void)state;
    lobe_verify_model model = lambert();
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    settings.p_limit = LIST_P_LIMIT;
    lobe_report report;
    run_engine(&model, &settings, &report);
    print_failures(&model, &report);
    assert_int_equal(count_failures(&report), 0);
    assert_non_null(find_row(&report, "chi2"));
    assert_non_null(find_row(&report, "albedo"));
}

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Kolmogorov-Smirnov distance to the uniform distribution, times sqrt(n). */
static double kolmogorov(double *p, int n) {
    qsort(p, (size_t)n, sizeof *p, compare_doubles);
    double distance = 0;
    for (int i = 0; i < n; ++i) {
        distance = fmax(distance, fmax((i + 1.0) / n - p[i], p[i] - (double)i / n));
    }
    return distance * sqrt(n);
}

enum { SEEDS = 1000 };

static const char *const P_VALUES[LOBE_P_VALUES_A_CASE] = {"chi2", "rejected", "furnace"};

/* The p-values of one seed; the bins are those of every seed. */
static void test_seed(const lobe_verify_model *model, const lobe_bins *bins, uint64_t seed,
                      lobe_report *report) {
    lobe_settings settings = {.draws = 8192, .seed = seed, .p_limit = LIST_P_LIMIT, .threads = 1};
    lobe_monitor monitor = {.total_draws = 1};
    lobe_tally tally;
    report->count = 0;
    assert_true(lobe_tally_make(&tally, model, bins, &settings, &monitor));
    lobe_test_draws(model, &settings, bins, &tally, report);
    lobe_tally_free(&tally);
}

/* 1.95: significance 1e-3. The count of rejected draws is discrete, but finely: some 10^3 of them. */
static void p_values_are_uniform(void **state) {
    (void)state;
    static double p[LOBE_P_VALUES_A_CASE][SEEDS];
    lobe_reflection_subject subject;
    lobe_reflection_subject_make(&subject, ggx_parameters(LOBE_METHOD_CAPS, 0.4, 0.8, 50, 30),
                                 LOBE_PRECISION_F64);
    lobe_bins bins;
    assert_true(lobe_bins_make(&bins, &subject.model, 8, 2));
    for (int i = 0; i < SEEDS; ++i) {
        lobe_report report;
        test_seed(&subject.model, &bins, (uint64_t)i, &report);
        for (int k = 0; k < LOBE_P_VALUES_A_CASE; ++k) {
            p[k][i] = find_row(&report, P_VALUES[k])->value;
        }
    }
    lobe_bins_free(&bins);
    for (int k = 0; k < LOBE_P_VALUES_A_CASE; ++k) {
        double distance = kolmogorov(p[k], SEEDS);
        print_message("%s: Kolmogorov-Smirnov %.3f\n", P_VALUES[k], distance);
        assert_true(distance < 1.95);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(lambert_is_accepted),
                                       cmocka_unit_test(p_values_are_uniform)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
