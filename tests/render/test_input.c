/* tests/render/test_input.c: unusable files and options give one line and no film; what can be read is
 * read. Files are written below the current folder of the test. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <lobe/random.h>

static void write_file(const char *path, const void *data, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

static void assert_refused(const char *path) {
    lobe_scene *scene = NULL;
    assert_int_equal(lobe_scene_load(path, lobe_scene_default_options(), &scene),
                     LOBE_RENDER_BAD_INPUT);
    assert_null(scene);
    const char *message = lobe_render_error_message();
    assert_true(strlen(message) > 10 && !strchr(message, '\n') && strstr(message, ": "));
}

static void broken_files_are_refused(void **state) {
    (void)state;
    assert_refused("no-such-file.glb");
    write_file("render-empty.glb", "", 0);
    assert_refused("render-empty.glb");
    char bytes[4096];
    for (int round = 0; round < 20; ++round) {
        for (size_t i = 0; i < sizeof bytes; ++i)
            bytes[i] = (char)lobe_random(3, (uint64_t)round, i).word[0];
        const char *names[] = {"render-random.glb", "render-random.gltf", "render-random.obj"};
        write_file(names[round % 3], bytes, sizeof bytes);
        assert_refused(names[round % 3]);
        unlink(names[round % 3]);
    }
    const char basis[] = "{\"asset\":{\"version\":\"2.0\"},"
                         "\"extensionsRequired\":[\"KHR_texture_basisu\"]}";
    write_file("render-basis.gltf", basis, sizeof basis - 1);
    assert_refused("render-basis.gltf");
    assert_non_null(strstr(lobe_render_error_message(), "KHR_texture_basisu"));
    unlink("render-basis.gltf");
    unlink("render-empty.glb");
}

static void triangles_without_area_are_dropped(void **state) {
    (void)state;
    const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\n"
                       "f 1 2 3\nf 1 2 4\nf 2 4 5\n";
    write_file("render-flat.obj", obj, sizeof obj - 1);
    lobe_scene *scene = load("render-flat.obj");
    lobe_scene_info info = lobe_scene_get_info(scene);
    assert_int_equal(info.triangles, 1);
    lobe_film *film = render(scene, small(8, 8, 1), NULL);
    lobe_film_free(film);
    lobe_scene_free(scene);
    unlink("render-flat.obj");
}

static void options_out_of_range_are_refused(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    lobe_film *film = NULL;
    lobe_render_options o = small(0, 8, 1);
    assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_BAD_INPUT);
    o = small(8, 8, 0);
    assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_BAD_INPUT);
    o = small(8, 8, 1);
    o.camera = "nobody";
    assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_BAD_INPUT);
    assert_null(film);
    lobe_scene_free(scene);
}

static void films_are_written_whole_and_read_back(void **state) {
    (void)state;
    lobe_scene *scene = load("cornell");
    lobe_render_options o = small(24, 16, 4);
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_ALBEDO) | LOBE_AOV_BIT(LOBE_AOV_REJECTED);
    lobe_film *film = render(scene, o, NULL);
    lobe_film_write_options w = lobe_film_default_write_options();
    w.pixels = LOBE_FILM_FLOAT;
    const char *names[] = {"render-film.exr", "render-film.pfm"};
    for (int k = 0; k < 2; ++k) {
        assert_int_equal(lobe_film_write(film, names[k], w), LOBE_RENDER_OK);
        lobe_film *back = NULL;
        assert_int_equal(lobe_film_read(names[k], &back), LOBE_RENDER_OK);
        lobe_picture_difference d;
        assert_int_equal(lobe_film_compare(back, film, &d), LOBE_RENDER_OK);
        assert_true(d.largest < 1e-6 && d.mean > 0);
        lobe_film_free(back);
        unlink(names[k]);
    }
    assert_int_equal(lobe_film_write(film, "render-film.png", w), LOBE_RENDER_OK);
    unlink("render-film.png");
    assert_int_equal(lobe_film_write(film, "/no/such/folder/a.png", w), LOBE_RENDER_FAILED);
    assert_int_equal(lobe_film_write(film, "a.jpeg", w), LOBE_RENDER_BAD_INPUT);
    lobe_film_free(film);
    lobe_scene_free(scene);
}

/* Some zeros and then noise, of any length after compression: that of the pixels too, which says that there is none. */
static void films_of_any_compressed_length_come_back(void **state) {
    (void)state;
    enum { W = 32, H = 4, VALUES = 3 * W * H, ROUNDS = 450 };
    static const char path[] = "render-noise.exr";
    static float in[VALUES], out[VALUES];
    lobe_film_write_options w = lobe_film_default_write_options();
    w.pixels = LOBE_FILM_FLOAT;
    for (int round = 0; round < ROUNDS; ++round) {
        lobe_film *film = NULL, *back = NULL;
        for (int i = 0; i < VALUES; ++i) {
            const uint32_t word = lobe_random(3, (uint64_t)round, (uint64_t)i).word[0] >> 2;
            memcpy(&in[i], &word, sizeof word);
            if (i % 3 == 2 && i / 3 < 10 + round % 15) in[i] = 0; /* blue comes first in the file */
        }
        assert_int_equal(lobe_film_from_rgb(in, W, H, &film), LOBE_RENDER_OK);
        assert_int_equal(lobe_film_write(film, path, w), LOBE_RENDER_OK);
        assert_int_equal(lobe_film_read(path, &back), LOBE_RENDER_OK);
        assert_true(lobe_film_copy_rgb(back, out));
        if (memcmp(in, out, sizeof in) != 0) fail_msg("round %d", round);
        lobe_film_free(film);
        lobe_film_free(back);
    }
    unlink(path);
}

/* Real files, where they lie beside the project: quantised, packed by meshoptimizer and by Draco, with
 * skins, in OBJ. */
static void real_files(void **state) {
    (void)state;
    static const char *const models[] = {"barrel.glb", "retroufo.glb",      "CesiumMan.glb",
                                         "pirate.glb", "suzanne-draco.glb", "teapot.obj"};
    const char *root = getenv("LOBE_SOURCE_DIR");
    char model[4096], panorama[4096];
    snprintf(panorama, sizeof panorama, "%s/../shared/scenes/environments/venice.exr",
             root ? root : ".");
    for (size_t i = 0; i < sizeof models / sizeof *models; ++i) {
        snprintf(model, sizeof model, "%s/../shared/scenes/models/%s", root ? root : ".",
                 models[i]);
        if (access(model, R_OK) != 0 || access(panorama, R_OK) != 0) {
            print_message("%s does not lie beside the project: left out\n", models[i]);
            continue;
        }
        lobe_scene_options options = lobe_scene_default_options();
        if (i == 0) options.environment = panorama;
        lobe_scene *scene = NULL;
        if (lobe_scene_load(model, options, &scene) != LOBE_RENDER_OK)
            fail_msg("%s", lobe_render_error_message());
        assert_true(lobe_scene_get_info(scene).triangles > 800);
        assert_int_equal(lobe_scene_get_info(scene).missing_textures, 0);
        lobe_render_statistics st;
        lobe_film_free(render(scene, small(32, 32, 4), &st));
        assert_int_equal(st.dropped_samples, 0);
        lobe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(broken_files_are_refused),
                                       cmocka_unit_test(triangles_without_area_are_dropped),
                                       cmocka_unit_test(options_out_of_range_are_refused),
                                       cmocka_unit_test(films_are_written_whole_and_read_back),
                                       cmocka_unit_test(films_of_any_compressed_length_come_back),
                                       cmocka_unit_test(real_files)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
