/* tests/render/test_furnace.c: a white sphere in white light is invisible: energy is neither lost nor
 * made, at any roughness of the coat, by any method. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <stdio.h>
#include <unistd.h>

static void white_sphere_is_invisible(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    for (int m = 0; m < lobe_model_count(); ++m) {
        lobe_render_options o = small(32, 32, 32);
        o.reflection.model = lobe_model_at(m);
        o.depth = 64;
        o.roulette_depth = 64;
        block_means means = measure(scene, o);
        for (int b = 0; b < BLOCKS * BLOCKS; ++b) {
            /* 5 standard errors, and the interpolation error of the coat's table */
            double room = 5 * means.error[b] + 0.002;
            if (!(fabs(means.mean[b] - 0.5) < room))
                fail_msg("%s, block %d: %g +- %g is not 0.5",
                         lobe_method_name(lobe_model_at(m).method), b, means.mean[b],
                         means.error[b]);
        }
    }
    lobe_scene_free(scene);
}

/* Whatever the coat, also a mirror, white reflects all light: the file is a square that fills the
 * picture. */
static void white_coats_lose_nothing(void **state) {
    (void)state;
    const char obj[] = "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3\nf 1 3 4\n";
    FILE *file = fopen("render-white.obj", "wb");
    assert_non_null(file);
    fputs(obj, file);
    fclose(file);
    write_even_light("render-white.pfm", 0.5f);
    const float roughnesses[] = {0.0f, 0.05f, 0.28f, 0.6f, 1.0f};
    for (int k = 0; k < 5; ++k) {
        lobe_scene_options options = lobe_scene_default_options();
        options.environment = "render-white.pfm";
        options.default_roughness = roughnesses[k];
        for (int c = 0; c < 3; ++c) options.default_base_color[c] = 1.0f;
        lobe_scene *scene = NULL;
        if (lobe_scene_load("render-white.obj", options, &scene) != LOBE_RENDER_OK)
            fail_msg("%s", lobe_render_error_message());
        block_means means = measure(scene, small(16, 16, 64));
        /* the blocks in the middle, that hold nothing but the square */
        const int middle[] = {5, 6, 9, 10};
        for (int b = 0; b < 4; ++b) {
            double mean = means.mean[middle[b]], error = means.error[middle[b]];
            if (!(fabs(mean - 0.5) < 5 * error + 0.002))
                fail_msg("roughness %g: %g +- %g is not 0.5", (double)roughnesses[k], mean, error);
        }
        lobe_scene_free(scene);
    }
    unlink("render-white.obj");
    unlink("render-white.pfm");
}

static void nothing_is_dropped(void **state) {
    (void)state;
    for (size_t i = 0; lobe_builtin_scene_name(i); ++i) {
        lobe_scene *scene = load(lobe_builtin_scene_name(i));
        lobe_render_statistics st;
        lobe_film_free(render(scene, small(48, 32, 16), &st));
        assert_int_equal(st.dropped_samples, 0);
        assert_int_equal(st.samples, 48 * 32 * 16);
        assert_true(st.ggx_rejected <= st.ggx_draws && st.rays > st.samples);
        lobe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(white_sphere_is_invisible),
                                       cmocka_unit_test(white_coats_lose_nothing),
                                       cmocka_unit_test(nothing_is_dropped)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
