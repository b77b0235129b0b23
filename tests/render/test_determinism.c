/* tests/render/test_determinism.c: the same bits on any number of threads; another seed, other bits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <string.h>

static void same_bits_on_any_number_of_threads(void **state) {
    (void)state;
    lobe_scene *scene = load("gallery");
    lobe_render_options o = small(67, 41, 5);
    const size_t bytes = 3 * sizeof(float) * 67 * 41;
    o.threads = 1;
    lobe_film *one = render(scene, o, NULL);
    float *expected = colors(one);
    for (int threads = 2; threads <= 5; ++threads) {
        o.threads = threads;
        lobe_film *film = render(scene, o, NULL);
        float *rgb = colors(film);
        assert_memory_equal(rgb, expected, bytes);
        free(rgb);
        lobe_film_free(film);
    }
    o.seed = 1;
    lobe_film *other = render(scene, o, NULL);
    float *rgb = colors(other);
    assert_true(memcmp(rgb, expected, bytes) != 0);
    free(rgb);
    free(expected);
    lobe_film_free(other);
    lobe_film_free(one);
    lobe_scene_free(scene);
}

static void a_cancelled_render_keeps_what_is_finished(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    volatile sig_atomic_t cancel = 1;
    lobe_render_options o = small(64, 64, 1000);
    o.cancel = &cancel;
    lobe_film *film = NULL;
    assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_INTERRUPTED);
    assert_non_null(film);
    lobe_film_free(film);
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(same_bits_on_any_number_of_threads),
                                       cmocka_unit_test(a_cancelled_render_keeps_what_is_finished)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
