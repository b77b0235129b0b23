/* tests/render/test_pose.c: animated nodes, morphed and skinned meshes stand where a file says they do at a
 * moment. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "gltf_square.h"
#include "pictures.h"

#include <unistd.h>

static const char name[] = "render-pose.glb";

enum {
    SIZE = 16,
    LEFT = 4,
    RIGHT = 11,
    MIDDLE = 8,
    FIRST_ACCESSOR = ACCESSORS,
    FIRST_VIEW = VIEWS
};

/* The middle of the square at z = 0 is 4 in front of the camera. */
typedef struct sight {
    float depth[SIZE][SIZE], normal[SIZE][SIZE][3];
} sight;

static sight look(const char *path, double time, const char *animation) {
    sight v;
    lobe_scene *scene = NULL;
    lobe_scene_options so = lobe_scene_default_options();
    so.frame_time = time;
    so.animation = animation;
    so.strict = 1;
    if (lobe_scene_load(path, so, &scene) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    lobe_render_options o = small(SIZE, SIZE, 16);
    o.depth = 0;
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_NORMAL) | LOBE_AOV_BIT(LOBE_AOV_DEPTH);
    lobe_film *film = render(scene, o, NULL);
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_NORMAL, &v.normal[0][0][0]));
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_DEPTH, &v.depth[0][0]));
    lobe_film_free(film);
    lobe_scene_free(scene);
    return v;
}

static void assert_depth(double time, const char *animation, float depth) {
    const sight v = look(name, time, animation);
    if (!(fabsf(v.depth[MIDDLE][MIDDLE] - depth) < 0.02f))
        fail_msg("at %g: %g, not %g", time, v.depth[MIDDLE][MIDDLE], depth);
}

static void assert_normal(double time, float x, float z) {
    const sight v = look(name, time, NULL);
    const float *n = v.normal[MIDDLE][MIDDLE];
    if (!(fabsf(n[0] - x) < 0.004f && fabsf(n[1]) < 0.004f && fabsf(n[2] - z) < 0.004f))
        fail_msg("at %g: (%g, %g, %g), not (%g, 0, %g)", time, n[0], n[1], n[2], x, z);
}

/* ---- Animation ---------------------------------------------------------------------------------- */

/* The two keys of a channel. */
typedef struct keys {
    const char *path, *type, *interpolation;
    int node;
    float times[2];
    const float *values;
    size_t value_count; /* floats */
    const char *nodes, *primitive;
} keys;

static void write_keys(keys k) {
    float numbers[64];
    char views[80], accessors[500], more[500];
    memcpy(numbers, k.times, sizeof k.times);
    memcpy(numbers + 2, k.values, k.value_count * sizeof *k.values);
    snprintf(views, sizeof views, ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":256}",
             sizeof square_arrays);
    const size_t channels = strcmp(k.type, "SCALAR") == 0 ? 1 : strcmp(k.type, "VEC3") == 0 ? 3 : 4;
    snprintf(
        accessors, sizeof accessors,
        ",{\"bufferView\":%d,\"componentType\":5126,\"type\":\"SCALAR\",\"count\":2},"
        "{\"bufferView\":%d,\"byteOffset\":8,\"componentType\":5126,\"type\":\"%s\",\"count\":%zu}",
        FIRST_VIEW, FIRST_VIEW, k.type, k.value_count / channels);
    snprintf(more, sizeof more,
             ",\"animations\":[{\"name\":\"still\",\"channels\":[],\"samplers\":[]},"
             "{\"name\":\"moving\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":%d,"
             "\"path\":\"%s\"}},{\"sampler\":0,\"target\":{\"path\":\"pointer\"}}],\"samplers\":["
             "{\"input\":%d,\"output\":%d,\"interpolation\":\"%s\"}]}]",
             k.node, k.path, FIRST_ACCESSOR, FIRST_ACCESSOR + 1, k.interpolation);
    write_square_file(name, (square_file){.views = views,
                                          .accessors = accessors,
                                          .more = more,
                                          .nodes = k.nodes,
                                          .primitive = k.primitive,
                                          .binary = numbers,
                                          .binary_size = sizeof numbers});
}

static const float to_the_viewer[] = {0, 0, 0, 0, 0, 2};

static void keys_are_joined_by_lines(void **state) {
    (void)state;
    write_keys((keys){"translation", "VEC3", "LINEAR", 1, {1, 3}, to_the_viewer, 6, 0, 0});
    assert_depth(-7, "moving", 4);
    assert_depth(1.5, "moving", 3.5f);
    assert_depth(2, "moving", 3);
    assert_depth(3, "moving", 2);
    assert_depth(99, "moving", 2);
    assert_depth(99, "all", 2);
    assert_depth(99, NULL, 4); /* the first one, in which nothing moves */
}

static void keys_are_steps(void **state) {
    (void)state;
    write_keys((keys){"translation", "VEC3", "STEP", 1, {1, 3}, to_the_viewer, 6, 0, 0});
    assert_depth(2.9, "moving", 4);
    assert_depth(3, "moving", 2);
}

/* z = 2 (t^3 - 2 t^2 + t) + 2 (3 t^2 - 2 t^3) + 2 * 3 (t^3 - t^2): slopes of 1 and 3 over 2 seconds. */
static void keys_are_joined_by_cubics(void **state) {
    (void)state;
    const float values[] = {9, 9, 9, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 2, 9, 9, 9};
    write_keys((keys){"translation", "VEC3", "CUBICSPLINE", 1, {1, 3}, values, 18, 0, 0});
    assert_depth(1, "moving", 4);
    for (int i = 1; i < 4; ++i) {
        const float t = 0.25f * (float)i, t2 = t * t, t3 = t2 * t;
        assert_depth(1 + 2 * (double)t, "moving",
                     4 - (2 * (t3 - 2 * t2 + t) + 2 * (3 * t2 - 2 * t3) + 6 * (t3 - t2)));
    }
    assert_depth(3, "moving", 2);
}

static const char nested[] = "{\"children\":[2]},{\"mesh\":0}";
static const char all_of_it[] = "all";

/* A quarter of the way from 0 to 120 degrees about +Y is 30 degrees; -q turns as q does. */
static void rotations_go_along_the_arc(void **state) {
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        const float s = (float)sign * 0.8660254f,
                    values[] = {0, 0, 0, 1, 0, s, 0, (float)sign * 0.5f};
        write_keys((keys){"rotation", "VEC4", "LINEAR", 1, {0, 4}, values, 8, nested, 0});
        const sight v = look(name, 1, all_of_it);
        assert_true(fabsf(v.normal[MIDDLE][MIDDLE][0] - 0.5f) < 0.004f);
        assert_true(fabsf(v.normal[MIDDLE][MIDDLE][2] - 0.8660254f) < 0.004f);
    }
}

static void scales_are_animated(void **state) {
    (void)state;
    const float values[] = {1, 1, 1, 0.25f, 1, 1};
    write_keys((keys){"scale", "VEC3", "LINEAR", 1, {0, 1}, values, 6, 0, 0});
    const sight before = look(name, 0, "moving"), after = look(name, 1, "moving");
    assert_true(before.depth[MIDDLE][1] > 0 && after.depth[MIDDLE][1] == 0);
    assert_true(after.depth[1][MIDDLE] > 0);
}

static void cameras_move(void **state) {
    (void)state;
    const float values[] = {0, 0, 4, 0, 0, 8};
    write_keys((keys){"translation", "VEC3", "LINEAR", 0, {0, 1}, values, 6, 0, 0});
    assert_depth(0.5, "moving", 6);
}

static void moments_and_names_are_checked(void **state) {
    (void)state;
    write_keys((keys){"translation", "VEC3", "LINEAR", 1, {1, 3}, to_the_viewer, 6, 0, 0});
    lobe_scene *scene = NULL;
    lobe_scene_options o = lobe_scene_default_options();
    o.strict = 1;
    assert_int_equal(lobe_scene_load(name, o, &scene), LOBE_RENDER_BAD_INPUT); /* no moment */
    assert_non_null(strstr(lobe_render_error_message(), "animated"));
    o.frame_time = 1;
    o.animation = "flying";
    assert_int_equal(lobe_scene_load(name, o, &scene), LOBE_RENDER_BAD_INPUT);
    assert_non_null(strstr(lobe_render_error_message(), "flying"));
    assert_int_equal(lobe_scene_load("cornell", o, &scene), LOBE_RENDER_BAD_INPUT);
    assert_non_null(strstr(lobe_render_error_message(), "not animated"));
    write_keys((keys){"translation", "VEC3", "CUBICSPLINE", 1, {1, 3}, to_the_viewer, 6, 0, 0});
    o.animation = NULL;
    assert_int_equal(lobe_scene_load(name, o, &scene), LOBE_RENDER_OK); /* not looked at */
    lobe_scene_free(scene);
    o.animation = "moving";
    assert_int_equal(lobe_scene_load(name, o, &scene), LOBE_RENDER_BAD_INPUT);
    assert_non_null(strstr(lobe_render_error_message(), "2 elements for 2 keys"));
}

/* A checkpoint of another moment is another picture's. */
static void checkpoints_know_their_moment(void **state) {
    (void)state;
    static const char kept[] = "render-pose.checkpoint";
    write_keys((keys){"translation", "VEC3", "LINEAR", 1, {1, 3}, to_the_viewer, 6, 0, 0});
    lobe_render_options o = small(SIZE, SIZE, 2);
    for (int moment = 0; moment < 2; ++moment) {
        lobe_scene *scene = NULL;
        lobe_scene_options so = lobe_scene_default_options();
        so.frame_time = 1.5 + moment;
        so.animation = "moving";
        assert_int_equal(lobe_scene_load(name, so, &scene), LOBE_RENDER_OK);
        o.checkpoint = moment == 0 ? kept : NULL;
        o.resume = moment == 0 ? NULL : kept;
        lobe_film *film = NULL;
        const lobe_render_result result = lobe_render(scene, o, &film, NULL);
        assert_int_equal(result, moment == 0 ? LOBE_RENDER_OK : LOBE_RENDER_BAD_INPUT);
        lobe_film_free(film);
        lobe_scene_free(scene);
    }
    assert_non_null(strstr(lobe_render_error_message(), "its frame-time is 1.5, not 2.5"));
    unlink(kept);
}

/* ---- Morph targets ------------------------------------------------------------------------------ */

/* Target 0 moves by the normals, to the viewer; target 1 by the positions, outward, and its normals tilt. */
static const char targets[] =
    ",\"indices\":8,\"targets\":[{\"POSITION\":1},{\"POSITION\":0,\"NORMAL\":0}]";

static void weights_are_animated(void **state) {
    (void)state;
    const float values[] = {0, 1, 1, 0};
    write_keys((keys){"weights", "SCALAR", "LINEAR", 1, {0, 4}, values, 4, 0, targets});
    assert_depth(4, "moving", 3);
    assert_depth(2, "moving", 3.5f);
    const sight v = look(name, 0, "moving");
    assert_true(fabsf(v.depth[MIDDLE][MIDDLE] - 4) < 0.02f);
    /* of the doubled square half way from the middle to the edge: the normal is (x, y, 1), x = 0.35 */
    const float *n = v.normal[MIDDLE][RIGHT];
    assert_true(fabsf(n[0] / n[2] - 0.1751f) < 0.01f && fabsf(n[1]) < 0.03f);
}

static void weights_rest(void **state) {
    (void)state;
    write_square_file(
        name, (square_file){.primitive = targets, .nodes = "{\"mesh\":0,\"weights\":[0.5]}"});
    assert_depth((double)NAN, NULL, 3.5f);
    write_square_file(name, (square_file){.primitive = targets});
    assert_depth((double)NAN, NULL, 4);
    write_square_file(name,
                      (square_file){.primitive = ",\"indices\":8,\"targets\":[{\"POSITION\":1}]}],"
                                                 "\"weights\":[0.25]},{\"primitives\":[{"
                                                 "\"attributes\":{\"POSITION\":0},\"mode\":4"});
    assert_depth((double)NAN, NULL, 3.75f);
}

/* ---- Skins -------------------------------------------------------------------------------------- */

/* The left corners hang on joint 0, the right ones on joint 1;. */
typedef struct skin_arrays {
    unsigned char joints[16];
    float weights[16], matrices[32];
} skin_arrays;

static skin_arrays plain_skin(void) {
    skin_arrays a = {.joints = {0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}};
    for (int i = 0; i < 4; ++i) a.weights[4 * i] = 1;
    for (int i = 0; i < 32; ++i) a.matrices[i] = i % 16 % 5 == 0;
    return a;
}

static void write_skin(const skin_arrays *arrays, const char *nodes) {
    char views[300];
    snprintf(views, sizeof views,
             ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":16},"
             "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":64},"
             "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":128}",
             sizeof square_arrays, sizeof square_arrays + 16, sizeof square_arrays + 80);
    write_square_file(
        name, (square_file){
                  .attributes = "\"POSITION\":0,\"NORMAL\":1,\"JOINTS_0\":12,\"WEIGHTS_0\":13",
                  .views = views,
                  .accessors =
                      ",{\"bufferView\":15,\"componentType\":5121,\"type\":\"VEC4\",\"count\":4},"
                      "{\"bufferView\":16,\"componentType\":5126,\"type\":\"VEC4\",\"count\":4},"
                      "{\"bufferView\":17,\"componentType\":5126,\"type\":\"MAT4\",\"count\":2}",
                  .nodes = nodes,
                  .children = "0,1,2",
                  .more = ",\"skins\":[{\"joints\":[3,4],\"inverseBindMatrices\":14}]",
                  .binary = arrays,
                  .binary_size = sizeof *arrays});
}

/* The node of the mesh counts for nothing; node 2 has the joints, joint 1 is 1 nearer. */
static const char joints[] = "{\"mesh\":0,\"skin\":0,\"translation\":[5,5,5]},{\"children\":[3,4],"
                             "\"translation\":[0,0,1]},{},{\"translation\":[0,0,1]}";

static void skins_follow_their_joints(void **state) {
    (void)state;
    skin_arrays a = plain_skin();
    write_skin(&a, joints);
    const sight v = look(name, (double)NAN, NULL);
    assert_true(fabsf(v.depth[MIDDLE][MIDDLE] - 2.5f) < 0.05f);
    assert_true(v.depth[MIDDLE][LEFT] > 2.57f && v.depth[MIDDLE][RIGHT] < 2.43f);
}

/* All corners half and half, their sum not 1; joint 0 was bound 2 further away. */
static void skins_blend(void **state) {
    (void)state;
    skin_arrays a = plain_skin();
    for (int i = 0; i < 4; ++i) {
        a.joints[4 * i] = 0;
        a.joints[4 * i + 1] = 1;
        a.weights[4 * i] = a.weights[4 * i + 1] = 0.25f;
    }
    a.matrices[14] = 1;
    write_skin(&a, joints);
    assert_depth((double)NAN, NULL, 2);
}

/* Joints turned by 60 degrees about +Y carry the normals with them. */
static void skins_turn_normals(void **state) {
    (void)state;
    const skin_arrays a = plain_skin();
    write_skin(&a, "{\"mesh\":0,\"skin\":0},{\"children\":[3,4],\"rotation\":[0,0.5,0,0.8660254],"
                   "\"scale\":[0.5,3,0.5]},{},{}");
    assert_normal((double)NAN, 0.8660254f, 0.5f);
}

static void damaged_skins_are_refused(void **state) {
    (void)state;
    static const char *const words[] = {"a joint beyond the 2", "skin 4", "1 matrices", "node 77"};
    for (int i = 0; i < 4; ++i) {
        skin_arrays a = plain_skin();
        if (i == 0) a.joints[4] = 2;
        write_skin(&a, i == 1 ? "{\"mesh\":0,\"skin\":4},{}" : joints);
        if (i >= 2) {
            size_t size;
            FILE *file = fopen(name, "rb+");
            char text[8192];
            assert_non_null(file);
            size = fread(text, 1, sizeof text, file);
            for (size_t k = 0; k + 30 < size; ++k) {
                if (i == 2 && memcmp(text + k, "\"MAT4\",\"count\":2", 16) == 0) text[k + 15] = '1';
                if (i == 3 && memcmp(text + k, "\"joints\":[3,4]", 14) == 0)
                    memcpy(text + k, "\"joints\":[ 77]", 14);
            }
            rewind(file);
            assert_int_equal(fwrite(text, 1, size, file), size);
            fclose(file);
        }
        lobe_scene *scene = NULL;
        assert_int_equal(lobe_scene_load(name, lobe_scene_default_options(), &scene),
                         LOBE_RENDER_BAD_INPUT);
        if (!strstr(lobe_render_error_message(), words[i]))
            fail_msg("\"%s\" does not say %s", lobe_render_error_message(), words[i]);
    }
}

static int remove_file(void **state) {
    (void)state;
    unlink(name);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_are_joined_by_lines),
        cmocka_unit_test(keys_are_steps),
        cmocka_unit_test(keys_are_joined_by_cubics),
        cmocka_unit_test(rotations_go_along_the_arc),
        cmocka_unit_test(scales_are_animated),
        cmocka_unit_test(cameras_move),
        cmocka_unit_test(moments_and_names_are_checked),
        cmocka_unit_test(checkpoints_know_their_moment),
        cmocka_unit_test(weights_are_animated),
        cmocka_unit_test(weights_rest),
        cmocka_unit_test(skins_follow_their_joints),
        cmocka_unit_test(skins_blend),
        cmocka_unit_test(skins_turn_normals),
        cmocka_unit_test(damaged_skins_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, remove_file);
}
