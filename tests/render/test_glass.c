/* tests/render/test_glass.c: glass in white light, plates in closed form, reciprocity, the three estimators. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"
#include "render/glass.h"
#include "solids.h"

#include <lobe/albedo.h>
#include <lobe/random.h>

#define GLASS(roughness, more)                                                                     \
    "{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":" roughness "},"          \
    "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}" more "}}"
/* the rest is white metal */
#define HALF_GLASS(roughness, more)                                                                \
    "{\"pbrMetallicRoughness\":{\"metallicFactor\":0.5,\"roughnessFactor\":" roughness "},"        \
    "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}" more "}}"
#define IOR(n) ",\"KHR_materials_ior\":{\"ior\":" n "}"
#define SOLID ",\"KHR_materials_volume\":{\"thicknessFactor\":1}"

static solid body; /* too large for the stack */

static lobe_scene *scene_of(const char *material, double distance, double angle) {
    solid_write(&body, material, distance, angle);
    return solid_load();
}

static lobe_render_options long_paths(uint32_t samples) {
    lobe_render_options o = small(16, 16, samples);
    o.depth = 256;
    o.roulette_depth = 256;
    return o;
}

/* Every block has the mean, up to 5 standard errors and `room`. */
static void assert_even(const lobe_scene *scene, lobe_render_options o, double mean, double room,
                        const char *what) {
    block_means m = measure(scene, o);
    for (int b = 0; b < BLOCKS * BLOCKS; ++b)
        if (!(fabs(m.mean[b] - mean) < 5 * m.error[b] + room))
            fail_msg("%s, block %d: %g +- %g is not %g", what, b, m.mean[b], m.error[b], mean);
}

/* The radiance of the whole picture under the light, and its standard error. */
static double mean_of(const lobe_scene *scene, lobe_render_options o, double *error) {
    block_means m = measure(scene, o);
    double sum = 0, squares = 0;
    for (int b = 0; b < BLOCKS * BLOCKS; ++b) {
        sum += m.mean[b];
        squares += m.error[b] * m.error[b];
    }
    *error = sqrt(squares) / (BLOCKS * BLOCKS);
    return sum / (BLOCKS * BLOCKS);
}

static void assert_mean(const char *material, double expected, double room) {
    lobe_scene *scene = scene_of(material, 200, 0.005);
    double error, mean = mean_of(scene, long_paths(24), &error);
    lobe_scene_free(scene);
    if (!(fabs(mean - expected) < 5 * error + room))
        fail_msg("%s: %.6f +- %.6f is not %.6f", material, mean, error, expected);
}

/* ---- White furnace --------------------------------------------------------------------------------- */

/* A smooth ball loses nothing, at any index; a rough one nothing but what the tables miss, where energy
 * is compensated. The rim, where triangles and normals disagree, is left out of sight. */
static void glass_ball_is_invisible(void **state) {
    (void)state;
    const struct {
        const char *name, *material;
        lobe_multiscatter multiscatter;
        double room;
    } balls[] = {
        {"smooth", GLASS("0", SOLID), LOBE_MULTISCATTER_NONE, 1e-4},
        {"smooth, 2.4", GLASS("0", SOLID IOR("2.4")), LOBE_MULTISCATTER_NONE, 1e-4},
        {"thin", GLASS("0", ""), LOBE_MULTISCATTER_NONE, 1e-4},
        {"thin, rough", GLASS("0.6", ""), LOBE_MULTISCATTER_TURQUIN, 2e-3},
        {"rough", GLASS("0.5", SOLID), LOBE_MULTISCATTER_TURQUIN, 5e-3},
        {"rough, 1.33", GLASS("0.7", SOLID IOR("1.33")), LOBE_MULTISCATTER_KULLA_CONTY, 5e-3},
        {"rough, walked", GLASS("0.7", SOLID), LOBE_MULTISCATTER_WALK, 1e-4},
        {"half of it, walked", HALF_GLASS("0.7", SOLID), LOBE_MULTISCATTER_WALK, 5e-3},
    };
    solid_light(0.5f, 0.5f);
    body.count = 0;
    solid_sphere(&body, 64);
    for (size_t k = 0; k < sizeof balls / sizeof *balls; ++k) {
        lobe_scene *scene = scene_of(balls[k].material, 100, 0.012);
        lobe_render_options o = long_paths(24);
        o.multiscatter = balls[k].multiscatter;
        assert_even(scene, o, 0.5, balls[k].room, balls[k].name);
        lobe_scene_free(scene);
    }
}

/* One boundary between two half spaces: the known loss of a single scattering, and from outside radiance
 * shrinks, from inside it grows. */
static void boundary_loses_what_quadrature_says(void **state) {
    (void)state;
    solid_light(0.5f, 0.5f);
    for (int side = 1; side >= -1; side -= 2) {
        body.count = 0;
        solid_screen(&body, 9, 0, side);
        lobe_dielectric_options options = lobe_dielectric_default_options();
        lobe_vec3_f64 wi = {0, 0, side};
        lobe_dielectric_f64 d = lobe_dielectric_prepare_f64(options, wi, 0.49, 0.49, 1.5);
        lobe_dielectric_albedo a = lobe_dielectric_integrate(&d, 262144);
        assert_mean(GLASS("0.7", SOLID), 0.5 * (a.reflected + a.transmitted), 1e-4);
    }
}

static void thin_wall_loses_what_a_metal_loses(void **state) {
    (void)state;
    solid_light(0.5f, 0.5f);
    body.count = 0;
    solid_screen(&body, 9, 0, 1);
    lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, 0.64, 0.64};
    double e = lobe_albedo(s, lobe_reflectance_one(), (lobe_vec3_f64){0, 0, 1}, LOBE_EFFORT_FINE);
    assert_mean(GLASS("0.8", ""), 0.5 * e, 1e-4);
}

/* ---- Plates ---------------------------------------------------------------------------------------- */

/* Two faces of reflectance F with the share t left by absorption between them, all orders: what comes
 * through is (1 - F)^2 t/(1 - F^2 t^2), what returns F + (1 - F)^2 t^2 F/(1 - F^2 t^2). */
static void plates_are_as_in_closed_form(void **state) {
    (void)state;
    body.count = 0;
    solid_plate(&body, 40, 0.5f);
    const double f = 1.0 / 9, t = 0.25; /* index 2; half of it over a quarter */
    const double all = 1 - f * f * t * t, clear = 1 - f * f;
    solid_light(0, 1);
    assert_mean(GLASS("0", SOLID IOR("2")), (1 - f) * (1 - f) / clear, 1e-4);
    const char absorbing[] =
        GLASS("0", IOR("2") ",\"KHR_materials_volume\":{\"thicknessFactor\":0.1,"
                            "\"attenuationDistance\":0.25,"
                            "\"attenuationColor\":[0.5,0.5,0.5]}");
    assert_mean(absorbing, (1 - f) * (1 - f) * t / all, 1e-4);
    solid_light(1, 0);
    assert_mean(absorbing, f + (1 - f) * (1 - f) * t * t * f / all, 1e-4);
    /* thin: one sheet with all orders in it */
    body.count = 0;
    solid_screen(&body, 40, 0, 1);
    assert_mean(GLASS("0", IOR("2")), 2 * f / (1 + f), 1e-4);
    solid_light(0, 1);
    assert_mean(GLASS("0", IOR("2")), (1 - f) / (1 + f), 1e-4);
}

/* The base colour tints what is transmitted, once a face. */
static void base_color_tints(void **state) {
    (void)state;
    const char grey[] =
        "{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0,"
        "\"baseColorFactor\":[0.25,0.25,0.25,1]},\"extensions\":{"
        "\"KHR_materials_transmission\":{\"transmissionFactor\":1}" SOLID IOR("1") "}}";
    body.count = 0;
    solid_plate(&body, 40, 0.5f);
    solid_light(0, 1);
    assert_mean(grey, 0.0625, 1e-5);
}

/* A coat of another index: white matter below it loses nothing, and a black one shows F. */
static void coats_have_their_index(void **state) {
    (void)state;
    body.count = 0;
    solid_screen(&body, 9, 0, 1);
    solid_light(0.5f, 0.5f);
#define COATED(color, roughness, n)                                                                \
    "{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[" color "],"             \
    "\"roughnessFactor\":" roughness "},\"extensions\":{\"KHR_materials_ior\":{\"ior\":" n "}}}"
    assert_mean(COATED("1,1,1,1", "0.4", "1.2"), 0.5, 2e-3);
    assert_mean(COATED("1,1,1,1", "0.4", "2.4"), 0.5, 2e-3);
    assert_mean(COATED("0,0,0,1", "0", "3"), 0.5 * 0.25, 1e-3);
    assert_mean(COATED("0,0,0,1", "0", "1"), 0, 1e-5);
}

/* Half glass, half white matter of the same coat: in white light nothing is lost. */
static void shares_add_up(void **state) {
    (void)state;
    const char half[] =
        "{\"pbrMetallicRoughness\":{\"metallicFactor\":0.25,\"roughnessFactor\":0},"
        "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":0.5}}}";
    body.count = 0;
    solid_screen(&body, 40, 0, 1);
    solid_light(0.5f, 0.5f);
    assert_mean(half, 0.5, 1e-3);
    /* three eighths are a thin wall, the rest is opaque */
    const double f = 0.04;
    solid_light(0, 1);
    assert_mean(half, 0.375 * (1 - f) / (1 + f), 1e-4);
}

/* Equal indices are no surface, however rough; nor is the plate's shadow one. */
static void matched_plate_is_invisible(void **state) {
    (void)state;
    body.count = 0;
    solid_plate(&body, 40, 0.5f);
    solid_light(0.2f, 0.7f);
    assert_mean(GLASS("0.7", SOLID IOR("1")), 0.7, 1e-5);
    assert_mean(GLASS("0", SOLID IOR("1")), 0.7, 1e-5);
}

/* ---- Reciprocity and estimators ------------------------------------------------------------------------ */

static vec3 random_direction(uint64_t k, int word) {
    lobe_random4 r = lobe_random(11, 0, k);
    float z = 2.0f * lobe_random_unit_f32(r.word[word]) - 1.0f;
    float turn = 2.0f * LOBE_PI * lobe_random_unit_f32(r.word[word + 1]);
    float plane = sqrtf(1.0f - z * z);
    return v3(plane * cosf(turn), plane * sinf(turn), z);
}

/* As the integrator has it: everything turned toward the viewer. */
static glass glass_toward(glass_material m, vec3 normal, vec3 viewer) {
    glass_options o = {lobe_reflection_default_options(), 0, 0, 0};
    int is_back = v3_dot(viewer, normal) < 0.0f;
    vec3 z = is_back ? v3_neg(normal) : normal;
    return lobe_glass_at(&o, m, frame_of(z, v3(1.0f, 0.0f, 0.0f)), z, viewer, is_back);
}

/* f(i,o)/n_i^2 = f(o,i)/n_o^2 for radiance, and the same for thin walls, whose sides are both air. */
static void values_are_reciprocal(void **state) {
    (void)state;
    vec3 normal = v3_normalize_or(v3(0.3f, -0.5f, 0.4f), v3_all(0.0f));
    int crossed = 0;
    for (uint64_t k = 0; k < 4000; ++k) {
        glass_material m = {1.0f, 1.5f, (int)(k & 1), v3_all(1.0f), 0.5f, 0.3f};
        vec3 i = random_direction(k, 0), o = random_direction(k, 2);
        float cos_i = v3_dot(i, normal), cos_o = v3_dot(o, normal), pdf;
        glass there = glass_toward(m, normal, i), back = glass_toward(m, normal, o);
        float f = lobe_glass_value(&there, o, &pdf).x / fabsf(cos_o);
        float g = lobe_glass_value(&back, i, &pdf).x / fabsf(cos_i);
        float n_i = m.is_thin || cos_i > 0.0f ? 1.0f : 1.5f;
        float n_o = m.is_thin || cos_o > 0.0f ? 1.0f : 1.5f;
        f /= n_i * n_i;
        g /= n_o * n_o;
        crossed += cos_i * cos_o < 0.0f && f > 0.0f;
        if (!(fabsf(f - g) <= 2e-3f * fmaxf(f, g) + 1e-5f))
            fail_msg("%d: %g there, %g back", (int)k, (double)f, (double)g);
    }
    assert_true(crossed > 500);
}

/* A draw is where the value says, with its density, and its weight is the value over it. */
static void draws_have_their_density(void **state) {
    (void)state;
    vec3 normal = v3(0.0f, 0.0f, 1.0f);
    for (uint64_t k = 0; k < 2000; ++k) {
        glass_material m = {1.0f, 1.5f, (int)(k & 1), v3(0.5f, 0.5f, 0.5f), 0.5f, 0.3f};
        glass g = glass_toward(m, normal, random_direction(k, 0));
        lobe_random4 r = lobe_random(12, 0, k);
        float u[3], pdf;
        for (int w = 0; w < 3; ++w) u[w] = lobe_random_unit_f32(r.word[w]);
        glass_draw d = lobe_glass_draw(&g, u[0], u[1], 0.5f, u[2]);
        if (!(d.pdf > 0.0f)) continue;
        float value = lobe_glass_value(&g, d.direction, &pdf).x;
        if (!(fabsf(pdf - d.pdf) <= 1e-2f * d.pdf) ||
            !(fabsf(value - d.weight.x * d.pdf) <= 1e-2f * value))
            fail_msg("%d: pdf %g, drawn %g; value %g, drawn %g", (int)k, (double)pdf, (double)d.pdf,
                     (double)value, (double)(d.weight.x * d.pdf));
    }
}

/* A lamp before and behind rough plates: met by paths, drawn, or both. */
static void estimators_agree_on(lobe_multiscatter multiscatter, uint64_t first_seed) {
    body.count = 0;
    solid_plate(&body, 2, 0.5f);
    /* a bright patch of sky beyond, a dim one on this side */
    solid_light(0.1f, 1);
    lobe_scene *scene = scene_of(GLASS("0.6", SOLID), 6, 0.5);
    lobe_render_options o = small(32, 32, 48);
    o.depth = 4;
    o.multiscatter = multiscatter;
    const lobe_heuristic others[] = {LOBE_HEURISTIC_POWER, LOBE_HEURISTIC_BSDF_ONLY,
                                     LOBE_HEURISTIC_LIGHT_ONLY};
    assert_estimators_agree(scene, o, others, 3, first_seed);
    lobe_scene_free(scene);
}

static void estimators_agree(void **state) {
    (void)state;
    estimators_agree_on(LOBE_MULTISCATTER_NONE, 5);
}

static void estimators_agree_on_walks(void **state) {
    (void)state;
    estimators_agree_on(LOBE_MULTISCATTER_WALK, 25);
}

static int remove_files(void **state) {
    (void)state;
    solid_remove();
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glass_ball_is_invisible),
        cmocka_unit_test(boundary_loses_what_quadrature_says),
        cmocka_unit_test(thin_wall_loses_what_a_metal_loses),
        cmocka_unit_test(plates_are_as_in_closed_form),
        cmocka_unit_test(base_color_tints),
        cmocka_unit_test(coats_have_their_index),
        cmocka_unit_test(shares_add_up),
        cmocka_unit_test(matched_plate_is_invisible),
        cmocka_unit_test(values_are_reciprocal),
        cmocka_unit_test(draws_have_their_density),
        cmocka_unit_test(estimators_agree),
        cmocka_unit_test(estimators_agree_on_walks),
    };
    return cmocka_run_group_tests(tests, NULL, remove_files);
}
