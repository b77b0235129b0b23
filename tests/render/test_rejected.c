/* tests/render/test_rejected.c: the channel of rejected draws, with and without a normal map. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <stdio.h>
#include <unistd.h>

static const lobe_method HORIZON[] = {LOBE_METHOD_HORIZON_MIRROR, LOBE_METHOD_HORIZON_EXACT,
                                      LOBE_METHOD_HORIZON_UNIFORM, LOBE_METHOD_HORIZON,
                                      LOBE_METHOD_COUNT};
enum { METHODS = sizeof HORIZON / sizeof *HORIZON };

/* The mean of the channel over the picture, and its largest pixel. */
typedef struct rejected {
    double mean, largest;
} rejected;

static rejected rejected_in(const lobe_scene *scene, const char *name, lobe_method method) {
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
    print_message("%s, %s: mean %.3g %%, largest %.3g %%\n", name, lobe_render_method_name(method),
                  100 * r.mean, 100 * r.largest);
    return r;
}

static rejected rejected_of(const char *name, lobe_method method) {
    lobe_scene *scene = load(name);
    rejected r = rejected_in(scene, name, method);
    lobe_scene_free(scene);
    return r;
}

/* A rough metal floor: the shading normal is the geometric one. */
static lobe_scene *load_floor(void) {
    FILE *file = fopen("render-floor.obj", "wb");
    assert_non_null(file);
    fputs("v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3\nf 1 3 4\n", file);
    fclose(file);
    lobe_scene_options options = lobe_scene_default_options();
    options.default_metallic = 1;
    options.default_roughness = 0.8f;
    lobe_scene *scene = NULL;
    if (lobe_scene_load("render-floor.obj", options, &scene) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    unlink("render-floor.obj");
    return scene;
}

static void nothing_without_a_normal_map(void **state) {
    (void)state;
    lobe_scene *ground = load_floor();
    for (int k = 0; k < METHODS; ++k)
        assert_true(rejected_in(ground, "floor", HORIZON[k]).largest == 0);
    assert_true(rejected_in(ground, "floor", LOBE_METHOD_CAPS).mean > 0.01);
    lobe_scene_free(ground);
}

/* Of a strong normal map: the table leaves what is rejected where the tilt is too small for it, the smaller
 * ellipse what the other plane cuts off, bounded caps a fifth. */
static void little_under_a_normal_map(void **state) {
    (void)state;
    assert_true(rejected_of("normal-mapped", LOBE_METHOD_HORIZON).mean < 0.001);
    assert_true(rejected_of("normal-mapped", LOBE_METHOD_HORIZON_UNIFORM).mean < 0.075);
    assert_true(rejected_of("normal-mapped", LOBE_METHOD_HORIZON_MIRROR).mean < 0.075);
    assert_true(rejected_of("normal-mapped", LOBE_METHOD_COUNT).mean < 0.08);
    assert_true(rejected_of("normal-mapped", LOBE_METHOD_BOUNDED).mean > 0.15);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_without_a_normal_map),
                                       cmocka_unit_test(little_under_a_normal_map)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
