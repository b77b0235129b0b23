/* tests/render/test_metal.c: metals of every law in even light reflect what the quadrature of the library says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include "render/integrator.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static lobe_scene *plate;

/* A large square in z = 0 under light of radiance 1 from everywhere. */
static int load_plate(void **state) {
    (void)state;
    FILE *file = fopen("render-metal.obj", "wb");
    assert_non_null(file);
    fputs("v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3\nf 1 3 4\n", file);
    fclose(file);
    write_even_light("render-metal.pfm", 1.0f);
    lobe_scene_options options = lobe_scene_default_options();
    options.environment = "render-metal.pfm";
    if (lobe_scene_load("render-metal.obj", options, &plate) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    unlink("render-metal.obj");
    unlink("render-metal.pfm");
    assert_true(plate->triangle_count == 2 && plate->material_count < 8);
    return 0;
}

static int free_plate(void **state) {
    (void)state;
    lobe_scene_free(plate);
    return 0;
}

/* One for each law; none says by chance what the base colour says. */
static const vec3 base_color = {0.9f, 0.5f, 0.15f};
static const lobe_metal laws[] = {
    {.law = LOBE_METAL_SCHLICK},
    {.law = LOBE_METAL_F82, .tint = {0.9f, 0.6f, 0.3f}},
    {.law = LOBE_METAL_CONDUCTOR, .n = {0.2f, 2.9f, 1.5f}, .k = {3.6f, 3.1f, 0.2f}}};
enum { LAWS = sizeof laws / sizeof *laws };

static const char *const modes[] = {"none", "kulla-conty", "turquin", "walk"};

typedef struct estimate {
    double mean[3], error[3]; /* by channel; standard error */
} estimate;

/* What a picture is made of. */
typedef struct setting {
    lobe_metal law;
    lobe_multiscatter multiscatter;
    lobe_heuristic heuristic;
    lobe_ndf ndf;
    float metallic, roughness, cosine;
} setting;

enum { SAMPLES = 256, RUNS = 32 };
/* Student's t of 31 degrees of freedom is beyond it with a probability of 5e-6; some 400 numbers are asked. */
static const double far = 5.5;

static vec3 toward_viewer(double cosine) {
    return v3((float)sqrt(1 - cosine * cosine), 0.0f, (float)cosine);
}

static void add_run(const integrator *k, const setting *s, uint64_t run, estimate *e) {
    const vec3 from = toward_viewer((double)s->cosine);
    double total[3] = {0};
    for (uint32_t i = 0; i < SAMPLES; ++i) {
        sampler points = {.key = lobe_sampler_key(run, 7, 0),
                          .index = i,
                          .index_bits = lobe_sampler_index_bits(SAMPLES)};
        uint64_t rays = 0;
        const vec3 light = lobe_trace_path(k, from, v3_neg(from), &points, &rays).radiance;
        const float channels[] = {light.x, light.y, light.z};
        for (int c = 0; c < 3; ++c) total[c] += (double)channels[c] / SAMPLES;
    }
    for (int c = 0; c < 3; ++c) {
        e->mean[c] += total[c] / RUNS;
        e->error[c] += total[c] * total[c] / RUNS;
    }
}

static estimate measure_plate(setting s) {
    material m = lobe_default_material();
    m.base_color = base_color;
    m.metallic = s.metallic;
    m.roughness = s.roughness;
    lobe_material_settle(&m);
    for (uint32_t i = 0; i < plate->material_count; ++i) plate->materials[i] = m;
    lobe_reflection_options reflection = lobe_reflection_default_options();
    reflection.model = (lobe_model){s.ndf, LOBE_MASKING_SMITH, LOBE_METHOD_COUNT};
    if (s.ndf != LOBE_NDF_GGX)
        reflection.model.method = lobe_best_method(s.ndf, LOBE_MASKING_SMITH);
    const coat_table *coat = lobe_coat_table(s.ndf, LOBE_MASKING_SMITH, reflection.g2, COAT_IOR, 0),
                     *coats[8];
    for (uint32_t i = 0; i <= plate->material_count; ++i) coats[i] = coat;
    const metal prepared = lobe_metal_prepare(&s.law);
    const integrator k = {
        .scene = plate,
        .surface = {.ggx = reflection, .multiscatter = s.multiscatter, .metal = &prepared},
        .coats = coats,
        .heuristic = s.heuristic,
        .depth = 1,
        .roulette_depth = 2};
    estimate e = {{0}, {0}};
    for (uint64_t run = 0; run < RUNS; ++run) add_run(&k, &s, run, &e);
    for (int c = 0; c < 3; ++c)
        e.error[c] = sqrt(fmax(e.error[c] - e.mean[c] * e.mean[c], 0) / (RUNS - 1));
    return e;
}

static lobe_reflectance reflectance_of(const lobe_metal *law, int c) {
    const float f0[] = {base_color.x, base_color.y, base_color.z};
    const lobe_reflectance by_law[] = {
        {LOBE_REFLECTANCE_SCHLICK, (double)f0[c], 0},
        {LOBE_REFLECTANCE_F82, (double)f0[c], (double)law->tint[c]},
        {LOBE_REFLECTANCE_CONDUCTOR, (double)law->n[c], (double)law->k[c]}};
    return by_law[law->law];
}

static lobe_microsurface microsurface(const setting *s) {
    const double alpha = (double)s->roughness * (double)s->roughness;
    return (lobe_microsurface){s->ndf, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, alpha, alpha};
}

static lobe_vec3_f64 viewer(const setting *s) {
    const double mu = (double)s->cosine;
    return (lobe_vec3_f64){sqrt(1 - mu * mu), 0, mu};
}

/* 2 * integral of F mu dmu, by the midpoint rule: no closed form and no quadrature of the library. */
static double average_of(lobe_reflectance f) {
    enum { STEPS = 20000 };
    double sum = 0;
    for (int i = 0; i < STEPS; ++i) {
        const double mu = (i + 0.5) / STEPS;
        sum += 2 * mu * lobe_reflectance_at(f, mu) / STEPS;
    }
    return sum;
}

/* By quadrature in double, all but the walks. */
static double albedo_of(const setting *s, int channel) {
    const lobe_microsurface m = microsurface(s);
    const lobe_reflectance f = reflectance_of(&s->law, channel), one = lobe_reflectance_one();
    const double first = lobe_albedo(m, f, viewer(s), LOBE_EFFORT_FINE);
    if (s->multiscatter == LOBE_MULTISCATTER_NONE) return first;
    const double missing = 1 - lobe_albedo(m, one, viewer(s), LOBE_EFFORT_FINE);
    if (s->multiscatter == LOBE_MULTISCATTER_TURQUIN)
        return first * (1 + lobe_reflectance_at(f, 1) * missing / (1 - missing));
    const double lacks = 1 - lobe_albedo_average(m, one, LOBE_EFFORT_FINE), f_avg = average_of(f);
    return first + missing * f_avg * f_avg * (1 - lacks) / (1 - f_avg * lacks);
}

static estimate walks_of(const setting *s) {
    enum { WALKS = 20000 };
    lobe_reflectance f[3];
    for (int c = 0; c < 3; ++c) f[c] = reflectance_of(&s->law, c);
    estimate e = {{0}, {0}};
    for (uint64_t k = 0; k < WALKS; ++k) {
        double weight[3];
        lobe_walk_sample(microsurface(s), f, 3, viewer(s), 3, k, 10000, weight);
        for (int c = 0; c < 3; ++c) {
            e.mean[c] += weight[c] / WALKS;
            e.error[c] += weight[c] * weight[c] / WALKS;
        }
    }
    for (int c = 0; c < 3; ++c) e.error[c] = sqrt((e.error[c] - e.mean[c] * e.mean[c]) / WALKS);
    return e;
}

static estimate truth_of(const setting *s) {
    if (s->multiscatter == LOBE_MULTISCATTER_WALK) return walks_of(s);
    estimate e = {{0}, {0}};
    for (int c = 0; c < 3; ++c) e.mean[c] = albedo_of(s, c);
    return e;
}

/* The floor: the table of what is missing, and float. */
static double room_between(const estimate *a, const estimate *b, int c) {
    return far * hypot(a->error[c], b->error[c]) + 5e-5;
}

static void assert_near_truth(const setting *s, const estimate *measured, const estimate *truth) {
    for (int c = 0; c < 3; ++c) {
        const double room = room_between(measured, truth, c);
        if (!(fabs(measured->mean[c] - truth->mean[c]) < room))
            fail_msg("law %d, %s, %s, %s, roughness %g, cosine %g, channel %d: %g is not within %g "
                     "of %g",
                     (int)s->law.law, modes[s->multiscatter], lobe_heuristic_name(s->heuristic),
                     lobe_ndf_name(s->ndf), (double)s->roughness, (double)s->cosine, c,
                     measured->mean[c], room, truth->mean[c]);
    }
}

/* Every way to combine light and surface samples gives it. */
static void metals_reflect_their_albedo(void **state) {
    const lobe_multiscatter multiscatter = (lobe_multiscatter)(intptr_t)*state;
    const lobe_heuristic heuristics[] = {LOBE_HEURISTIC_BALANCE, LOBE_HEURISTIC_BSDF_ONLY,
                                         LOBE_HEURISTIC_LIGHT_ONLY};
    const float roughnesses[] = {0.5f, 0.9f}, cosines[] = {0.2f, 0.8f};
    for (int l = 0; l < LAWS; ++l)
        for (int r = 0; r < 2; ++r)
            for (int a = 0; a < 2; ++a) {
                setting s = {.law = laws[l],
                             .multiscatter = multiscatter,
                             .ndf = LOBE_NDF_GGX,
                             .metallic = 1.0f,
                             .roughness = roughnesses[r],
                             .cosine = cosines[a]};
                const estimate truth = truth_of(&s);
                for (int h = 0; h < 3; ++h) {
                    s.heuristic = heuristics[h];
                    const estimate measured = measure_plate(s);
                    assert_near_truth(&s, &measured, &truth);
                }
            }
}

static void metals_of_beckmann_too(void **state) {
    (void)state;
    for (int l = 0; l < LAWS; ++l) {
        const setting s = {.law = laws[l],
                           .multiscatter = LOBE_MULTISCATTER_KULLA_CONTY,
                           .ndf = LOBE_NDF_BECKMANN,
                           .metallic = 1.0f,
                           .roughness = 0.8f,
                           .cosine = 0.4f};
        const estimate truth = truth_of(&s), measured = measure_plate(s);
        assert_near_truth(&s, &measured, &truth);
    }
}

/* The test can fail: what a law reflects is far from what the two others do. */
static void laws_are_told_apart(void **state) {
    (void)state;
    for (int l = 0; l < LAWS; ++l) {
        setting s = {.law = laws[l], .metallic = 1.0f, .roughness = 0.5f, .cosine = 0.2f};
        const estimate measured = measure_plate(s);
        for (int other = 0; other < LAWS; ++other) {
            if (other == l) continue;
            s.law = laws[other];
            const estimate truth = truth_of(&s);
            for (int c = 0; c < 3; ++c)
                assert_true(fabs(measured.mean[c] - truth.mean[c]) >
                            4 * room_between(&measured, &truth, c));
        }
    }
}

/* A mirror reflects F itself. */
static void mirrors_reflect_the_law(void **state) {
    (void)state;
    for (int l = 0; l < LAWS; ++l)
        for (int m = 0; m <= LOBE_MULTISCATTER_WALK; ++m) {
            const setting s = {.law = laws[l],
                               .multiscatter = (lobe_multiscatter)m,
                               .metallic = 1.0f,
                               .cosine = 1.0f / 7.0f};
            const estimate measured = measure_plate(s);
            for (int c = 0; c < 3; ++c) {
                const lobe_reflectance f = reflectance_of(&laws[l], c);
                const double exact = lobe_reflectance_at(f, (double)s.cosine);
                if (!(fabs(measured.mean[c] - exact) < 2e-5))
                    fail_msg("law %d, channel %d: %g is not %g", l, c, measured.mean[c], exact);
            }
        }
}

/* Half of a partly metallic surface is the metal, half the coat over a base of the base colour. */
static void half_metals_are_half_of_both(void **state) {
    (void)state;
    for (int l = 0; l < LAWS; ++l)
        for (int m = 0; m <= LOBE_MULTISCATTER_WALK; ++m) {
            setting s = {.law = laws[l],
                         .multiscatter = (lobe_multiscatter)m,
                         .metallic = 1.0f,
                         .roughness = 0.8f,
                         .cosine = 0.5f};
            const estimate whole = truth_of(&s);
            s.metallic = 0.0f;
            const estimate plain = measure_plate(s);
            s.metallic = 0.5f;
            const estimate half = measure_plate(s);
            estimate expected;
            for (int c = 0; c < 3; ++c) {
                expected.mean[c] = 0.5 * (whole.mean[c] + plain.mean[c]);
                expected.error[c] = 0.5 * hypot(whole.error[c], plain.error[c]);
            }
            assert_near_truth(&s, &half, &expected);
        }
}

/* With next to no n, F is 1 at every angle, and the compensated metal white. */
static void perfect_conductors_lose_nothing(void **state) {
    (void)state;
    const lobe_metal perfect = {
        .law = LOBE_METAL_CONDUCTOR, .n = {1e-3f, 1e-3f, 1e-3f}, .k = {100.0f, 100.0f, 100.0f}};
    for (int m = 1; m <= LOBE_MULTISCATTER_WALK; ++m) {
        const setting s = {.law = perfect,
                           .multiscatter = (lobe_multiscatter)m,
                           .metallic = 1.0f,
                           .roughness = 1.0f,
                           .cosine = 0.3f};
        const estimate e = measure_plate(s);
        for (int c = 0; c < 3; ++c)
            if (!(fabs(e.mean[c] - 1) < far * e.error[c] + 1e-3))
                fail_msg("%s: %g +- %g is not 1", modes[m], e.mean[c], e.error[c]);
    }
}

static void names_are_conductors(void **state) {
    (void)state;
    lobe_metal metal, kept = laws[1];
    size_t count = 0;
    for (; lobe_metal_name(count); ++count) {
        assert_true(lobe_metal_from_name(lobe_metal_name(count), &metal));
        assert_int_equal(metal.law, LOBE_METAL_CONDUCTOR);
        assert_true(lobe_metal_is_usable(&metal));
        const vec3 f0 = lobe_metal_prepare(&metal).f0;
        assert_true(f0.x > 0.4f && f0.x < 1.0f && f0.z > 0.4f && f0.z < 1.0f);
    }
    assert_int_equal(count, 8);
    assert_null(lobe_metal_name(SIZE_MAX));
    assert_false(lobe_metal_from_name("unobtainium", &kept));
    assert_memory_equal(&kept, &laws[1], sizeof kept);
}

/* Johnson & Christy's gold reflects 0.96 of red and 0.41 of blue: yellow; copper is redder. */
static void gold_and_copper_have_their_colours(void **state) {
    (void)state;
    lobe_metal gold, copper;
    assert_true(lobe_metal_from_name("gold", &gold) && lobe_metal_from_name("copper", &copper));
    const vec3 g = lobe_metal_prepare(&gold).f0, c = lobe_metal_prepare(&copper).f0;
    assert_true(fabsf(g.x - 0.957f) < 2e-3f && fabsf(g.y - 0.792f) < 2e-3f &&
                fabsf(g.z - 0.408f) < 2e-3f);
    assert_true(fabsf(c.x - 0.935f) < 2e-3f && fabsf(c.y - 0.624f) < 2e-3f &&
                fabsf(c.z - 0.538f) < 2e-3f);
}

static void bad_laws_are_refused(void **state) {
    (void)state;
    lobe_metal bad[7];
    for (int i = 0; i < 7; ++i) bad[i] = laws[i < 3 ? 1 : 2];
    bad[0].tint[1] = NAN;
    bad[1].tint[2] = 1.01f;
    bad[2].tint[0] = -0.01f;
    bad[3].n[0] = 0.0f;
    bad[4].k[2] = -1.0f;
    bad[5].k[1] = INFINITY;
    bad[6].law = (lobe_metal_law)3;
    lobe_scene *scene = load("furnace");
    for (int i = 0; i < 7; ++i) {
        lobe_render_options o = small(4, 4, 1);
        lobe_film *film;
        o.metal = bad[i];
        assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_BAD_INPUT);
        assert_null(film);
        assert_true(strncmp(lobe_render_error_message(), "metal: ", 7) == 0);
    }
    lobe_scene_free(scene);
}

int main(void) {
    static const char *const by_mode[] = {"albedo, one scattering", "albedo, kulla-conty",
                                          "albedo, turquin", "albedo, walk"};
    struct CMUnitTest tests[] = {
        {by_mode[0], metals_reflect_their_albedo, NULL, NULL, (void *)LOBE_MULTISCATTER_NONE},
        {by_mode[1], metals_reflect_their_albedo, NULL, NULL,
         (void *)LOBE_MULTISCATTER_KULLA_CONTY},
        {by_mode[2], metals_reflect_their_albedo, NULL, NULL, (void *)LOBE_MULTISCATTER_TURQUIN},
        {by_mode[3], metals_reflect_their_albedo, NULL, NULL, (void *)LOBE_MULTISCATTER_WALK},
        cmocka_unit_test(metals_of_beckmann_too),
        cmocka_unit_test(laws_are_told_apart),
        cmocka_unit_test(mirrors_reflect_the_law),
        cmocka_unit_test(half_metals_are_half_of_both),
        cmocka_unit_test(perfect_conductors_lose_nothing),
        cmocka_unit_test(names_are_conductors),
        cmocka_unit_test(gold_and_copper_have_their_colours),
        cmocka_unit_test(bad_laws_are_refused)};
    return cmocka_run_group_tests(tests, load_plate, free_plate);
}
