/* tests/render/test_wave.c: paths side by side, shaded in vectors by any instruction set, find the same bits as each of
 * them alone, shaded by lobe_surface_make. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "../../render/integrator.h"
#include "lobe/batch.h"
#include "pictures.h"

#include <string.h>

typedef struct rays {
    vec3 origins[WAVE_PATHS], directions[WAVE_PATHS];
    sampler numbers[WAVE_PATHS];
} rays;

/* Through the picture of the first camera. */
static void aim(const lobe_scene *scene, rays *r) {
    lobe_view view;
    assert_int_equal(lobe_scene_view(scene, NULL, 1.5f, &view), LOBE_RENDER_OK);
    const vec3 forward = v3_normalize_or(v3_sub(view.target, view.position), v3_all(0.0f));
    const frame f = frame_of(forward, view.up);
    for (uint32_t i = 0; i < WAVE_PATHS; i++) {
        r->numbers[i] =
            (sampler){.key = lobe_sampler_key(3, i, 0), .index_bits = 4, .index = i % 16};
        const sampler_point p = lobe_sampler_next(&r->numbers[i]);
        const vec3 aside = v3(sampler_unit(p.bits[0]) - 0.5f, sampler_unit(p.bits[1]) - 0.5f, 1.0f);
        r->origins[i] = view.position;
        r->directions[i] = v3_normalize_or(frame_to_world(&f, aside), forward);
    }
}

static void trace(const integrator *k, const rays *r, path *paths, int at_once) {
    for (int i = 0; i < WAVE_PATHS; i++)
        lobe_path_begin(&paths[i], k, r->origins[i], r->directions[i], r->numbers[i]);
    for (int i = 0; i < WAVE_PATHS; i += at_once) lobe_trace_paths(paths + i, at_once);
}

static void assert_same(const path *a, const path *b) {
    for (int i = 0; i < WAVE_PATHS; i++) {
        assert_memory_equal(&a[i].sample, &b[i].sample, sizeof a[i].sample);
        assert_int_equal(a[i].rays, b[i].rays);
    }
}

static void compare(const char *name, lobe_method method, lobe_g2 g2) {
    lobe_scene *scene = load(name);
    lobe_reflection_options o = lobe_reflection_default_options();
    o.model.method = method;
    o.g2 = g2;
    const coat_table **coats = lobe_find_coats(scene, &o);
    const integrator k = {.scene = scene,
                          .surface = {.ggx = o},
                          .coats = coats,
                          .heuristic = LOBE_HEURISTIC_BALANCE,
                          .depth = 8,
                          .roulette_depth = 5};
    rays r;
    path alone[WAVE_PATHS], side_by_side[WAVE_PATHS];
    aim(scene, &r);
    trace(&k, &r, alone, 1);
    const char *isa;
    for (int i = 0; (isa = lobe_isa_at(i)) != NULL; i++) {
        assert_true(lobe_restrict_isa(isa));
        trace(&k, &r, side_by_side, WAVE_PATHS);
        assert_same(alone, side_by_side);
    }
    lobe_restrict_isa(NULL);
    free(coats);
    lobe_scene_free(scene);
}

static void surfaces_of_every_kind(void **state) {
    (void)state;
    static const char *const scenes[] = {"gallery", "brushed", "normal-mapped", "cornell", "glass"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        compare(scenes[i], LOBE_METHOD_COUNT, LOBE_G2_CORRELATED);
}

static void every_method(void **state) {
    (void)state;
    for (int m = 0; m < LOBE_METHOD_COUNT; m++)
        if (lobe_model_exists((lobe_model){LOBE_NDF_GGX, LOBE_MASKING_SMITH, (lobe_method)m}))
            compare("normal-mapped", (lobe_method)m, LOBE_G2_CORRELATED);
    compare("cornell", LOBE_METHOD_HORIZON_UNIFORM, LOBE_G2_SEPARABLE);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(surfaces_of_every_kind),
                                       cmocka_unit_test(every_method)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
