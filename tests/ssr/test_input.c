/* tests/ssr/test_input.c: the same bits by any number of threads; broken frames, extreme sizes, bad options. */
#include "frames.h"

static void broken_frames_give_finite_pictures(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {2, 1}, {1, 3}, {67, 41}, {16384, 1}, {1, 16384}};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
        for (int resolve = 0; resolve < 3; resolve++) {
            made_frame m = make_frame(sizes[k][0], sizes[k][1], 60.0f);
            lobe_ssr_options o = lobe_ssr_default_options();
            o.resolve = (lobe_ssr_resolve)resolve;
            o.mode = (lobe_ssr_mode)((k + (size_t)resolve) % 3);
            o.as_hdrp = k % 2 == 1;
            o.fade_start = o.fade_end = 1.0f;
            lobe_ssr *ssr = open_ssr(&m, o);
            uint64_t rays = 0;
            for (uint64_t frame = 0; frame < 3; frame++) {
                fill_with_odd_numbers(&m, 100 * k + 10 * frame);
                rays += run_frame(ssr, &m).rays;
                check_finite(ssr, &m);
            }
            assert_true(rays > 0 || m.width * m.height < 10);
            lobe_ssr_free(ssr);
            free_frame(&m);
        }
}

static void any_number_of_threads_gives_the_same_bits(void **state) {
    (void)state;
    made_frame m = make_room(131, 77, 0.4f);
    for (int i = 0; i < 3 * 131 * 77; i++) m.color[i] = unit_random(9, (uint64_t)i);
    float *expected = NULL;
    const size_t bytes = 3 * 131 * 77 * sizeof(float);
    for (int threads = 1; threads <= 5; threads++) {
        lobe_ssr_options o = lobe_ssr_default_options();
        o.fade_start = o.fade_end = 1.0f;
        o.threads = threads;
        lobe_ssr *ssr = open_ssr(&m, o);
        for (int frame = 0; frame < 3; frame++) run_frame(ssr, &m);
        if (!expected) {
            expected = malloc(bytes);
            assert_non_null(expected);
            memcpy(expected, lobe_ssr_composite(ssr), bytes);
        }
        assert_memory_equal(lobe_ssr_composite(ssr), expected, bytes);
        lobe_ssr_free(ssr);
    }
    free(expected);
    free_frame(&m);
}

static void refuse(lobe_ssr_options o, int width, int height) {
    lobe_ssr *ssr = NULL;
    assert_int_equal(lobe_ssr_create(width, height, o, &ssr), LOBE_SSR_BAD_INPUT);
    assert_null(ssr);
    assert_non_null(strchr(lobe_ssr_error_message(), ';'));
}

static void bad_options_are_refused(void **state) {
    (void)state;
    const lobe_ssr_options good = lobe_ssr_default_options();
    refuse(good, 0, 1);
    refuse(good, 1, 32769);
    lobe_ssr_options o = good;
    o.thickness = NAN;
    refuse(o, 8, 8);
    o = good;
    o.fade_end = 0.05f;
    refuse(o, 8, 8);
    o = good;
    o.method = LOBE_METHOD_NEWTON;
    refuse(o, 8, 8);
    o = good;
    o.method = LOBE_METHOD_SLOPE;
    refuse(o, 8, 8);
    o = good;
    o.max_iterations = 0;
    refuse(o, 8, 8);
}

static void bad_cameras_are_refused(void **state) {
    (void)state;
    made_frame m = make_room(8, 8, 0.1f);
    lobe_ssr *ssr = open_ssr(&m, lobe_ssr_default_options());
    const lobe_ssr_camera good = m.frame.camera;
    for (int k = 0; k < 5; k++) {
        lobe_ssr_camera *c = k % 2 ? &m.frame.camera : &m.frame.previous_camera;
        if (k == 0) c->right = c->forward;
        if (k == 1) c->eye.x = NAN;
        if (k == 2) c->near_z = c->far_z;
        if (k == 3) c->tan_x = 0.0f;
        if (k == 4) c->up = (lobe_vec3_f32){0, 0, 0};
        assert_int_equal(lobe_ssr_run(ssr, &m.frame, NULL), LOBE_SSR_BAD_INPUT);
        m.frame.camera = m.frame.previous_camera = good;
    }
    m.frame.z = NULL;
    assert_int_equal(lobe_ssr_run(ssr, &m.frame, NULL), LOBE_SSR_BAD_INPUT);
    lobe_ssr_free(ssr);
    free_frame(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(broken_frames_give_finite_pictures),
                                       cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
                                       cmocka_unit_test(bad_options_are_refused),
                                       cmocka_unit_test(bad_cameras_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
