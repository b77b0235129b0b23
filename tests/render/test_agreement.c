/* tests/render/test_agreement.c: every method and every estimator gives the same picture. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <string.h>

/* Few samples say nothing about the mean of unbounded weights (all normals), and a published error is
 * one. */
static int is_left_out(lobe_method method) {
    return method == LOBE_METHOD_NDF || method == LOBE_METHOD_SLOPE_PUBLISHED ||
           method == LOBE_METHOD_NEWTON_PUBLISHED;
}

static int is_usual(lobe_model model) {
    return model.ndf == LOBE_NDF_GGX && model.masking == LOBE_MASKING_SMITH;
}

/* With the first method of the same surface; the tables of brushed coats take long to make and are made for
 * one surface. */
static void methods_agree(void **state) {
    const char *name = *state;
    const int only_usual = strcmp(name, "gallery") == 0;
    lobe_scene *scene = load(name);
    lobe_render_options o = small(32, 32, 24);
    o.depth = 3;
    lobe_model first = lobe_model_at(-1);
    block_means expected;
    for (int m = 0; m < lobe_model_count(); ++m) {
        const lobe_model model = lobe_model_at(m);
        if (is_left_out(model.method) || (only_usual && !is_usual(model))) continue;
        o.reflection.model = model;
        o.seed = 77 + (uint64_t)m;
        block_means means = measure(scene, o);
        if (model.ndf != first.ndf || model.masking != first.masking) {
            first = model;
            expected = means;
            continue;
        }
        double z = disagreement(&means, &expected);
        if (!(z < 2.2))
            fail_msg("%s: %s %s %s is off by %g standard errors", name, lobe_ndf_name(model.ndf),
                     lobe_masking_name(model.masking), lobe_method_name(model.method), z);
    }
    lobe_scene_free(scene);
}

/* A box without a strong sun: all three estimators have a mean that few samples can tell. */
static void estimators_agree(void **state) {
    (void)state;
    lobe_scene *scene = load("cornell");
    lobe_render_options o = small(32, 32, 96);
    o.depth = 2;
    const lobe_heuristic others[] = {LOBE_HEURISTIC_BALANCE, LOBE_HEURISTIC_BSDF_ONLY,
                                     LOBE_HEURISTIC_LIGHT_ONLY};
    assert_estimators_agree(scene, o, others, 3, 5);
    lobe_scene_free(scene);
}

/* The values of random walks that lamps are weighed with are those of the walks that are drawn. */
static void walks_agree(void **state) {
    (void)state;
    lobe_scene *scene = load("gallery");
    lobe_render_options o = small(32, 32, 96);
    o.depth = 1;
    o.multiscatter = LOBE_MULTISCATTER_WALK;
    const lobe_heuristic others[] = {LOBE_HEURISTIC_POWER, LOBE_HEURISTIC_LIGHT_ONLY};
    assert_estimators_agree(scene, o, others, 2, 15);
    lobe_scene_free(scene);
}

/* The test can fail: the biased normalisation makes the normal-mapped wall too bright. */
static void previous_normalization_is_too_bright(void **state) {
    (void)state;
    lobe_scene *scene = load("normal-mapped");
    lobe_render_options o = small(32, 32, 48);
    o.depth = 1;
    o.reflection.model.method = LOBE_METHOD_ELLIPSOID;
    o.heuristic = LOBE_HEURISTIC_BSDF_ONLY;
    block_means right = measure(scene, o);
    o.reflection.normalization = LOBE_NORMALIZATION_PREVIOUS;
    block_means previous = measure(scene, o);
    double sum_right = 0, sum_previous = 0;
    for (int b = 0; b < BLOCKS * BLOCKS; ++b) {
        sum_right += right.mean[b];
        sum_previous += previous.mean[b];
    }
    assert_true(sum_previous > 1.0005 * sum_right);
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        {"methods_agree on cornell", methods_agree, NULL, NULL, "cornell"},
        {"methods_agree on gallery", methods_agree, NULL, NULL, "gallery"},
        cmocka_unit_test(estimators_agree),
        cmocka_unit_test(walks_agree),
        cmocka_unit_test(previous_normalization_is_too_bright),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
