/* tests/lib/test_walk.c: random walks lose no light, begin as the model of one scattering does, and are
 * reciprocal. Fixed seeds; 5 standard errors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <lobe/lobe.h>

#include <math.h>

enum { WALKS = 30000, MOST = 10000 };

static const lobe_reflectance laws[] = {{LOBE_REFLECTANCE_ONE, 0, 0},
                                        {LOBE_REFLECTANCE_SCHLICK, 0.4, 0}};

static lobe_microsurface surface(double alpha_x, double alpha_y) {
    lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, alpha_x, alpha_y};
    return s;
}

static lobe_vec3_f64 toward(double mu, double azimuth) {
    double plane = sqrt(1 - mu * mu);
    lobe_vec3_f64 w = {plane * cos(azimuth), plane * sin(azimuth), mu};
    return w;
}

static const double alphas[][2] = {{0.05, 0.05}, {0.5, 0.1}, {1, 1}, {3, 3}};
static const double cosines[] = {0.01, 0.4, 1};

static void white_walks_lose_nothing(void **state) {
    (void)state;
    for (int a = 0; a < 4; ++a)
        for (int c = 0; c < 3; ++c)
            for (uint64_t k = 0; k < WALKS / 10; ++k) {
                double weights[2];
                lobe_walk w = lobe_walk_sample(surface(alphas[a][0], alphas[a][1]), laws, 2,
                                               toward(cosines[c], 0.4), 5, k, MOST, weights);
                assert_true(weights[0] == 1 && weights[1] > 0 && weights[1] <= 1);
                assert_true(w.bounces >= 1 && w.wo.z > 0);
                double length = w.wo.x * w.wo.x + w.wo.y * w.wo.y + w.wo.z * w.wo.z;
                assert_true(fabs(length - 1) < 1e-12);
            }
}

/* Walks of one bounce: their share is E, their weights are E with F, and a moment of their directions
 * is that of lobe/reflection.h. */
static void one_bounce_is_one_scattering(void **state) {
    (void)state;
    for (int a = 0; a < 3; ++a)
        for (int c = 0; c < 3; ++c) {
            lobe_microsurface s = surface(alphas[a][0], alphas[a][1]);
            lobe_vec3_f64 wi = toward(cosines[c], 0.4);
            lobe_reflection_f64 model = lobe_reflection_prepare_f64(
                lobe_reflection_default_options(), wi, s.alpha_x, s.alpha_y);
            double share = 0, colour = 0, moment = 0, drawn = 0;
            for (uint64_t k = 0; k < WALKS; ++k) {
                double weights[2];
                lobe_walk w = lobe_walk_sample(s, laws, 2, wi, 6, k, MOST, weights);
                if (w.bounces == 1) {
                    share += 1.0 / WALKS;
                    colour += weights[1] / WALKS;
                    moment += w.wo.x / WALKS;
                }
                lobe_random4 r = lobe_random(7, 0, k);
                lobe_reflection_draw_f64 d =
                    lobe_reflection_sample_f64(&model, lobe_random_unit_f64(r.word[0], r.word[1]),
                                               lobe_random_unit_f64(r.word[2], r.word[3]), 0);
                drawn += d.weight * d.wo.x / WALKS;
            }
            double room = 5 * sqrt(0.25 / WALKS);
            assert_true(fabs(share - lobe_albedo(s, laws[0], wi, LOBE_EFFORT_MEDIUM)) < room);
            assert_true(fabs(colour - lobe_albedo(s, laws[1], wi, LOBE_EFFORT_MEDIUM)) < room);
            assert_true(fabs(moment - drawn) < 5 * sqrt(2.0 / WALKS));
        }
}

/* Light that arrives by the cosine and is weighed by one function on its way in and by another on its
 * way out: the same with the two exchanged. Walks of two bounces and more only. */
static void walks_are_reciprocal(void **state) {
    (void)state;
    lobe_microsurface s = surface(1, 0.4);
    double sum = 0, squares = 0;
    for (uint64_t k = 0; k < 4 * WALKS; ++k) {
        lobe_random4 r = lobe_random(8, 0, k);
        double mu = sqrt(fmax(lobe_random_unit_f64(r.word[0], r.word[1]), 1e-12));
        lobe_vec3_f64 wi =
            toward(mu, 6.283185307179586 * lobe_random_unit_f64(r.word[2], r.word[3]));
        double weights[2];
        lobe_walk w = lobe_walk_sample(s, laws, 2, wi, 9, k, MOST, weights);
        /* antisymmetric under the exchange of wi and wo, even in the azimuth */
        double difference = w.wo.z - wi.z + w.wo.x * w.wo.x - wi.x * wi.x;
        double value = w.bounces > 1 ? weights[1] * difference : 0;
        sum += value;
        squares += value * value;
    }
    assert_true(fabs(sum) < 5 * sqrt(squares));
}

static void walks_are_cut_and_refused(void **state) {
    (void)state;
    lobe_microsurface s = surface(1, 1);
    int cut = 0;
    for (uint64_t k = 0; k < 1000; ++k) {
        double weight = 7;
        lobe_walk w = lobe_walk_sample(s, laws, 1, toward(0.5, 0), 1, k, 1, &weight);
        assert_true((w.bounces == 0 && weight == 0) || (w.bounces == 1 && weight == 1));
        cut += w.bounces == 0;
    }
    assert_true(cut > 200 && cut < 800);
    const lobe_vec3_f64 bad[] = {{0, 0, -1}, {1, 0, 0}, {0, 0, 0}, {NAN, 0, 1}};
    for (int k = 0; k < 4; ++k) {
        double weight = 7;
        assert_int_equal(lobe_walk_sample(s, laws, 1, bad[k], 1, 0, 10, &weight).bounces, 0);
        assert_true(weight == 0);
    }
    double weight = 7;
    assert_int_equal(
        lobe_walk_sample(surface(NAN, 1), laws, 1, toward(0.5, 0), 1, 0, 10, &weight).bounces, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_walks_lose_nothing), cmocka_unit_test(one_bounce_is_one_scattering),
        cmocka_unit_test(walks_are_reciprocal), cmocka_unit_test(walks_are_cut_and_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
