/* tests/render/test_import.c: what a glTF file says is what is rendered, and what cannot be read is
 * refused by name. The files are one square of two triangles, written below the current folder. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* 4 positions (x, y = -1 or 1), 4 normals (+Z), 4 texture coordinates (v from the top), 6 indices. */
static const char square[] =
    "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAA"
    "AAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAgD8AAIA/AACAPwAAgD8AAAAAAAAAAAAAAAAAAAEA"
    "AgAAAAIAAwA=";

static const char file_name[] = "render-square.gltf";

/* A square; `node` and `camera` are more properties of their nodes, `more` of the file. */
static void write_square(const char *camera, const char *nodes, const char *more) {
    FILE *file = fopen(file_name, "wb");
    assert_non_null(file);
    fprintf(file,
            "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
            "\"nodes\":[{\"mesh\":0},{\"camera\":0,\"name\":\"eye\",\"translation\":[0,0,4]%s}%s],"
            "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.4,\"znear\":0.1,"
            "\"aspectRatio\":2}}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,"
            "\"TEXCOORD_0\":2},\"indices\":3,\"material\":0}]}],"
            "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":"
            "{\"index\":0}},\"normalTexture\":{\"index\":1}}],"
            "\"textures\":[{\"source\":0},{\"source\":1}],"
            "\"images\":[{\"uri\":\"render-top%%20red.ppm\"},{\"uri\":\"render-up.ppm\"}],"
            "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
            "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},"
            "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":32},"
            "{\"buffer\":0,\"byteOffset\":128,\"byteLength\":12}],"
            "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
            "\"count\":4,\"min\":[-1,-1,0],\"max\":[1,1,0]},"
            "{\"bufferView\":1,\"componentType\":5126,\"type\":\"VEC3\",\"count\":4},"
            "{\"bufferView\":2,\"componentType\":5126,\"type\":\"VEC2\",\"count\":4},"
            "{\"bufferView\":3,\"componentType\":5123,\"type\":\"SCALAR\",\"count\":6}],"
            "\"buffers\":[{\"byteLength\":140,"
            "\"uri\":\"data:application/octet-stream;base64,%s\"}]%s}",
            camera, nodes, square, more);
    fclose(file);
}

/* Two rows of two texels each. */
static void write_picture(const char *path, const unsigned char top[3],
                          const unsigned char bottom[3]) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "P6 2 2 255\n");
    for (int i = 0; i < 4; ++i) fwrite(i < 2 ? top : bottom, 1, 3, file);
    fclose(file);
}

static int write_pictures(void **state) {
    (void)state;
    const unsigned char red[3] = {255, 0, 0}, blue[3] = {0, 0, 255}, up[3] = {128, 218, 218};
    write_picture("render-top red.ppm", red, blue);
    write_picture("render-up.ppm", up, up);
    return 0;
}

static int remove_files(void **state) {
    (void)state;
    unlink("render-top red.ppm");
    unlink("render-up.ppm");
    unlink(file_name);
    return 0;
}

enum { SIZE = 16 };

/* A channel of the first hit in pixel (x, y). */
static void first_hit(lobe_aov aov, int x, int y, float value[3]) {
    lobe_scene *scene = load(file_name);
    lobe_render_options o = small(SIZE, SIZE, 4);
    o.aovs = LOBE_AOV_BIT(aov);
    lobe_film *film = render(scene, o, NULL);
    float values[SIZE * SIZE * 3];
    assert_true(lobe_film_copy_aov(film, aov, values));
    memcpy(value, values + 3 * (y * SIZE + x), 3 * sizeof *value);
    lobe_film_free(film);
    lobe_scene_free(scene);
}

/* The green of a normal map points up in the picture, also where the file brings no tangents. */
static void green_points_up(void **state) {
    (void)state;
    write_square("", "", "");
    float normal[3];
    first_hit(LOBE_AOV_NORMAL, 8, 8, normal);
    assert_true(fabsf(normal[0]) < 0.02f && fabsf(normal[1] - 0.707f) < 0.02f);
    assert_true(fabsf(normal[2] - 0.707f) < 0.02f);
}

/* The name of the texture is a URI with a blank; its first row is the upper one. */
static void textures_stand_upright(void **state) {
    (void)state;
    write_square("", "", "");
    float top[3], bottom[3];
    first_hit(LOBE_AOV_ALBEDO, 8, 3, top);
    first_hit(LOBE_AOV_ALBEDO, 8, 12, bottom);
    assert_true(top[0] > 0.7f && top[2] < 0.3f && bottom[0] < 0.3f && bottom[2] > 0.7f);
}

/* Its node's place counts once, its angle is the vertical one whatever the aspect, and its name is
 * that of the node. */
static void cameras_stand_where_the_file_says(void **state) {
    (void)state;
    write_square("", "", "");
    lobe_scene *scene = load(file_name);
    assert_int_equal(lobe_scene_get_info(scene).cameras, 1);
    assert_string_equal(lobe_scene_camera_name(scene, 0), "eye");
    lobe_render_options o = small(SIZE, SIZE, 64);
    o.camera = "eye";
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_DEPTH);
    lobe_film *film = render(scene, o, NULL);
    float depth[SIZE * SIZE];
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_DEPTH, depth));
    assert_true(fabsf(depth[SIZE / 2 * SIZE + SIZE / 2] - 4.0f) < 0.02f);
    /* the corner of the picture, 4 tan(0.2) = 0.81 from its middle, still lies in the square */
    assert_true(fabsf(depth[0] - sqrtf(16.0f + 2.0f * 0.76f * 0.76f)) < 0.05f);
    lobe_film_free(film);
    lobe_scene_free(scene);
}

/* A quarter turn about its axis, counter-clockwise: what was up is on the right. */
static void cameras_roll(void **state) {
    (void)state;
    write_square(",\"rotation\":[0,0,0.70710678,0.70710678]", "", "");
    float left[3], right[3];
    first_hit(LOBE_AOV_ALBEDO, 3, 8, left);
    first_hit(LOBE_AOV_ALBEDO, 12, 8, right);
    assert_true(right[0] > 0.7f && right[2] < 0.3f && left[0] < 0.3f && left[2] > 0.7f);
}

static void assert_refused_with(const char *word) {
    lobe_scene *scene = NULL;
    assert_int_equal(lobe_scene_load(file_name, lobe_scene_default_options(), &scene),
                     LOBE_RENDER_BAD_INPUT);
    assert_null(scene);
    if (!strstr(lobe_render_error_message(), word))
        fail_msg("\"%s\" does not say %s", lobe_render_error_message(), word);
}

static void unknown_extensions_are_named(void **state) {
    (void)state;
    static const char *const names[] = {"KHR_materials_sheen", "EXT_nothing"};
    for (int i = 0; i < 2; ++i) {
        char more[128];
        snprintf(more, sizeof more, ",\"extensionsRequired\":[\"%s\"]", names[i]);
        write_square("", "", more);
        assert_refused_with(names[i]);
    }
}

static void circles_are_refused(void **state) {
    (void)state;
    write_square("", ",{\"children\":[3]},{\"children\":[2]}", "");
    assert_refused_with("nested");
}

/* Deep enough to exhaust the stack of a reader that recurses. */
static void deep_nesting_is_refused(void **state) {
    (void)state;
    enum { DEPTH = 200000 };
    FILE *file = fopen(file_name, "wb");
    assert_non_null(file);
    for (int i = 0; i < DEPTH; ++i) fputc('[', file);
    fclose(file);
    assert_refused_with("depth");
    file = fopen(file_name, "wb");
    assert_non_null(file);
    fprintf(file, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[");
    for (int i = 1; i < DEPTH; ++i) fprintf(file, "{\"children\":[%d]},", i);
    fprintf(file, "{}]}");
    fclose(file);
    assert_refused_with("nested");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(green_points_up),
        cmocka_unit_test(textures_stand_upright),
        cmocka_unit_test(cameras_stand_where_the_file_says),
        cmocka_unit_test(cameras_roll),
        cmocka_unit_test(unknown_extensions_are_named),
        cmocka_unit_test(circles_are_refused),
        cmocka_unit_test(deep_nesting_is_refused),
    };
    return cmocka_run_group_tests(tests, write_pictures, remove_files);
}
