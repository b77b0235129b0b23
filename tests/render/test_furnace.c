/* tests/render/test_furnace.c: a white sphere in white light is invisible: energy is neither lost nor
 * made, at any roughness of the coat, by any method. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

static void white_sphere_is_invisible(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    for (int m = 0; m < LOBE_METHOD_COUNT; ++m) {
        lobe_render_options o = small(32, 32, 32);
        o.ggx.method = (lobe_method)m;
        o.depth = 64;
        o.roulette_depth = 64;
        block_means means = measure(scene, o);
        for (int b = 0; b < BLOCKS * BLOCKS; ++b) {
            /* 5 standard errors, and the interpolation error of the coat's table */
            double room = 5 * means.error[b] + 0.002;
            if (!(fabs(means.mean[b] - 0.5) < room))
                fail_msg("%s, block %d: %g +- %g is not 0.5", lobe_method_name((lobe_method)m), b,
                         means.mean[b], means.error[b]);
        }
    }
    lobe_scene_free(scene);
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
                                       cmocka_unit_test(nothing_is_dropped)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
