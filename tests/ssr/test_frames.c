/* tests/ssr/test_frames.c: frames of scenes, real rays, and pictures that come back from files. */
#define _POSIX_C_SOURCE 200809L

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "lobe/random.h"
#include "lobe/ssr_frames.h"
#include "lobe/ssr_picture.h"

enum { WIDTH = 160, HEIGHT = 90, PIXELS = WIDTH * HEIGHT };

static lobe_scene *load(const char *name) {
    lobe_scene *scene = NULL;
    assert_int_equal(lobe_scene_load(name, lobe_scene_default_options(), &scene), LOBE_RENDER_OK);
    return scene;
}

static lobe_ssr_frames *frames_of(const lobe_scene *scene, float roughness, lobe_ssr_path path) {
    lobe_ssr_scene_options o = lobe_ssr_scene_default_options();
    o.width = WIDTH;
    o.height = HEIGHT;
    o.samples = 4;
    o.roughness = roughness;
    o.path = path;
    lobe_ssr_frames *frames = NULL;
    assert_int_equal(lobe_ssr_frames_of_scene(scene, o, &frames), LOBE_SSR_OK);
    return frames;
}

/* The renderer's own depth, of one sample a pixel, has a filter of three pixels: a scene of few edges. */
static void depth_and_normals_are_those_of_a_render(void **state) {
    (void)state;
    lobe_scene *scene = load("cornell");
    lobe_ssr_frames *frames = frames_of(scene, -1.0f, LOBE_SSR_PATH_STILL);
    lobe_ssr_frame f;
    assert_int_equal(lobe_ssr_frames_get(frames, 0, &f), LOBE_SSR_OK);
    lobe_render_options o = lobe_render_default_options();
    o.width = WIDTH;
    o.height = HEIGHT;
    o.samples = 16;
    o.depth = 0;
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_DEPTH) | LOBE_AOV_BIT(LOBE_AOV_NORMAL);
    lobe_film *film = NULL;
    assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_OK);
    float *depth = malloc(PIXELS * sizeof *depth), *normal = malloc(3 * PIXELS * sizeof *normal);
    assert_true(depth && normal);
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_DEPTH, depth));
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_NORMAL, normal));
    int same = 0;
    for (int i = 0; i < PIXELS; i++) {
        const float a = (2.0f * ((float)(i % WIDTH) + 0.5f) / WIDTH - 1.0f) * f.camera.tan_x;
        const float b = (1.0f - 2.0f * ((float)(i / WIDTH) + 0.5f) / HEIGHT) * f.camera.tan_y;
        const float distance = f.z[i] * sqrtf(1.0f + a * a + b * b);
        const float *n = normal + 3 * i, *m = f.normal + 3 * i;
        same += fabsf(distance - depth[i]) < 0.02f * depth[i] &&
                n[0] * m[0] + n[1] * m[1] + n[2] * m[2] > 0.98f;
    }
    assert_true(same > 0.9 * PIXELS);
    free(depth);
    free(normal);
    lobe_film_free(film);
    lobe_ssr_frames_free(frames);
    lobe_scene_free(scene);
}

/* What a pixel shows lies where its motion says it was: the depths of the previous frame agree. */
static void motion_leads_to_where_a_surface_was(void **state) {
    (void)state;
    lobe_scene *scene = load("cornell");
    for (int path = 0; path <= LOBE_SSR_PATH_STILL; path++) {
        lobe_ssr_frames *frames = frames_of(scene, -1.0f, (lobe_ssr_path)path);
        lobe_ssr_frame f;
        float *last = malloc(PIXELS * sizeof *last);
        assert_non_null(last);
        assert_int_equal(lobe_ssr_frames_get(frames, 0, &f), LOBE_SSR_OK);
        memcpy(last, f.z, PIXELS * sizeof *last);
        assert_int_equal(lobe_ssr_frames_get(frames, 1, &f), LOBE_SSR_OK);
        int count = 0, same = 0, moved = 0;
        for (int i = 0; i < PIXELS; i++) {
            const float x = ((float)(i % WIDTH) + 0.5f) / WIDTH - f.motion[2 * i];
            const float y = ((float)(i / WIDTH) + 0.5f) / HEIGHT - f.motion[2 * i + 1];
            moved += f.motion[2 * i] != 0.0f;
            if (!(x >= 0.0f && x < 1.0f && y >= 0.0f && y < 1.0f)) continue;
            const float z = last[(int)(y * HEIGHT) * WIDTH + (int)(x * WIDTH)];
            count++;
            same += fabsf(z - f.z[i]) < 0.05f * z;
        }
        assert_true(count > PIXELS / 2 && same > 0.95 * count);
        if (path != LOBE_SSR_PATH_STILL) assert_true(moved > PIXELS / 2);
        free(last);
        lobe_ssr_frames_free(frames);
    }
    lobe_scene_free(scene);
}

static lobe_view view_of(const lobe_ssr_camera *c) {
    const lobe_vec3_f32 e = c->eye, f = c->forward;
    return (lobe_view){e,
                       {e.x + 8.0f * f.x, e.y + 8.0f * f.y, e.z + 8.0f * f.z},
                       c->up,
                       2.0f * atanf(c->tan_y) * 57.2957795f};
}

/* `lobe render --aov motion` means the same. Its pixels are means over three, so edges differ. */
static void motion_is_that_of_a_render(void **state) {
    (void)state;
    lobe_scene *scene = load("cornell");
    lobe_ssr_frames *frames = frames_of(scene, -1.0f, LOBE_SSR_PATH_ORBIT);
    lobe_ssr_frame f;
    assert_int_equal(lobe_ssr_frames_get(frames, 2, &f), LOBE_SSR_OK);
    const lobe_view now = view_of(&f.camera), before = view_of(&f.previous_camera);
    lobe_render_options o = lobe_render_default_options();
    o.width = WIDTH;
    o.height = HEIGHT;
    o.samples = 16;
    o.depth = 0;
    o.view = &now;
    o.previous_view = &before;
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_MOTION);
    lobe_film *film = NULL;
    assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_OK);
    float *motion = malloc(2 * PIXELS * sizeof *motion);
    assert_non_null(motion);
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_MOTION, motion));
    int same = 0, moved = 0;
    for (int i = 0; i < PIXELS; i++) {
        const float right = (motion[2 * i] - f.motion[2 * i]) * WIDTH;
        const float down = (motion[2 * i + 1] - f.motion[2 * i + 1]) * HEIGHT;
        same += hypotf(right, down) < 0.05f;
        moved += hypotf(f.motion[2 * i] * WIDTH, f.motion[2 * i + 1] * HEIGHT) > 0.2f;
    }
    if (!(same > 0.9 * PIXELS && moved > 0.5 * PIXELS)) fail_msg("%d same, %d moved", same, moved);
    free(motion);
    lobe_film_free(film);
    lobe_ssr_frames_free(frames);
    lobe_scene_free(scene);
}

static lobe_ssr_options options_of(lobe_ssr_mode mode) {
    lobe_ssr_options o = lobe_ssr_default_options();
    o.mode = mode;
    o.fade_start = o.fade_end = 1.0f;
    o.bias = 0.0f;
    o.max_iterations = 1000;
    return o;
}

/* White in white light of 0.5: every real ray brings that, from the screen or not. */
static void truth_is_white_in_a_furnace(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    lobe_ssr_frames *frames = frames_of(scene, 0.5f, LOBE_SSR_PATH_ORBIT);
    lobe_ssr_frame f;
    float *rgb = malloc(3 * PIXELS * sizeof *rgb), *screen = malloc(PIXELS * sizeof *screen);
    assert_true(rgb && screen);
    assert_int_equal(lobe_ssr_frames_get(frames, 1, &f), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_truth(frames, LOBE_SSR_VNDF, 4, rgb, screen), LOBE_SSR_OK);
    int seen = 0;
    for (int i = 0; i < PIXELS; i++) {
        assert_true(screen[i] >= 0.0f && screen[i] <= 1.0f + 1e-5f);
        if (!(f.z[i] > 0.0f)) continue;
        seen += rgb[3 * i] > 0.0f;
        if (rgb[3 * i] > 0.0f) assert_true(fabsf(rgb[3 * i] - 0.5f) < 0.025f);
    }
    assert_true(seen > PIXELS / 20);
    free(rgb);
    free(screen);
    lobe_ssr_frames_free(frames);
    lobe_scene_free(scene);
}

/* In a closed room mirrors are right nearly everywhere where the screen holds the answer. */
static void mirrors_of_a_room_hold_against_real_rays(void **state) {
    (void)state;
    lobe_scene *scene = load("cornell");
    lobe_ssr_frames *frames = frames_of(scene, 0.0f, LOBE_SSR_PATH_STILL);
    lobe_ssr *ssr = NULL;
    lobe_ssr_frame f;
    lobe_ssr_statistics st;
    float *rgb = malloc(3 * PIXELS * sizeof *rgb), *screen = malloc(PIXELS * sizeof *screen);
    assert_true(rgb && screen);
    lobe_ssr_options o = options_of(LOBE_SSR_MIRROR);
    o.edge_fade = 0.0f;
    assert_int_equal(lobe_ssr_create(WIDTH, HEIGHT, o, &ssr), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_frames_get(frames, 0, &f), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_run(ssr, &f, &st), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_truth(frames, LOBE_SSR_MIRROR, 1, rgb, screen), LOBE_SSR_OK);
    const lobe_ssr_judgement j = lobe_ssr_judge(frames, ssr, rgb, screen);
    print_message("relmse %.4f, on screen %.4f of %llu, false hits %.4f, false misses %.4f\n",
                  j.relmse, j.relmse_onscreen, (unsigned long long)j.pixels_onscreen, j.false_hits,
                  j.false_misses);
    assert_true(j.pixels > 1000 && j.pixels_onscreen > 500);
    assert_true(j.relmse_onscreen < 0.5 * j.relmse);
    assert_true(j.false_hits < 0.03 && j.false_misses < 0.06);
    /* a truth that is wrong is seen */
    for (int i = 0; i < 3 * PIXELS; i++) rgb[i] = rgb[i] * 1.5f + 0.1f;
    assert_true(lobe_ssr_judge(frames, ssr, rgb, screen).relmse_onscreen > 2.0 * j.relmse_onscreen);
    free(rgb);
    free(screen);
    lobe_ssr_free(ssr);
    lobe_ssr_frames_free(frames);
    lobe_scene_free(scene);
}

static void a_picture_comes_back_from_its_file(void **state) {
    (void)state;
    enum { W = 5, H = 3 };
    static const char *const names[] = {"B", "a.Z"}, *const other[] = {"B", "C"};
    float in[2 * W * H], b[W * H], z[W * H];
    float *const values[] = {b, z};
    char path[64];
    for (int i = 0; i < 2 * W * H; i++) in[i] = 1.0f / (float)(i + 1);
    snprintf(path, sizeof path, "/tmp/lobe-ssr-%ld.exr", (long)getpid());
    const lobe_ssr_channel channels[] = {{"a.Z", in + 1, 2}, {"B", in, 2}};
    assert_int_equal(lobe_ssr_write_exr(path, W, H, channels, 2, "key 1"), LOBE_SSR_OK);
    assert_true(lobe_ssr_read_exr(path, W, H, names, 2, "key 1", values));
    for (int i = 0; i < W * H; i++) assert_true(b[i] == in[2 * i] && z[i] == in[2 * i + 1]);
    assert_false(lobe_ssr_read_exr(path, W, H, names, 2, "key 2", values));
    assert_false(lobe_ssr_read_exr(path, W, H + 1, names, 2, "key 1", values));
    assert_false(lobe_ssr_read_exr(path, W, H, other, 2, "key 1", values));
    /* cut short */
    assert_int_equal(truncate(path, 300), 0);
    assert_false(lobe_ssr_read_exr(path, W, H, names, 2, "key 1", values));
    unlink(path);
    assert_false(lobe_ssr_read_exr(path, W, H, names, 2, "key 1", values));
    assert_int_equal(lobe_ssr_write_exr("/nowhere/x.exr", W, H, channels, 2, NULL),
                     LOBE_SSR_FAILED);
    assert_int_equal(lobe_ssr_write_png("/nowhere/x.png", 1, 1, in, 3), LOBE_SSR_FAILED);
    assert_non_null(strstr(lobe_ssr_error_message(), "/nowhere/x.png: "));
}

/* Some zeros and then noise, of any length after compression: that of the pixels too, which says that there is none. */
static void pictures_of_any_compressed_length_come_back(void **state) {
    (void)state;
    enum { W = 32, H = 12, ROUNDS = 450 };
    static const char *const names[] = {"Z"};
    float in[W * H], z[W * H], *const values[] = {z};
    char path[64];
    snprintf(path, sizeof path, "/tmp/lobe-ssr-%ld.exr", (long)getpid());
    for (int round = 0; round < ROUNDS; round++) {
        for (int i = 0; i < W * H; i++) {
            const uint32_t word =
                lobe_random(3, (uint64_t)round, (uint64_t)i).word[0] & 0xbfffffffu;
            memcpy(&in[i], &word, sizeof word);
            if (i < 10 + round % 15) in[i] = 0.0f;
        }
        const lobe_ssr_channel channel = {"Z", in, 1};
        assert_int_equal(lobe_ssr_write_exr(path, W, H, &channel, 1, NULL), LOBE_SSR_OK);
        assert_true(lobe_ssr_read_exr(path, W, H, names, 1, NULL, values));
        if (memcmp(in, z, sizeof in) != 0) fail_msg("round %d", round);
    }
    unlink(path);
}

static void bad_requests_are_refused(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    lobe_ssr_scene_options o = lobe_ssr_scene_default_options();
    lobe_ssr_frames *frames = NULL;
    lobe_ssr_frame f;
    o.camera = "nobody";
    assert_int_equal(lobe_ssr_frames_of_scene(scene, o, &frames), LOBE_SSR_BAD_INPUT);
    assert_non_null(strstr(lobe_ssr_error_message(), "nobody"));
    o.camera = NULL;
    o.width = 0;
    assert_int_equal(lobe_ssr_frames_of_scene(scene, o, &frames), LOBE_SSR_BAD_INPUT);
    o.width = 4;
    o.height = 4;
    o.roughness = NAN;
    assert_int_equal(lobe_ssr_frames_of_scene(scene, o, &frames), LOBE_SSR_BAD_INPUT);
    o.roughness = 0.1f;
    volatile sig_atomic_t cancel = 1;
    o.cancel = &cancel;
    assert_int_equal(lobe_ssr_frames_of_scene(scene, o, &frames), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_frames_get(frames, o.count, &f), LOBE_SSR_BAD_INPUT);
    assert_int_equal(lobe_ssr_frames_get(frames, 0, &f), LOBE_SSR_INTERRUPTED);
    lobe_ssr_frames_free(frames);
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(depth_and_normals_are_those_of_a_render),
        cmocka_unit_test(motion_leads_to_where_a_surface_was),
        cmocka_unit_test(motion_is_that_of_a_render),
        cmocka_unit_test(truth_is_white_in_a_furnace),
        cmocka_unit_test(mirrors_of_a_room_hold_against_real_rays),
        cmocka_unit_test(a_picture_comes_back_from_its_file),
        cmocka_unit_test(pictures_of_any_compressed_length_come_back),
        cmocka_unit_test(bad_requests_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
