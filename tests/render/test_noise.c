/* tests/render/test_noise.c: the noise that a render tells is the one that it has. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

enum { WIDTH = 48, HEIGHT = 27, RUNS = 8 };

static double luminance(const float *rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/* The estimate is at least the truth, which it exceeds by what stratification gains beyond 16 samples, and not
 * much more. The truth: what RUNS independent pictures scatter about a quieter one, 8192 samples a pixel. */
static void compare_with_truth(const lobe_scene *scene, const float *truth, int is_adaptive) {
    lobe_render_options o = small(WIDTH, HEIGHT, 64);
    o.is_adaptive = is_adaptive;
    double estimated = 0, actual = 0;
    for (int run = 0; run < RUNS; run++) {
        lobe_render_statistics statistics;
        o.seed = (uint64_t)run;
        lobe_film *film = render(scene, o, &statistics);
        float *rgb = colors(film);
        estimated += statistics.noise * statistics.noise / RUNS;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const double m = luminance(truth + 3 * i), d = luminance(rgb + 3 * i) - m;
            actual += d * d / (m * m + 0.01) / (WIDTH * HEIGHT * RUNS);
        }
        free(rgb);
        lobe_film_free(film);
    }
    const double ratio = sqrt(estimated / actual);
    if (!(ratio > 0.9 && ratio < 1.35)) fail_msg("estimated / actual = %g", ratio);
}

static void estimate_is_near_the_truth(void **state) {
    (void)state;
    lobe_scene *scene = load("gallery");
    lobe_render_options o = small(WIDTH, HEIGHT, 1024);
    o.seed = 100;
    lobe_film *reference = render(scene, o, NULL);
    float *truth = colors(reference);
    compare_with_truth(scene, truth, 0);
    compare_with_truth(scene, truth, 1);
    free(truth);
    lobe_film_free(reference);
    lobe_scene_free(scene);
}

/* Where it stops depends on no thread, and not on the greatest number of samples being reached. */
static void a_level_stops_at_the_same_place(void **state) {
    (void)state;
    lobe_scene *scene = load("gallery");
    lobe_render_options o = small(WIDTH, HEIGHT, 4096);
    o.noise = 0.06;
    lobe_render_statistics statistics[2];
    for (int i = 0; i < 2; i++) {
        o.threads = 1 + 2 * i;
        lobe_film_free(render(scene, o, &statistics[i]));
        assert_true(statistics[i].noise <= o.noise);
        assert_true(statistics[i].pixel_samples >= 32 && statistics[i].pixel_samples < 4096);
        assert_true(statistics[i].samples ==
                    (uint64_t)statistics[i].pixel_samples * WIDTH * HEIGHT);
    }
    assert_int_equal(statistics[0].samples, statistics[1].samples);
    assert_true(statistics[0].noise == statistics[1].noise);
    lobe_scene_free(scene);
}

static void few_samples_tell_nothing(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    lobe_render_statistics statistics;
    lobe_film_free(render(scene, small(16, 9, 31), &statistics));
    assert_true(isnan(statistics.noise));
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(estimate_is_near_the_truth),
                                       cmocka_unit_test(a_level_stops_at_the_same_place),
                                       cmocka_unit_test(few_samples_tell_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
