/* tests/verify/test_cubature.c: integrals with known results. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "verify/cubature.h"

static const double PI = 3.14159265358979323846;

/* A polynomial that the points take exactly, and a smooth function. */
static void smooth(const void *self, double x, double y, double values[LOBE_CUBATURE_VALUES]) {
    (void)self;
    values[0] = pow(x, 9) * pow(y, 8);
    values[1] = exp(x) * cos(y);
}

static void smooth_functions(void **state) {
    (void)state;
    lobe_integrand integrand = {.evaluate = smooth, .count = 2, .tolerance = {1e-12, 1e-12}};
    double integral[LOBE_CUBATURE_VALUES];
    lobe_cubature(&integrand, (lobe_box){{0, 0}, {2, 1}}, integral);
    assert_true(fabs(integral[0] - 1024.0 / 10 / 9) < 1e-12);
    assert_true(fabs(integral[1] - (exp(2) - 1) * sin(1)) < 1e-12);
}

/* A lobe a hundredth of the box wide, off every grid point. */
static void peak(const void *self, double x, double y, double values[LOBE_CUBATURE_VALUES]) {
    const double *width = self;
    double p = (x - 0.2345) / *width;
    double q = (y - 0.6789) / *width;
    values[0] = 1 / (1 + p * p) / (1 + q * q);
}

static double peak_side(double low, double high, double center, double width) {
    return width * (atan((high - center) / width) - atan((low - center) / width));
}

static void sharp_peak(void **state) {
    (void)state;
    double width = 1e-2;
    lobe_integrand integrand = {.evaluate = peak, .self = &width, .count = 1, .tolerance = {1e-15}};
    double integral[LOBE_CUBATURE_VALUES];
    lobe_cubature(&integrand, (lobe_box){{0, 0}, {1, 1}}, integral);
    double expected = peak_side(0, 1, 0.2345, width) * peak_side(0, 1, 0.6789, width);
    assert_true(fabs(integral[0] / expected - 1) < 1e-8);
}

static void disk(const void *self, double x, double y, double values[LOBE_CUBATURE_VALUES]) {
    (void)self;
    values[0] = x * x + y * y < 1;
}

/* A jump ends at the greatest depth instead of never. */
static void jump(void **state) {
    (void)state;
    lobe_integrand integrand = {.evaluate = disk, .count = 1, .tolerance = {1e-12}};
    double integral[LOBE_CUBATURE_VALUES];
    lobe_cubature(&integrand, (lobe_box){{0, 0}, {1, 1}}, integral);
    assert_true(fabs(integral[0] - PI / 4) < 1e-4);
}

static void sliver(const void *self, double x, double y, double values[LOBE_CUBATURE_VALUES]) {
    const int *side = self;
    const double to_side[] = {x, y, 1 - x, 1 - y};
    values[0] = to_side[*side] < 0.004;
}

/* What reaches into a box by less than its first point is seen, from every side. */
static void slivers_along_a_side(void **state) {
    (void)state;
    for (int side = 0; side < 4; ++side) {
        lobe_integrand integrand = {
            .evaluate = sliver, .self = &side, .count = 1, .tolerance = {1e-9}};
        double integral[LOBE_CUBATURE_VALUES];
        lobe_cubature(&integrand, (lobe_box){{0, 0}, {1, 1}}, integral);
        assert_true(fabs(integral[0] - 0.004) < 1e-3);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(smooth_functions),
                                       cmocka_unit_test(sharp_peak), cmocka_unit_test(jump),
                                       cmocka_unit_test(slivers_along_a_side)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
