/* tests/render/test_box.c: inside a closed box that glows, light adds up to what the albedo of its
 * walls says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include "render/integrator.h"

#include <stdio.h>
#include <unistd.h>

static lobe_scene *box;

static int load_box(void **state) {
    (void)state;
    FILE *file = fopen("render-box.obj", "wb");
    assert_non_null(file);
    /* a corner for every wall that meets there: normals are not smoothed */
    for (int wall = 0; wall < 6; ++wall) {
        const int around[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        for (int k = 0; k < 4; ++k) {
            int place[3], side = wall % 2 ? 1 : -1;
            place[wall / 2] = side;
            place[(wall / 2 + 1) % 3] = around[k][0] * side; /* counter-clockwise from outside */
            place[(wall / 2 + 2) % 3] = around[k][1];
            fprintf(file, "v %d %d %d\n", place[0], place[1], place[2]);
        }
    }
    for (int wall = 0; wall < 6; ++wall)
        fprintf(file, "vn %d %d %d\n", (wall / 2 == 0) * (wall % 2 * 2 - 1),
                (wall / 2 == 1) * (wall % 2 * 2 - 1), (wall / 2 == 2) * (wall % 2 * 2 - 1));
    for (int wall = 0; wall < 6; ++wall) {
        fputs("f", file);
        for (int k = 1; k <= 4; ++k) fprintf(file, " %d//%d", 4 * wall + k, wall + 1);
        fputs("\n", file);
    }
    fclose(file);
    box = load("render-box.obj");
    unlink("render-box.obj");
    assert_true(box->triangle_count == 12);
    return 0;
}

static int free_box(void **state) {
    (void)state;
    lobe_scene_free(box);
    return 0;
}

typedef struct estimate {
    double mean, error; /* standard error */
} estimate;

enum { SAMPLES = 1024, RUNS = 8 };

static lobe_multiscatter compensation = LOBE_MULTISCATTER_NONE;

/* Radiance near the middle of the wall at x = 1, walls of material `m` that glow with 1, after `depth`
 * scatterings; the mean of independent runs. */
static estimate radiance(material m, vec3 direction, int depth, int samples) {
    m.base_map = m.normal_map = m.emission_map = lobe_texture_map(NO_TEXTURE);
    m.roughness_map = m.metallic_map = lobe_texture_map(NO_TEXTURE);
    m.specular_map = m.specular_color_map = lobe_texture_map(NO_TEXTURE);
    m.specular = 1.0f;
    m.specular_color = v3_all(1.0f);
    m.emission = v3_all(1.0f);
    lobe_material_settle(&m);
    for (uint32_t i = 0; i < box->material_count; ++i) box->materials[i] = m;
    lobe_reflection_options reflection = lobe_reflection_default_options();
    const coat_table *coat = lobe_coat_table(reflection.model.ndf, reflection.model.masking,
                                             reflection.g2, COAT_IOR, m.anisotropy != 0.0f);
    const coat_table *coats[64];
    assert_true(box->material_count < 64);
    for (uint32_t i = 0; i <= box->material_count; ++i) coats[i] = coat;
    integrator k = {.scene = box,
                    .surface = {.ggx = reflection, .coat = coat, .multiscatter = compensation},
                    .coats = coats,
                    .heuristic = LOBE_HEURISTIC_BALANCE,
                    .depth = depth,
                    .roulette_depth = depth + 1};
    double sum = 0, squares = 0;
    for (int run = 0; run < RUNS; ++run) {
        double total = 0;
        for (int i = 0; i < samples; ++i) {
            sampler points = {.key = lobe_sampler_key((uint64_t)run, 0, 0),
                              .index = (uint32_t)i,
                              .index_bits = lobe_sampler_index_bits((uint32_t)samples)};
            uint64_t rays = 0;
            total += (double)lobe_trace_path(&k, v3(0.97f, 0.05f, 0.02f), direction, &points, &rays)
                         .radiance.y;
        }
        total /= samples;
        sum += total / RUNS;
        squares += total * total / RUNS;
    }
    return (estimate){sum, sqrt(fmax(squares - sum * sum, 0) / (RUNS - 1))};
}

/* Toward the wall at x = 1, `cosine` from its normal. */
static vec3 toward_wall(float cosine) {
    float plane = sqrtf(1.0f - cosine * cosine);
    return v3(cosine, 0.6f * plane, 0.8f * plane);
}

/* Along a diagonal every wall is met at the same angle: a mirror of one albedo F there. Then the light
 * is the geometric series of F, 1/(1 - F) in the end. */
static void mirrors_add_up_to_the_series(void **state) {
    (void)state;
    const float third = sqrtf(1.0f / 3.0f);
    const float reflectances[] = {0.1f, 0.5f, 0.9f};
    for (int k = 0; k < 3; ++k) {
        material m = {.base_color = v3_all(reflectances[k]), .metallic = 1.0f};
        double f = (double)lobe_fresnel_schlick_f32(reflectances[k], third);
        double last = radiance(m, v3_all(third), 200, 1).mean;
        if (!(fabs(last * (1 - f) - 1) < 1e-4)) fail_msg("F = %g: %g is not 1/(1 - F)", f, last);
        double third_depth = radiance(m, v3_all(third), 3, 1).mean;
        assert_true(fabs(third_depth - (1 + f + f * f + f * f * f)) < 1e-4);
    }
}

/* White walls reflect all light: every scattering adds the same. */
static void white_walls_lose_nothing(void **state) {
    (void)state;
    const float roughnesses[] = {0.0f, 0.1f, 0.3f, 0.6f, 1.0f};
    const float anisotropies[] = {0.0f, 0.3f, 0.9f};
    enum { DEPTH = 8 };
    for (int r = 0; r < 5; ++r)
        for (int a = 0; a < 3; ++a) {
            material m = {.base_color = v3_all(1.0f),
                          .roughness = roughnesses[r],
                          .anisotropy = anisotropies[a]};
            estimate e = radiance(m, toward_wall(0.5f), DEPTH, SAMPLES / 4);
            double expected = DEPTH + 1, room = 5 * e.error;
            /* all of a scattering, within the bounds of test_coat.c over all directions */
            if (!(e.mean < expected * 1.001 + room && e.mean > expected * 0.985 - room))
                fail_msg("roughness %g, anisotropy %g: %g +- %g is not %g", (double)roughnesses[r],
                         (double)anisotropies[a], e.mean, e.error, expected);
        }
}

/* Metal of F = 1: the first scattering adds the albedo of the microsurface, the second what it makes of
 * the albedo toward the next wall: never more. */
static void metal_walls_add_their_albedo(void **state) {
    (void)state;
    const float roughnesses[] = {0.2f, 0.5f, 1.0f}, cosines[] = {0.1f, 0.5f, 0.95f};
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
            float roughness = roughnesses[r], alpha = roughness * roughness;
            material m = {.base_color = v3_all(1.0f), .metallic = 1.0f, .roughness = roughness};
            lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED,
                                   (double)alpha, (double)alpha};
            double mu = (double)cosines[c];
            lobe_vec3_f64 wi = {sqrt(1 - mu * mu), 0, mu};
            double albedo = lobe_albedo(s, lobe_reflectance_one(), wi, LOBE_EFFORT_MEDIUM);
            estimate once = radiance(m, toward_wall(cosines[c]), 1, SAMPLES);
            if (!(fabs(once.mean - 1 - albedo) < 5 * once.error + 2e-4))
                fail_msg("roughness %g, cosine %g: %g +- %g is not 1 + %g", (double)roughness, mu,
                         once.mean, once.error, albedo);
            estimate more = radiance(m, toward_wall(cosines[c]), 4, SAMPLES / 4);
            assert_true(more.mean < 1 + 4 * albedo + 5 * more.error + 1e-3);
        }
}

/* Compensated metal of F = 1 is white: every scattering adds the same. Turquin's factor is exact at one
 * surface only in the direction of the viewer, Kulla & Conty's lobe too: both at every one. Walks are. */
static void compensated_metal_loses_nothing(void **state) {
    (void)state;
    enum { DEPTH = 4 };
    const float roughnesses[] = {0.1f, 0.4f, 0.7f, 1.0f}, anisotropies[] = {0.0f, 0.5f};
    for (int c = 1; c <= LOBE_MULTISCATTER_WALK; ++c)
        for (int r = 0; r < 4; ++r)
            for (int a = 0; a < 2; ++a) {
                material m = {.base_color = v3_all(1.0f),
                              .metallic = 1.0f,
                              .roughness = roughnesses[r],
                              .anisotropy = anisotropies[a]};
                compensation = (lobe_multiscatter)c;
                estimate e = radiance(m, toward_wall(0.4f), DEPTH, SAMPLES / 2);
                compensation = LOBE_MULTISCATTER_NONE;
                double room = 5 * e.error + (anisotropies[a] > 0 ? 4e-3 : 1e-3) * DEPTH;
                if (!(fabs(e.mean - (DEPTH + 1)) < room))
                    fail_msg("compensation %d, roughness %g, anisotropy %g: %g +- %g is not %d", c,
                             (double)roughnesses[r], (double)anisotropies[a], e.mean, e.error,
                             DEPTH + 1);
            }
}

/* Coloured metal that walks adds at first what the walks of the library reflect; half metal, half of that and
 * half of what the rest adds. */
static void walks_add_their_albedo(void **state) {
    (void)state;
    enum { WALKS = 20000 };
    const float cosines[] = {0.1f, 0.6f};
    for (int c = 0; c < 2; ++c) {
        const lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, 0.64,
                                     0.64};
        const lobe_reflectance f = {LOBE_REFLECTANCE_SCHLICK, 0.5, 0};
        const double mu = (double)cosines[c];
        double walked = 0, squares = 0;
        for (uint64_t k = 0; k < WALKS; ++k) {
            double weight;
            lobe_walk_sample(s, &f, 1, (lobe_vec3_f64){sqrt(1 - mu * mu), 0, mu}, 1, k, 10000,
                             &weight);
            walked += weight / WALKS;
            squares += weight * weight / WALKS;
        }
        const double spread = sqrt((squares - walked * walked) / WALKS);
        material m = {.base_color = v3_all(0.5f), .roughness = 0.8f};
        const estimate plain = radiance(m, toward_wall(cosines[c]), 1, SAMPLES);
        compensation = LOBE_MULTISCATTER_WALK;
        m.metallic = 1.0f;
        const estimate whole = radiance(m, toward_wall(cosines[c]), 1, SAMPLES);
        m.metallic = 0.5f;
        const estimate half = radiance(m, toward_wall(cosines[c]), 1, SAMPLES);
        compensation = LOBE_MULTISCATTER_NONE;
        if (!(fabs(whole.mean - 1 - walked) < 5 * hypot(whole.error, spread) + 1e-4))
            fail_msg("cosine %g: %g +- %g is not 1 + %g", mu, whole.mean, whole.error, walked);
        const double room = hypot(hypot(half.error, plain.error), spread);
        const double expected = 0.5 * (1 + walked) + 0.5 * plain.mean;
        if (!(fabs(half.mean - expected) < 5 * room + 1e-3))
            fail_msg("cosine %g, half metal: %g +- %g is not %g", mu, half.mean, room, expected);
    }
}

/* A base of any colour: what the coat reflects, and the base's share of what it lets through. */
static void coloured_walls_add_both_parts(void **state) {
    (void)state;
    const float cosines[] = {0.1f, 0.5f, 0.95f};
    for (int c = 0; c < 3; ++c) {
        material m = {.base_color = v3_all(0.3f), .roughness = 0.4f};
        lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, 0.16, 0.16};
        lobe_reflectance f = {LOBE_REFLECTANCE_DIELECTRIC, (double)COAT_IOR, 0};
        double mu = (double)cosines[c];
        lobe_vec3_f64 wi = {sqrt(1 - mu * mu), 0, mu};
        double coat = lobe_albedo(s, f, wi, LOBE_EFFORT_MEDIUM);
        estimate once = radiance(m, toward_wall(cosines[c]), 1, SAMPLES);
        double expected = 1 + coat + 0.3 * (1 - coat);
        if (!(fabs(once.mean - expected) < 5 * once.error + 2e-3))
            fail_msg("cosine %g: %g +- %g is not %g", mu, once.mean, once.error, expected);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(mirrors_add_up_to_the_series),
                                       cmocka_unit_test(white_walls_lose_nothing),
                                       cmocka_unit_test(metal_walls_add_their_albedo),
                                       cmocka_unit_test(compensated_metal_loses_nothing),
                                       cmocka_unit_test(walks_add_their_albedo),
                                       cmocka_unit_test(coloured_walls_add_both_parts)};
    return cmocka_run_group_tests(tests, load_box, free_box);
}
