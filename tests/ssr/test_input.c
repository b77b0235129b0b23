/* tests/ssr/test_input.c: the same bits by any number of threads and any instruction set; broken frames, extreme
 * sizes, bad options. */
#include "frames.h"

#include "lobe/batch.h"

static void broken_frames_give_finite_pictures(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {2, 1}, {1, 3}, {67, 41}, {16384, 1}, {1, 16384}};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
        for (int resolve = 0; resolve < 4; resolve++) {
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

enum { WAYS = 9 };

/* Every loop of the passes runs in one of these. */
static lobe_ssr_options way_at(int way) {
    lobe_ssr_options o = lobe_ssr_default_options();
    o.fade_start = 0.2f;
    o.fade_end = 1.0f;
    o.mode = way == 1 ? LOBE_SSR_MIRROR : way == 2 ? LOBE_SSR_NDF : LOBE_SSR_VNDF;
    if (way == 3) o.resolve = LOBE_SSR_APPROX;
    if (way == 4) o.resolve = LOBE_SSR_NEIGHBOURHOOD;
    if (way == 7) o.resolve = LOBE_SSR_OWN;
    if (way == 8) o.resolve = LOBE_SSR_CONFIDENCE;
    o.as_hdrp = way == 5;
    o.linear_march = way == 6;
    return o;
}

/* All that two handles hold of a frame is the same, bit by bit. */
static void assert_same_results(const lobe_ssr *a, const lobe_ssr *b, size_t pixels) {
    const size_t values = pixels * sizeof(float);
    assert_memory_equal(lobe_ssr_rays(a), lobe_ssr_rays(b), pixels * sizeof(lobe_ssr_ray));
    assert_memory_equal(lobe_ssr_resolved(a), lobe_ssr_resolved(b), 4 * values);
    assert_memory_equal(lobe_ssr_reflection(a), lobe_ssr_reflection(b), 4 * values);
    assert_memory_equal(lobe_ssr_radiance(a), lobe_ssr_radiance(b), 3 * values);
    assert_memory_equal(lobe_ssr_composite(a), lobe_ssr_composite(b), 3 * values);
}

/* Two good frames and a broken one, by the plainest set and by another. */
static void compare_with_plainest(const char *isa, int way, const float *environment) {
    enum { WIDTH = 147, HEIGHT = 39 };
    made_frame good = make_room(WIDTH, HEIGHT, 0.4f), broken = make_frame(WIDTH, HEIGHT, 60.0f);
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++) good.color[i] = unit_random(9, i);
    for (size_t i = 0; i < 2 * WIDTH * HEIGHT; i++)
        good.motion[i] = 0.02f * unit_random(10, i) - 0.01f;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
        good.motion_z[i] = 0.2f * good.z[i] * (unit_random(12, i) - 0.5f);
    if (way % 2) good.frame.motion_z = good.motion_z;
    fill_with_odd_numbers(&broken, 20);
    good.frame.environment = broken.frame.environment =
        (lobe_ssr_environment){5, 4, 3, environment};
    lobe_ssr *plain = open_ssr(&good, way_at(way)), *other = open_ssr(&good, way_at(way));
    const made_frame *frames[] = {&good, &good, &broken};
    for (size_t k = 0; k < sizeof frames / sizeof *frames; k++) {
        assert_true(lobe_restrict_isa(lobe_isa_at(0)));
        assert_true(run_frame(plain, frames[k]).rays > 1000);
        assert_true(lobe_restrict_isa(isa));
        run_frame(other, frames[k]);
        assert_same_results(plain, other, WIDTH * HEIGHT);
    }
    lobe_ssr_free(plain);
    lobe_ssr_free(other);
    free_frame(&good);
    free_frame(&broken);
}

static void any_instruction_set_gives_the_same_bits(void **state) {
    (void)state;
    float environment[3 * 5 * 4 * 3];
    for (uint64_t i = 0; i < 3 * 5 * 4 * 3; i++) environment[i] = odd_number(30, i);
    for (int k = 1; lobe_isa_at(k); k++)
        for (int way = 0; way < WAYS; way++)
            compare_with_plainest(lobe_isa_at(k), way, environment);
    assert_true(lobe_restrict_isa(NULL));
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

static void environments_are_refused(void **state) {
    (void)state;
    static const int sizes[][3] = {
        {0, 1, 1}, {1, -1, 1}, {1, 1, 0}, {32768, 32768, 1}, {1 << 20, 1 << 20, 8}};
    const float texel[3] = {1.0f, 1.0f, 1.0f};
    made_frame m = make_room(8, 8, 0.1f);
    lobe_ssr *ssr = open_ssr(&m, lobe_ssr_default_options());
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        m.frame.environment = (lobe_ssr_environment){sizes[k][0], sizes[k][1], sizes[k][2], texel};
        assert_int_equal(lobe_ssr_run(ssr, &m.frame, NULL), LOBE_SSR_BAD_INPUT);
        assert_non_null(strstr(lobe_ssr_error_message(), "environment: "));
    }
    lobe_ssr_free(ssr);
    free_frame(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(broken_frames_give_finite_pictures),
                                       cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
                                       cmocka_unit_test(any_instruction_set_gives_the_same_bits),
                                       cmocka_unit_test(bad_options_are_refused),
                                       cmocka_unit_test(bad_cameras_are_refused),
                                       cmocka_unit_test(environments_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
