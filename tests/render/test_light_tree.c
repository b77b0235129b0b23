/* tests/render/test_light_tree.c: the light tree draws with the probability that it tells, leaves out no light that
 * shines, gives the picture of the choice by power, and less noise where there are many lights. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <unistd.h>

#include <lobe/random.h>

#include "render/light_tree.h"

static float unit(uint64_t stream, uint64_t i) {
    return (float)(lobe_random(3, stream, i).word[0] >> 8) * 0x1p-24f;
}

static vec3 place(uint64_t stream, uint64_t i) {
    return v3(10 * unit(stream, 4 * i), 10 * unit(stream, 4 * i + 1), 10 * unit(stream, 4 * i + 2));
}

static vec3 direction(uint64_t stream, uint64_t i) {
    return v3_normalize_or(v3_sub(place(stream, i), v3_all(5)), v3(0, 1, 0));
}

/* Small squares, points and spots by turns; every seventh without power, and some at one place. */
static void make_lights(light_bounds *lights, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        const vec3 p = place(1, i % 11 ? i : 0);
        const int kind = (int)(i % 3);
        lights[i] = (light_bounds){.low = p,
                                   .high = kind ? p : v3_add(p, v3_scale(place(2, i), 0.05f)),
                                   .axis = direction(3, i),
                                   .spread = kind == 1 ? LOBE_PI : 0,
                                   .beyond = kind == 2 ? 0.4f : 0.5f * LOBE_PI,
                                   .power = i % 7 == 6 ? 0 : 0.01f + powf(unit(4, i), 3),
                                   .two_sided = kind == 0};
    }
}

enum { PLACES = 20 };

/* The normal: none, or one. */
static vec3 normal_at(uint64_t i) {
    return i % 2 ? direction(6, i) : v3_all(0);
}

static void probabilities_add_up(void **state) {
    (void)state;
    static light_bounds lights[1500];
    static const uint32_t counts[] = {1, 2, 3, 17, 200, 1500};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        light_tree tree;
        make_lights(lights, counts[k]);
        assert_true(lobe_light_tree_create(&tree, lights, counts[k]));
        for (uint64_t i = 0; i < PLACES; i++) {
            double sum = 0;
            for (uint32_t l = 0; l < counts[k]; l++) {
                const float p = lobe_light_tree_probability(&tree, place(5, i), normal_at(i), l);
                assert_true(p >= 0 && p <= 1 && (lights[l].power > 0 || p == 0));
                sum += (double)p;
            }
            assert_true(fabs(sum - 1) < 1e-4);
        }
        lobe_light_tree_free(&tree);
    }
}

/* chi^2 over the lights that are expected at least 5 times, within 4.5 standard deviations in each of 20 places: once in
 * 7,000 times for a right tree. */
static void draws_are_what_is_told(void **state) {
    (void)state;
    enum { LIGHTS = 200, DRAWS = 40000 };
    light_bounds lights[LIGHTS];
    light_tree tree;
    make_lights(lights, LIGHTS);
    assert_true(lobe_light_tree_create(&tree, lights, LIGHTS));
    for (uint64_t i = 0; i < PLACES; i++) {
        int counts[LIGHTS] = {0}, bins = 0;
        for (uint64_t k = 0; k < DRAWS; k++) {
            const double u = lobe_random(7, i, k).word[0] * 0x1p-32;
            float told;
            const uint32_t l = lobe_light_tree_draw(&tree, place(5, i), normal_at(i), u, &told);
            const float p = lobe_light_tree_probability(&tree, place(5, i), normal_at(i), l);
            assert_true(l < LIGHTS && fabsf(told - p) <= 1e-5f * p && p > 0);
            counts[l]++;
        }
        double chi2 = 0;
        for (uint32_t l = 0; l < LIGHTS; l++) {
            const double expected =
                DRAWS * (double)lobe_light_tree_probability(&tree, place(5, i), normal_at(i), l);
            if (expected < 5) continue;
            chi2 += pow(counts[l] - expected, 2) / expected;
            bins++;
        }
        if (!(fabs(chi2 - bins) < 4.5 * sqrt(2.0 * bins)))
            fail_msg("place %d: chi^2 %g of %d", (int)i, chi2, bins);
    }
    lobe_light_tree_free(&tree);
}

/* A spot that shines on a place, a point, and a square that is seen from there: each may be drawn. */
static void no_light_is_left_out(void **state) {
    (void)state;
    enum { LIGHTS = 300 };
    light_bounds lights[LIGHTS];
    light_tree tree;
    make_lights(lights, LIGHTS);
    assert_true(lobe_light_tree_create(&tree, lights, LIGHTS));
    int dark = 0;
    for (uint64_t i = 0; i < 200; i++)
        for (uint32_t l = 0; l < LIGHTS; l++) {
            const vec3 to = v3_sub(place(8, i), lights[l].low);
            const float cosine = v3_dot(v3_normalize_or(to, v3(0, 1, 0)), lights[l].axis);
            const int shines = lights[l].power > 0 && (l % 3 < 2 || cosine > cosf(0.4f));
            const float p = lobe_light_tree_probability(&tree, place(8, i), normal_at(i), l);
            if (shines && !(p > 0)) fail_msg("light %u is left out at place %d", l, (int)i);
            dark += lights[l].power > 0 && p == 0;
        }
    assert_true(dark > 1000); /* spots that look away */
    lobe_light_tree_free(&tree);
}

static void extreme_lights(void **state) {
    (void)state;
    light_bounds lights[4];
    const vec3 places[4] = {v3_all(0), v3_all(1e30f), v3_all(-1e30f), v3_all(1e-30f)};
    for (int i = 0; i < 4; i++)
        lights[i] = (light_bounds){.low = places[i],
                                   .high = v3_add(places[i], v3(0, i == 1 ? 1e30f : 0, 0)),
                                   .axis = v3(0, 1, 0),
                                   .beyond = 0.5f * LOBE_PI,
                                   .power = i == 2 ? 1e-37f : 1,
                                   .two_sided = 1};
    light_tree tree;
    assert_true(lobe_light_tree_create(&tree, lights, 4));
    for (int i = 0; i < 4; i++) {
        double sum = 0;
        for (uint32_t l = 0; l < 4; l++)
            sum += (double)lobe_light_tree_probability(&tree, places[i], v3(0, 1, 0), l);
        assert_true(fabs(sum - 1) < 1e-5);
    }
    lobe_light_tree_free(&tree);
    for (int i = 0; i < 4; i++) lights[i].power = 0;
    assert_true(lobe_light_tree_create(&tree, lights, 4));
    assert_null(tree.nodes);
    lobe_light_tree_free(&tree);
}

/* ---- Pictures --------------------------------------------------------------------------------- */

static const lobe_heuristic others[] = {LOBE_HEURISTIC_BSDF_ONLY, LOBE_HEURISTIC_LIGHT_ONLY};

static void estimators_agree(void **state) {
    (void)state;
    lobe_scene *scene = load("cornell");
    lobe_render_options o = small(32, 32, 32);
    o.light_choice = LOBE_LIGHTS_POWER;
    o.depth = 3;
    const block_means power = measure(scene, o);
    o.light_choice = LOBE_LIGHTS_TREE;
    o.seed = 50;
    const block_means tree = measure(scene, o);
    const double z = disagreement(&tree, &power);
    if (!(z < 2.2)) fail_msg("off by %g standard errors", z);
    assert_estimators_agree(scene, o, others, 2, 60);
    lobe_scene_free(scene);
}

/* A floor below 300 glowing squares, of which few are near any of its points. */
static lobe_scene *hall(void) {
    char path[64], library[64];
    snprintf(path, sizeof path, "/tmp/lobe-hall-%ld.obj", (long)getpid());
    snprintf(library, sizeof library, "/tmp/lobe-hall-%ld.mtl", (long)getpid());
    FILE *file = fopen(library, "w");
    assert_non_null(file);
    fputs("newmtl floor\nKd .7 .7 .7\nKs 0 0 0\nnewmtl lamp\nKd 0 0 0\nKs 0 0 0\nKe 50 50 50\n",
          file);
    fclose(file);
    file = fopen(path, "w");
    assert_non_null(file);
    fprintf(
        file,
        "mtllib %s\nv -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nusemtl floor\nf 1 2 3 4\nusemtl lamp\n",
        library + 5);
    for (int i = 0; i < 300; i++) {
        const double x = 18 * (double)unit(9, 3 * (uint64_t)i) - 9,
                     z = 18 * (double)unit(9, 3 * (uint64_t)i + 1) - 9, y = 0.5, r = 0.05;
        fprintf(file, "v %g %g %g\nv %g %g %g\nv %g %g %g\nv %g %g %g\nf -4 -3 -2 -1\n", x - r, y,
                z - r, x + r, y, z - r, x + r, y, z + r, x - r, y, z + r);
    }
    fclose(file);
    lobe_scene *scene = load(path);
    remove(path);
    remove(library);
    return scene;
}

static void many_lights(void **state) {
    (void)state;
    lobe_scene *scene = hall();
    assert_int_equal(lobe_scene_get_info(scene).emissive_triangles, 600);
    lobe_view view = {{0, 3, 9}, {0, 0, 0}, {0, 1, 0}, 40};
    lobe_render_options o = small(32, 32, 64);
    o.view = &view;
    o.depth = 2;
    double noise[3];
    block_means means[2];
    for (int i = 0; i < 3; i++) {
        static const lobe_light_choice choices[] = {LOBE_LIGHTS_POWER, LOBE_LIGHTS_TREE,
                                                    LOBE_LIGHTS_AUTOMATIC};
        lobe_render_statistics statistics;
        o.light_choice = choices[i];
        o.seed = i == 1 ? 20 : 10;
        if (i < 2) means[i] = measure(scene, o);
        o.seed = 1;
        lobe_film_free(render(scene, o, &statistics));
        noise[i] = statistics.noise;
    }
    const double z = disagreement(&means[0], &means[1]);
    if (!(z < 2.2)) fail_msg("off by %g standard errors", z);
    if (!(noise[1] < 0.75 * noise[0])) fail_msg("noise %g, not %g", noise[1], noise[0]);
    assert_true(noise[2] == noise[1]);
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probabilities_add_up), cmocka_unit_test(draws_are_what_is_told),
        cmocka_unit_test(no_light_is_left_out), cmocka_unit_test(extreme_lights),
        cmocka_unit_test(estimators_agree),     cmocka_unit_test(many_lights)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
