/* tests/verify/test_dielectric.c: draws of the rough dielectric against its density and value over both
 * hemispheres, and the charts of the sphere that the expectations are computed on. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "tests/verify/support.h"
#include "verify/bins.h"
#include "verify/cubature.h"
#include "verify/rounded.h"
#include "verify/dielectric_cases.h"

static const double PI = 3.14159265358979323846;

/* Half of the list in each precision: the twin of a float model is the double one. */
static void every_case_is_accepted(void **state) {
    (void)state;
    int failures = 0;
    size_t half = lobe_dielectric_case_count() / 2;
    for (size_t i = 0; i < half; ++i) {
        lobe_dielectric_case c = lobe_dielectric_case_at(i % 2 == 0 ? i : i + half);
        lobe_dielectric_subject subject;
        lobe_dielectric_subject_make(&subject, c.parameters, c.precision);
        lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
        settings.grid = 8;
        settings.draws = 32768;
        settings.checks = 64;
        settings.p_limit = LIST_P_LIMIT;
        settings.stream = i;
        lobe_report report;
        run_engine(&subject.model, &settings, &report);
        if (count_failures(&report) > 0) print_failures(&subject.model, &report);
        failures += count_failures(&report);
        assert_non_null(find_row(&report, "chi2"));
        assert_null(find_row(&report, "support"));
    }
    assert_int_equal(failures, 0);
}

static lobe_dielectric_parameters parameters_of(double alpha, double ior, double theta) {
    return (lobe_dielectric_parameters){
        lobe_dielectric_default_options(), alpha, alpha, ior, theta, 0};
}

/* The choice is skewed: too many are transmitted. */
static lobe_verify_draw too_many_transmitted(const lobe_verify_state *state, const double u[3]) {
    lobe_dielectric_f64 model;
    memcpy(&model, state->bytes, sizeof model);
    lobe_dielectric_draw_f64 s = lobe_dielectric_sample_f64(&model, u[0], u[1], sqrt(u[2]));
    return (lobe_verify_draw){{s.wo.x, s.wo.y, s.wo.z}, s.pdf, s.weight};
}

/* dm/do without the factor eta^2: a classic. */
static double wrong_jacobian(const lobe_verify_state *state, const double wo[3]) {
    lobe_dielectric_f64 model;
    memcpy(&model, state->bytes, sizeof model);
    lobe_vec3_f64 direction = {wo[0], wo[1], wo[2]};
    double pdf = lobe_dielectric_pdf_f64(&model, direction);
    return wo[2] < 0 ? pdf / (model.eta * model.eta) : pdf;
}

static void wrong_models_are_rejected(void **state) {
    (void)state;
    for (int k = 0; k < 2; ++k) {
        lobe_dielectric_subject subject;
        lobe_dielectric_subject_make(&subject, parameters_of(0.4, 1.5, 50), LOBE_PRECISION_F64);
        call_one_by_one(&subject.model);
        if (k == 0) subject.model.sample = too_many_transmitted;
        if (k == 1) subject.model.density = wrong_jacobian;
        lobe_settings settings = {.draws = 32768,
                                  .grid = 8,
                                  .checks = 64,
                                  .seed = 1,
                                  .p_limit = LIST_P_LIMIT,
                                  .threads = 1};
        lobe_report report;
        run_engine(&subject.model, &settings, &report);
        assert_false(lobe_report_row_passed(find_row(&report, "chi2")));
    }
}

static double direction(const lobe_verify_chart *chart, double t, double a, double wo[3]) {
    double area;
    lobe_disk_point point = lobe_disk_from_square(t, a, &area);
    return area * chart->direction(chart->self, point, wo);
}

/* |dwo/dt x dwo/da| by central differences. */
static double difference_quotient(const lobe_verify_chart *chart, double t, double a) {
    const double h = 1e-5;
    double p[3], q[3], along_t[3], along_a[3];
    direction(chart, t + h, a, p);
    direction(chart, t - h, a, q);
    for (int k = 0; k < 3; ++k) along_t[k] = (p[k] - q[k]) / (2 * h);
    direction(chart, t, a + h, p);
    direction(chart, t, a - h, q);
    for (int k = 0; k < 3; ++k) along_a[k] = (p[k] - q[k]) / (2 * h);
    double x = along_t[1] * along_a[2] - along_t[2] * along_a[1];
    double y = along_t[2] * along_a[0] - along_t[0] * along_a[2];
    double z = along_t[0] * along_a[1] - along_t[1] * along_a[0];
    return sqrt(x * x + y * y + z * z);
}

/* Counts the points that have a direction. */
static int check_chart(const lobe_verify_chart *chart) {
    int count = 0;
    for (int i = 0; i < 12; ++i) {
        for (int j = 0; j < 12; ++j) {
            double t = (i + 0.37) / 12, a = (j + 0.61) / 12, wo[3], t2, a2;
            double jacobian = direction(chart, t, a, wo);
            if (jacobian == 0) continue;
            lobe_disk_point point;
            assert_true(fabs(wo[0] * wo[0] + wo[1] * wo[1] + wo[2] * wo[2] - 1) < 1e-12);
            assert_true(chart->point(chart->self, wo, &point));
            lobe_square_from_disk(point, &t2, &a2);
            if (!(fabs(t - t2) < 1e-8 && fabs(a - a2) < 1e-8))
                fail_msg("(%.17g, %.17g) came back as (%.17g, %.17g)", t, a, t2, a2);
            double expected = difference_quotient(chart, t, a);
            if (!(fabs(jacobian - expected) < 1e-3 * expected))
                fail_msg("at (%g, %g): %.9g, by differences %.9g", t, a, jacobian, expected);
            count += 1;
        }
    }
    return count;
}

static void charts_invert_and_differentiate(void **state) {
    (void)state;
    lobe_verify_chart sphere = lobe_sphere_chart();
    assert_int_equal(check_chart(&sphere), 144);
    const double thetas[] = {0, 40, 85, 110, 150, 180}, iors[] = {1.5, 1.01, 0.7};
    for (int k = 0; k < 18; ++k) {
        lobe_dielectric_subject subject;
        lobe_dielectric_subject_make(&subject, parameters_of(0.3, iors[k % 3], thetas[k / 3]),
                                     LOBE_PRECISION_F64);
        assert_true(check_chart(&subject.model.chart) >= 72);
    }
}

/* Next to the edge of what refracts, a direction rounded to single precision still has its place in the chart. */
static void rounded_directions_stay_on_the_chart(void **state) {
    (void)state;
    const double iors[] = {1.0001, 1.01, 1.5};
    for (int k = 0; k < 3; ++k) {
        lobe_dielectric_subject subject;
        lobe_dielectric_subject_make(&subject, parameters_of(0.5, iors[k], 35), LOBE_PRECISION_F64);
        const lobe_verify_chart *chart = &subject.model.chart;
        int places = 0;
        for (int i = 0; i < 1000; ++i) {
            double wo[3];
            if (!(direction(chart, 1 - 1e-7, (i + 0.5) / 1000, wo) > 0)) continue;
            for (int axis = 0; axis < 3; ++axis) wo[axis] = lobe_rounded_to_float(wo[axis]);
            lobe_disk_point point;
            assert_true(chart->point(chart->self, wo, &point));
            places += 1;
        }
        assert_true(places > 100);
    }
}

static void solid_angle(const void *self, double t, double a, double values[LOBE_CUBATURE_VALUES]) {
    double wo[3];
    values[0] = direction(self, t, a, wo);
    values[1] = values[0] * wo[2] * wo[2];
}

static void the_sphere_is_covered_once(void **state) {
    (void)state;
    lobe_verify_chart sphere = lobe_sphere_chart();
    lobe_integrand integrand = {
        .evaluate = solid_angle, .self = &sphere, .count = 2, .tolerance = {1e-9, 1e-9}};
    double integral[LOBE_CUBATURE_VALUES];
    lobe_cubature(&integrand, (lobe_box){{0, 0}, {1, 1}}, integral);
    assert_true(fabs(integral[0] - 4 * PI) < 1e-7);
    assert_true(fabs(integral[1] - 4 * PI / 3) < 1e-7);
}

/* The density over the whole sphere and the white furnace do not depend on the chart. */
static void integrals_agree_on_both_charts(void **state) {
    (void)state;
    lobe_dielectric_subject subject;
    lobe_dielectric_subject_make(&subject, parameters_of(0.5, 1.5, 60), LOBE_PRECISION_F64);
    lobe_bins own, plain;
    assert_true(lobe_bins_make(&own, &subject.model, 24, 16));
    subject.model.chart = lobe_sphere_chart();
    assert_true(lobe_bins_make(&plain, &subject.model, 24, 16));
    assert_true(fabs(own.density - 1) < 1e-5); /* from outside no draw is lost */
    assert_true(fabs(own.density - plain.density) < 1e-4);
    assert_true(fabs(own.value - plain.value) < 1e-5);
    lobe_bins_free(&own);
    lobe_bins_free(&plain);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_case_is_accepted),
                                       cmocka_unit_test(wrong_models_are_rejected),
                                       cmocka_unit_test(charts_invert_and_differentiate),
                                       cmocka_unit_test(rounded_directions_stay_on_the_chart),
                                       cmocka_unit_test(the_sphere_is_covered_once),
                                       cmocka_unit_test(integrals_agree_on_both_charts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
