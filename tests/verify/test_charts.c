/* tests/verify/test_charts.c: the changes of variables behind every expectation: they invert, their
 * Jacobian is the derivative, and they cover the hemisphere once. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "verify/cubature.h"
#include "verify/ggx_chart.h"
#include "verify/plane_chart.h"

static const double PI = 3.14159265358979323846;

typedef struct place {
    double alpha_x, alpha_y, theta;
} place;

static const place PLACES[] = {{1, 1, 0},      {0.3, 0.3, 40},  {0.2, 0.8, 60},
                               {0.05, 1, 80},  {2, 0.5, 30},    {0.01, 0.3, 70},
                               {0.5, 0.5, 90}, {0.4, 0.9, 110}, {0.1, 0.3, 160}};
enum { PLACE_COUNT = sizeof PLACES / sizeof *PLACES };

static lobe_ggx_chart ggx_at(int index) {
    double theta = PLACES[index].theta * PI / 180;
    double wi[3] = {sin(theta) * cos(0.7), sin(theta) * sin(0.7), cos(theta)};
    return lobe_ggx_chart_prepare(wi, PLACES[index].alpha_x, PLACES[index].alpha_y);
}

static double direction(const lobe_verify_chart *chart, double t, double a, double wo[3]) {
    double area;
    lobe_disk_point point = lobe_disk_from_square(t, a, &area);
    return area * chart->direction(chart->self, point, wo);
}

static void check_inverse(const lobe_verify_chart *chart, double t, double a) {
    double wo[3], t2, a2;
    lobe_disk_point point;
    direction(chart, t, a, wo);
    assert_true(fabs(wo[0] * wo[0] + wo[1] * wo[1] + wo[2] * wo[2] - 1) < 1e-12);
    assert_true(chart->point(chart->self, wo, &point));
    lobe_square_from_disk(point, &t2, &a2);
    if (!(fabs(t - t2) < 1e-8 && fabs(a - a2) < 1e-8)) {
        fail_msg("(%.17g, %.17g) came back as (%.17g, %.17g)", t, a, t2, a2);
    }
}

/* |dwo/dt x dwo/da| by central differences. */
static void check_jacobian(const lobe_verify_chart *chart, double t, double a) {
    const double h = 1e-5;
    double wo[3], p[3], q[3], along_t[3], along_a[3];
    double jacobian = direction(chart, t, a, wo);
    direction(chart, t + h, a, p);
    direction(chart, t - h, a, q);
    for (int k = 0; k < 3; ++k) along_t[k] = (p[k] - q[k]) / (2 * h);
    direction(chart, t, a + h, p);
    direction(chart, t, a - h, q);
    for (int k = 0; k < 3; ++k) along_a[k] = (p[k] - q[k]) / (2 * h);
    double x = along_t[1] * along_a[2] - along_t[2] * along_a[1];
    double y = along_t[2] * along_a[0] - along_t[0] * along_a[2];
    double z = along_t[0] * along_a[1] - along_t[1] * along_a[0];
    double expected = sqrt(x * x + y * y + z * z);
    if (!(fabs(jacobian - expected) < 1e-4 * expected)) {
        fail_msg("at (%g, %g): %.9g, by differences %.9g", t, a, jacobian, expected);
    }
}

static void check_chart(const lobe_verify_chart *chart) {
    for (int i = 0; i < 12; ++i) {
        for (int j = 0; j < 12; ++j) {
            double t = (i + 0.37) / 12;
            double a = (j + 0.61) / 12;
            check_inverse(chart, t, a);
            check_jacobian(chart, t, a);
        }
    }
}

static void charts_invert_and_differentiate(void **state) {
    (void)state;
    lobe_verify_chart hemisphere = lobe_hemisphere_chart();
    check_chart(&hemisphere);
    for (int i = 0; i < PLACE_COUNT; ++i) {
        lobe_ggx_chart ggx = ggx_at(i);
        lobe_verify_chart chart = lobe_ggx_chart_view(&ggx);
        check_chart(&chart);
    }
}

static void solid_angle(const void *self, double t, double a, double values[LOBE_CUBATURE_VALUES]) {
    double wo[3];
    values[0] = direction(self, t, a, wo);
    values[1] = values[0] * wo[2];
}

static void integrate(const lobe_verify_chart *chart, double integral[LOBE_CUBATURE_VALUES]) {
    lobe_integrand integrand = {
        .evaluate = solid_angle, .self = chart, .count = 2, .tolerance = {1e-9, 1e-9}};
    lobe_cubature(&integrand, (lobe_box){{0, 0}, {1, 1}}, integral);
}

/* From above the chart covers the hemisphere exactly: solid angle 2 pi, projected pi. */
static void charts_cover_the_hemisphere(void **state) {
    (void)state;
    double integral[LOBE_CUBATURE_VALUES];
    lobe_verify_chart hemisphere = lobe_hemisphere_chart();
    integrate(&hemisphere, integral);
    assert_true(fabs(integral[0] - 2 * PI) < 1e-7 && fabs(integral[1] - PI) < 1e-7);
    for (int i = 0; i < PLACE_COUNT; ++i) {
        if (PLACES[i].theta >= 90 || PLACES[i].alpha_x < 0.02) continue;
        lobe_ggx_chart ggx = ggx_at(i);
        lobe_verify_chart chart = lobe_ggx_chart_view(&ggx);
        integrate(&chart, integral);
        if (!(fabs(integral[0] - 2 * PI) < 1e-4 && fabs(integral[1] - PI) < 1e-4)) {
            fail_msg("alpha %g, %g, theta %g: %.9g, %.9g", PLACES[i].alpha_x, PLACES[i].alpha_y,
                     PLACES[i].theta, integral[0], integral[1]);
        }
    }
}

/* Two hemispheres whose planes meet at an angle share the solid angle 2 (pi - tilt), and seen from
 * above pi (1 + cos tilt)/2. */
static void plane_charts_cover_both_hemispheres(void **state) {
    (void)state;
    const double tilt = 0.6, g[3] = {sin(tilt) * cos(2.0), sin(tilt) * sin(2.0), cos(tilt)};
    for (int i = 0; i < PLACE_COUNT; ++i) {
        double theta = PLACES[i].theta * PI / 180;
        double wi[3] = {sin(theta) * cos(1.2), sin(theta) * sin(1.2), cos(theta)};
        if (wi[0] * g[0] + wi[1] * g[1] + wi[2] * g[2] <= 0) continue;
        lobe_plane_chart plane =
            lobe_plane_chart_prepare(wi, g, PLACES[i].alpha_x, PLACES[i].alpha_y);
        lobe_verify_chart chart = lobe_plane_chart_view(&plane);
        check_chart(&chart);
        if (PLACES[i].theta >= 90 || PLACES[i].alpha_x < 0.02) continue;
        double integral[LOBE_CUBATURE_VALUES];
        integrate(&chart, integral);
        if (!(fabs(integral[0] - 2 * (PI - tilt)) < 1e-4 &&
              fabs(integral[1] - PI * (1 + cos(tilt)) / 2) < 1e-4)) {
            fail_msg("alpha %g, %g, theta %g: %.9g, %.9g", PLACES[i].alpha_x, PLACES[i].alpha_y,
                     PLACES[i].theta, integral[0], integral[1]);
        }
    }
}

static void visible_share_has_closed_forms(void **state) {
    (void)state;
    double up[3] = {0, 0, 1};
    lobe_ggx_chart ggx = lobe_ggx_chart_prepare(up, 0.3, 0.3);
    assert_true(fabs(lobe_ggx_chart_visible_share(&ggx) - 1 / 1.09) < 1e-14);
    double wi[3] = {0.6, 0, 0.8};
    ggx = lobe_ggx_chart_prepare(wi, 1, 1);
    assert_true(fabs(lobe_ggx_chart_visible_share(&ggx) - 1 / 1.8) < 1e-14);
    double below[3] = {0.6, 0, -0.8};
    ggx = lobe_ggx_chart_prepare(below, 0.2, 0.7);
    assert_true(fabs(lobe_ggx_chart_visible_share(&ggx) - 1) < 1e-13);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(charts_invert_and_differentiate),
                                       cmocka_unit_test(charts_cover_the_hemisphere),
                                       cmocka_unit_test(plane_charts_cover_both_hemispheres),
                                       cmocka_unit_test(visible_share_has_closed_forms)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
