/* tests/render/test_lights.c: the alias table draws what it is given; the environment draws in
 * proportion to its brightness and lies where the convention says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <lobe/random.h>

#include "render/circle.h"
#include "render/environment.h"

static void alias_table_draws_its_weights(void **state) {
    (void)state;
    enum { CELLS = 97, DRAWS = 1000000 };
    double weights[CELLS], sum = 0, chi2 = 0;
    int counts[CELLS] = {0};
    for (int i = 0; i < CELLS; ++i) sum += weights[i] = i % 7 == 0 ? 0 : 1 + (i * i) % 31;
    alias_table table;
    assert_true(lobe_alias_create(&table, weights, CELLS));
    for (uint64_t k = 0; k < DRAWS; ++k) {
        lobe_random4 r = lobe_random(11, 0, k);
        ++counts[alias_draw(&table, r.word[0])];
    }
    int bins = 0;
    for (int i = 0; i < CELLS; ++i) {
        double expected = DRAWS * weights[i] / sum;
        if (expected == 0) {
            assert_int_equal(counts[i], 0);
            continue;
        }
        ++bins;
        chi2 += (counts[i] - expected) * (counts[i] - expected) / expected;
    }
    /* chi^2 is near normal at this many bins: 4 standard deviations */
    assert_true(fabs(chi2 - (bins - 1)) < 4 * sqrt(2.0 * (bins - 1)));
    lobe_alias_free(&table);
}

/* One bright texel at the direction +Z, a quarter turn from the centre (+X): u = 3/4. */
static void environment_lies_where_it_should(void **state) {
    (void)state;
    image picture;
    assert_true(lobe_image_create(&picture, 64, 32));
    for (int i = 0; i < 64 * 32; ++i) picture.pixels[i] = v3_all(0.01f);
    picture.pixels[16 * 64 + 48] = v3_all(1000.0f);
    environment e;
    assert_true(lobe_environment_create(&e, picture, 0.0f));
    assert_true(lobe_environment_at(&e, v3_normalize_or(v3(-0.01f, -0.01f, 1), v3_all(1))).x >
                1.0f);
    int hits = 0;
    for (uint64_t k = 0; k < 1000; ++k) {
        lobe_random4 r = lobe_random(1, 2, k);
        const sky_draw draw = lobe_environment_draw(&e, r.word);
        const vec3 d = draw.direction;
        float pdf;
        const vec3 light = lobe_environment_meet(&e, d, &pdf);
        assert_true(fabsf(pdf / draw.pdf - 1.0f) < 0.05f);
        assert_true(pdf == lobe_environment_pdf(&e, d));
        assert_true(light.x == lobe_environment_at(&e, d).x);
        assert_true(fabsf(light.x - draw.radiance.x) < 0.01f);
        /* the bright texel and those it is interpolated with: within two texels, 0.2 radians */
        hits += d.z > 0.95f;
    }
    assert_true(hits > 900);
    /* its centre is as bright as it is, half a texel aside it is the mean with the next one */
    const float step = 3.14159265f / 32;
    for (int halves = 0; halves < 2; ++halves) {
        float azimuth = (48.5f + 0.5f * (float)halves) * step - 3.14159265f, polar = 16.5f * step;
        vec3 d = {sinf(polar) * cosf(azimuth), cosf(polar), sinf(polar) * sinf(azimuth)};
        float expected = halves ? 0.5f * (1000.0f + 0.01f) : 1000.0f;
        assert_true(fabsf(lobe_environment_at(&e, d).x / expected - 1.0f) < 1e-3f);
    }
    lobe_environment_free(&e);
}

/* Density of the draws integrates to one over the sphere. */
static void environment_density_integrates_to_one(void **state) {
    (void)state;
    image picture;
    assert_true(lobe_environment_sky(&picture));
    environment e;
    assert_true(lobe_environment_create(&e, picture, 30.0f));
    double sum = 0;
    const int rows = 1024;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < 2 * rows; ++x) {
            double polar = 3.14159265358979 * (y + 0.5) / rows;
            double azimuth = 3.14159265358979 * (x + 0.5) / rows;
            vec3 d = {(float)(sin(polar) * cos(azimuth)), (float)cos(polar),
                      (float)(sin(polar) * sin(azimuth))};
            sum += (double)lobe_environment_pdf(&e, d) * sin(polar);
        }
    double cell = 3.14159265358979 / rows;
    assert_true(fabs(sum * cell * cell - 1) < 2e-3);
    lobe_environment_free(&e);
}

/* Against libm in double, on points all around, and the axes exactly. */
static void angles_are_right(void **state) {
    (void)state;
    const double turn = 6.283185307179586;
    double worst = 0, worst_turns = 0;
    for (int i = -200000; i <= 200000; ++i) {
        const float turns = (float)i / 200000.0f;
        float sine, cosine;
        circle_at(turns, &sine, &cosine);
        worst = fmax(worst, fabs((double)sine - sin(turn * (double)turns)));
        worst = fmax(worst, fabs((double)cosine - cos(turn * (double)turns)));
        const double error =
            (double)circle_turns(sine, cosine) - atan2((double)sine, (double)cosine) / turn;
        /* half a turn is the same both ways */
        worst_turns = fmax(worst_turns, fabs(error - round(error)));
    }
    assert_true(worst < 1.1e-7);
    assert_true(worst_turns < 5e-8);
    assert_true(circle_turns(0, 1) == 0 && circle_turns(1, 0) == 0.25f);
    assert_true(circle_turns(0, -1) == 0.5f && circle_turns(-1, 0) == -0.25f);
    assert_true(circle_turns(0, 0) == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(angles_are_right),
                                       cmocka_unit_test(alias_table_draws_its_weights),
                                       cmocka_unit_test(environment_lies_where_it_should),
                                       cmocka_unit_test(environment_density_integrates_to_one)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
