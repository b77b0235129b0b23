/* tests/metrics/test_flip.c: FLIP against what the authors' program says of the same pictures
 * (tools/numerics/flip_reference.py prints the numbers), and what holds without it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

#include <lobe/metrics.h>

enum { WIDTH = 72, HEIGHT = 54, PROBES = 4 };

static float picture[HEIGHT * WIDTH * 3], reference[HEIGHT * WIDTH * 3];
static float map[HEIGHT * WIDTH], other_map[HEIGHT * WIDTH];

/* Ramps of three slopes with noise on their right part, some squares of them eight times as bright. */
static void make_pictures(void) {
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x)
            for (int c = 0; c < 3; ++c) {
                const int i = 3 * (y * WIDTH + x) + c;
                const float bright = (x / 12 + y / 12) % 3 == 0 ? 8.0f : 1.0f;
                const float ramp = (float)((x * (c + 1) + 2 * y) % 64) / 64.0f;
                const float noise =
                    x > 20 ? (float)((x * 11 + y * 17 + c * 5) % 16 - 7) / 32.0f : 0.0f;
                reference[i] = ramp * bright;
                picture[i] = fmaxf(ramp + noise, 0.0f) * bright;
            }
}

static double flip(const float *a, const float *b, lobe_flip_range range, float *values) {
    double mean;
    assert_int_equal(
        lobe_flip(a, b, WIDTH, HEIGHT, range, LOBE_FLIP_PIXELS_PER_DEGREE, values, &mean), 1);
    return mean;
}

static void assert_near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance)) fail_msg("%.7g, expected %.7g", value, expected);
}

static void agrees_with_the_reference_program(void **state) {
    (void)state;
    static const struct {
        lobe_flip_range range;
        double mean, at[PROBES];
    } known[] = {{LOBE_FLIP_LDR, 0.123368, {0.000000, 0.150000, 0.003588, 0.107853}},
                 {LOBE_FLIP_HDR, 0.167326, {0.000000, 0.327942, 0.097756, 0.314769}}};
    static const int x[PROBES] = {0, 30, 71, 24}, y[PROBES] = {0, 20, 53, 40};
    make_pictures();
    for (int k = 0; k < 2; ++k) {
        assert_near(flip(picture, reference, known[k].range, map), known[k].mean, 2e-5);
        for (int i = 0; i < PROBES; ++i)
            assert_near((double)map[y[i] * WIDTH + x[i]], known[k].at[i], 2e-4);
    }
}

static void same_pictures_do_not_differ(void **state) {
    (void)state;
    make_pictures();
    assert_true(flip(reference, reference, LOBE_FLIP_LDR, map) == 0);
    assert_true(flip(reference, reference, LOBE_FLIP_HDR, map) == 0);
}

static void ldr_is_symmetric_and_within_its_range(void **state) {
    (void)state;
    make_pictures();
    const double one = flip(picture, reference, LOBE_FLIP_LDR, map);
    assert_near(flip(reference, picture, LOBE_FLIP_LDR, other_map), one, 1e-6);
    for (int i = 0; i < WIDTH * HEIGHT; ++i) assert_true(map[i] >= 0 && map[i] <= 1);
}

/* No edges, no points: L* of the greys alone, 100 and 50.0; the greatest distance, green to blue after Hunt's
 * adjustment, is 203.30. */
static void greys_by_hand(void **state) {
    (void)state;
    const double greatest = pow(203.3016546, 0.7), knee = 0.4 * greatest;
    for (int i = 0; i < 3 * WIDTH * HEIGHT; ++i) {
        picture[i] = 1;
        reference[i] = 0.18418652f; /* ((50 + 16) / 116)^3 */
    }
    assert_near(flip(picture, reference, LOBE_FLIP_LDR, map), pow(50, 0.7) * 0.95 / knee, 1e-4);
    for (int i = 0; i < 3 * WIDTH * HEIGHT; ++i) reference[i] = 0;
    assert_near(flip(picture, reference, LOBE_FLIP_LDR, map),
                0.95 + 0.05 * (pow(100, 0.7) - knee) / (greatest - knee), 1e-4);
}

/* Black has no exposure, and a light may be as bright as it likes. */
static void extreme_pictures(void **state) {
    (void)state;
    for (int i = 0; i < 3 * WIDTH * HEIGHT; ++i) picture[i] = reference[i] = 0;
    assert_true(flip(picture, reference, LOBE_FLIP_HDR, map) == 0);
    picture[300] = 1e30f;
    reference[600] = 1e30f;
    assert_true(flip(picture, reference, LOBE_FLIP_HDR, map) > 0);
    for (int i = 0; i < WIDTH * HEIGHT; ++i) assert_true(map[i] >= 0 && map[i] <= 1);
    double mean = -1;
    const float black[3] = {0, 0, 0}, white[3] = {1, 1, 1};
    assert_int_equal(lobe_flip(white, black, 1, 1, LOBE_FLIP_HDR, 67, NULL, &mean), 1);
    assert_true(mean > 0.9 && mean <= 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(agrees_with_the_reference_program),
                                       cmocka_unit_test(same_pictures_do_not_differ),
                                       cmocka_unit_test(ldr_is_symmetric_and_within_its_range),
                                       cmocka_unit_test(greys_by_hand),
                                       cmocka_unit_test(extreme_pictures)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
