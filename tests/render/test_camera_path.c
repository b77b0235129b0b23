/* tests/render/test_camera_path.c: cameras of JSON files: both forms, what is left out, mistakes, damage. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <lobe/camera_path.h>
#include <lobe/random.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char name[] = "render-path.json";

static lobe_render_result read_bytes(const char *text, size_t size, lobe_camera_path **path) {
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fwrite(text, 1, size, file);
    fclose(file);
    const lobe_render_result result = lobe_camera_path_read(name, path);
    unlink(name);
    return result;
}

static lobe_camera_path *path_of(const char *text) {
    lobe_camera_path *path = NULL;
    if (read_bytes(text, strlen(text), &path) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    return path;
}

static void assert_vector(lobe_vec3_f32 v, float x, float y, float z) {
    if (!(fabsf(v.x - x) < 1e-5f && fabsf(v.y - y) < 1e-5f && fabsf(v.z - z) < 1e-5f))
        fail_msg("(%g, %g, %g), not (%g, %g, %g)", v.x, v.y, v.z, x, y, z);
}

/* A quarter turn to the left: backward is +X. */
#define MATRIX "[[0,0,1,7],[0,1,0,2],[-1,0,0,3],[0,0,0,1]]"
#define POSE "{\"to_world\":" MATRIX ",\"tan\":[1,0.5],\"near\":0.1,\"far\":9}"
#define LOOK "{\"position\":[1,2,3],\"target\":[4,5,6],\"degrees\":40,\"focus\":2.5}"

static void both_forms_are_read(void **state) {
    (void)state;
    lobe_camera_path *path =
        path_of("{\"width\":4,\"frames\":[{\"file\":\"x\",\"camera\":" POSE "},{\"camera\":" LOOK
                "},{\"camera\":" LOOK ",\"previous_camera\":" POSE "}]}");
    assert_int_equal(lobe_camera_path_count(path), 3);
    assert_null(lobe_camera_path_get(path, 3));
    assert_null(lobe_camera_path_get(path, -1));
    const lobe_path_frame *f[3];
    for (int i = 0; i < 3; ++i) f[i] = lobe_camera_path_get(path, i);
    const lobe_path_camera *pose = &f[0]->camera, *look = &f[1]->camera;
    assert_vector(pose->view.position, 7, 2, 3);
    assert_vector(pose->view.up, 0, 1, 0);
    assert_vector(pose->right, 0, 0, -1);
    assert_vector(pose->backward, 1, 0, 0);
    assert_true(pose->view.target.x < 6); /* ahead, by any distance */
    assert_true(pose->view.target.y == 2 && pose->view.target.z == 3);
    assert_true(fabsf(tanf(pose->view.vertical_degrees * 3.14159265f / 360) - 0.5f) < 1e-6f);
    assert_true(pose->tan_x == 1 && pose->tan_y == 0.5f && pose->focus == 0);
    assert_true(pose->near_z == 0.1f && pose->far_z == 9);
    assert_vector(look->view.position, 1, 2, 3);
    assert_vector(look->view.target, 4, 5, 6);
    assert_vector(look->view.up, 0, 1, 0);
    assert_true(look->view.vertical_degrees == 40 && look->focus == 2.5f && look->tan_x == 0);
    assert_memory_equal(&f[0]->previous, &f[0]->camera, sizeof *pose);
    assert_memory_equal(&f[1]->previous, &f[0]->camera, sizeof *pose);
    assert_memory_equal(&f[2]->previous, &f[0]->camera, sizeof *pose);
    lobe_camera_path_free(path);
    lobe_camera_path_free(NULL);
}

/* What the two forms say of one camera is one picture. */
static void both_forms_see_the_same(void **state) {
    (void)state;
    lobe_camera_path *path =
        path_of("{\"frames\":[{\"camera\":{\"to_world\":[[0.8,0,-0.6,-4],[0,1,0,1],[0.6,0,0.8,5],["
                "0,0,0,1]],"
                "\"tan\":[0.5,0.5]}},{\"camera\":{\"position\":[-4,1,5],\"target\":[-1,1,1],"
                "\"degrees\":53.13010235}}]}");
    lobe_scene *scene = load("gallery");
    float *rgb[2];
    double sum = 0, difference = 0;
    for (int k = 0; k < 2; ++k) {
        lobe_render_options o = small(24, 24, 64);
        o.depth = 0;
        o.view = &lobe_camera_path_get(path, k)->camera.view;
        lobe_film *film = render(scene, o, NULL);
        rgb[k] = colors(film);
        lobe_film_free(film);
    }
    for (int i = 0; i < 3 * 24 * 24; ++i) {
        sum += (double)rgb[0][i];
        difference += fabs((double)rgb[0][i] - (double)rgb[1][i]);
    }
    assert_true(sum > 0 && difference < 1e-3 * sum);
    free(rgb[0]);
    free(rgb[1]);
    lobe_scene_free(scene);
    lobe_camera_path_free(path);
}

static void refuse(const char *text, const char *part) {
    lobe_camera_path *path = NULL;
    assert_int_equal(read_bytes(text, strlen(text), &path), LOBE_RENDER_BAD_INPUT);
    assert_null(path);
    const char *message = lobe_render_error_message();
    if (!strstr(message, part) || !strstr(message, name) || !strchr(message, ';'))
        fail_msg("%s: %s", text, message);
}

#define WITH(CAMERA) "{\"frames\":[{\"camera\":" LOOK "},{\"camera\":" CAMERA "}]}"
#define WITH_MATRIX(M) WITH("{\"to_world\":" M ",\"tan\":[1,1]}")
#define WITH_LOOK(P, T, REST) WITH("{\"position\":" P ",\"target\":" T ",\"degrees\":40" REST "}")

static void mistakes_are_named(void **state) {
    (void)state;
    refuse("", "render-path.json:1");
    refuse("{\"frames\":[", "render-path.json:1");
    refuse("{\"a\":1,\"a\":2}", "duplicate");
    refuse("7", "render-path.json");
    refuse("[]", "frames");
    refuse("{\"frames\":{}}", "frames");
    refuse("{\"frames\":[]}", "frames");
    refuse("{\"frames\":[3]}", "frames[0].camera: no object");
    refuse(WITH("7"), "frames[1].camera: no object");
    refuse(WITH("{}"), "frames[1].camera: neither to_world nor position");
    refuse(WITH_MATRIX("[[1,0,0,0],[0,1,0,0],[0,0,1,0]]"), "4 rows");
    refuse(WITH_MATRIX("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]"), "4 rows");
    refuse(WITH_MATRIX("[[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]"), "turn and shift");
    refuse(WITH_MATRIX("[[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]"), "turn and shift");
    refuse(WITH_MATRIX("[[1,0,0,1e60],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"), "turn and shift");
    refuse(WITH("{\"to_world\":" MATRIX ",\"tan\":[1]}"), "tan");
    refuse(WITH("{\"to_world\":" MATRIX ",\"tan\":[1,0]}"), "angle");
    refuse(WITH("{\"to_world\":" MATRIX ",\"tan\":[1,1e9]}"), "angle");
    refuse(WITH("{\"to_world\":" MATRIX ",\"tan\":[1,1],\"near\":\"x\"}"), "near");
    refuse(WITH("{\"position\":[0,0]}"), "position");
    refuse(WITH("{\"position\":[0,0,1e99]}"), "position");
    refuse(WITH("{\"position\":[0,0,0],\"degrees\":40}"), "target");
    refuse(WITH("{\"position\":[0,0,0],\"target\":[1,0,0]}"), "degrees");
    refuse(WITH("{\"position\":[0,0,0],\"target\":[1,0,0],\"degrees\":180}"), "degrees");
    refuse(WITH("{\"position\":[0,0,0],\"target\":[1,0,0],\"degrees\":\"40\"}"), "degrees");
    refuse(WITH_LOOK("[1,1,1]", "[1,1,1]", ""), "no direction");
    refuse(WITH_LOOK("[1,1,1]", "[1,5,1]", ""), "no direction");
    refuse(WITH_LOOK("[1,1,1]", "[2,1,1]", ",\"up\":[0,0,0]"), "no direction");
    refuse(WITH_LOOK("[1,1,1]", "[2,1,1]", ",\"up\":[1,1]"), "up");
    refuse(WITH_LOOK("[1,1,1]", "[2,1,1]", ",\"focus\":0"), "focus");
    refuse(WITH_LOOK("[1,1,1]", "[2,1,1]", ",\"focus\":[1]"), "focus");
    refuse("{\"frames\":[{\"camera\":" LOOK ",\"previous_camera\":1}]}", "previous_camera");
    lobe_camera_path *path = NULL;
    assert_int_equal(lobe_camera_path_read(".", &path), LOBE_RENDER_BAD_INPUT);
    assert_int_equal(lobe_camera_path_read("no such file", &path), LOBE_RENDER_BAD_INPUT);
}

/* Every file that is read gives cameras that can be rendered with. */
static void damaged_files_do_no_harm(void **state) {
    (void)state;
    static const char good[] = "{\"frames\":[{\"camera\":" POSE "},{\"camera\":" LOOK "}]}";
    lobe_scene *scene = load("furnace");
    int readable = 0;
    for (uint64_t round = 0; round < 400; ++round) {
        char bad[sizeof good];
        lobe_camera_path *path = NULL;
        memcpy(bad, good, sizeof good);
        const lobe_random4 r = lobe_random(7, round, 0);
        bad[r.word[0] % (sizeof good - 1)] = "0123456789-.eE[]{},:\"xtf \n"[r.word[1] % 26];
        if (r.word[2] % 2) bad[r.word[3] % (sizeof good - 1)] = "019-.eE"[r.word[2] / 2 % 7];
        if (read_bytes(bad, sizeof good - 1, &path) != LOBE_RENDER_OK) continue;
        for (int i = 0; i < lobe_camera_path_count(path); ++i) {
            lobe_render_options o = small(2, 2, 1);
            o.view = &lobe_camera_path_get(path, i)->camera.view;
            lobe_film_free(render(scene, o, NULL));
        }
        readable++;
        lobe_camera_path_free(path);
    }
    assert_true(readable > 20 && readable < 380);
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_forms_are_read),
        cmocka_unit_test(both_forms_see_the_same),
        cmocka_unit_test(mistakes_are_named),
        cmocka_unit_test(damaged_files_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
