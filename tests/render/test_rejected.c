/* tests/render/test_rejected.c: the channel of rejected draws, with and without a normal map. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

static const lobe_method HORIZON[] = {LOBE_METHOD_HORIZON_MIRROR, LOBE_METHOD_HORIZON_EXACT,
                                      LOBE_METHOD_HORIZON_UNIFORM, LOBE_METHOD_HORIZON};

/* The mean of the channel over the picture, and its largest pixel. */
typedef struct rejected {
    double mean, largest;
} rejected;

static rejected rejected_of(const char *name, lobe_method method) {
    lobe_scene *scene = load(name);
    lobe_render_options o = small(64, 36, 32);
    o.reflection.model.method = method;
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_REJECTED);
    lobe_film *film = render(scene, o, NULL);
    float share[64 * 36];
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_REJECTED, share));
    rejected r = {0, 0};
    for (int k = 0; k < 64 * 36; ++k) {
        r.mean += (double)share[k] / (64 * 36);
        r.largest = fmax(r.largest, (double)share[k]);
    }
    lobe_film_free(film);
    lobe_scene_free(scene);
    print_message("%s, %s: mean %.3g %%, largest %.3g %%\n", name, lobe_method_name(method),
                  100 * r.mean, 100 * r.largest);
    return r;
}

/* Flat walls without a normal map: the shading normal is the geometric one. */
static void nothing_without_a_normal_map(void **state) {
    (void)state;
    for (int k = 0; k < 4; ++k) assert_true(rejected_of("cornell", HORIZON[k]).largest == 0);
    assert_true(rejected_of("cornell", LOBE_METHOD_CAPS).mean > 0.01);
}

/* Of a strong normal map: the table leaves what is rejected where the tilt is too small for it, the smaller
 * ellipse what the other plane cuts off, bounded caps a quarter. */
static void little_under_a_normal_map(void **state) {
    (void)state;
    assert_true(rejected_of("normal-mapped", LOBE_METHOD_HORIZON).mean < 0.001);
    assert_true(rejected_of("normal-mapped", LOBE_METHOD_HORIZON_UNIFORM).mean < 0.07);
    assert_true(rejected_of("normal-mapped", LOBE_METHOD_HORIZON_MIRROR).mean < 0.07);
    assert_true(rejected_of("normal-mapped", LOBE_METHOD_BOUNDED).mean > 0.2);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_without_a_normal_map),
                                       cmocka_unit_test(little_under_a_normal_map)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
