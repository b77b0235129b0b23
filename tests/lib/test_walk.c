/* tests/lib/test_walk.c: random walks lose no light, begin as the model of one scattering does, are
 * reciprocal, and are what their estimated values add up to, on conductors and dielectrics. Fixed seeds; 5
 * standard errors. */
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

static lobe_microsurface surface_of(int ndf, double alpha_x, double alpha_y) {
    lobe_microsurface s = {(lobe_ndf)ndf, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, alpha_x, alpha_y};
    return s;
}

static lobe_microsurface surface(double alpha_x, double alpha_y) {
    return surface_of(LOBE_NDF_GGX, alpha_x, alpha_y);
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
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ++ndf)
        for (int a = 0; a < 4; ++a)
            for (int c = 0; c < 3; ++c)
                for (uint64_t k = 0; k < WALKS / 10; ++k) {
                    double weights[2];
                    lobe_walk w =
                        lobe_walk_sample(surface_of(ndf, alphas[a][0], alphas[a][1]), laws, 2,
                                         toward(cosines[c], 0.4), 5, k, MOST, weights);
                    assert_true(weights[0] == 1 && weights[1] > 0 && weights[1] <= 1);
                    assert_true(w.bounces >= 1 && w.wo.z > 0);
                    double length = w.wo.x * w.wo.x + w.wo.y * w.wo.y + w.wo.z * w.wo.z;
                    assert_true(fabs(length - 1) < 1e-12);
                }
}

/* Walks of one bounce: their share is E, their weights are E with F, */
static void first_is_once(lobe_microsurface s, lobe_vec3_f64 wi) {
    double share = 0, colour = 0, room = 5 * sqrt(0.25 / WALKS);
    for (uint64_t k = 0; k < WALKS; ++k) {
        double weights[2];
        if (lobe_walk_sample(s, laws, 2, wi, 6, k, MOST, weights).bounces != 1) continue;
        share += 1.0 / WALKS;
        colour += weights[1] / WALKS;
    }
    assert_true(fabs(share - lobe_albedo(s, laws[0], wi, LOBE_EFFORT_MEDIUM)) < room);
    assert_true(fabs(colour - lobe_albedo(s, laws[1], wi, LOBE_EFFORT_MEDIUM)) < room);
}

/* and a moment of their directions is that of lobe/reflection.h. */
static void one_bounce_is_one_scattering(void **state) {
    (void)state;
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ++ndf)
        for (int a = 0; a < 3; ++a)
            for (int c = 0; c < 3; ++c)
                first_is_once(surface_of(ndf, alphas[a][0], alphas[a][1]), toward(cosines[c], 0.4));
    for (int a = 0; a < 3; ++a)
        for (int c = 0; c < 3; ++c) {
            lobe_microsurface s = surface(alphas[a][0], alphas[a][1]);
            lobe_vec3_f64 wi = toward(cosines[c], 0.4);
            lobe_reflection_f64 model = lobe_reflection_prepare_f64(
                lobe_reflection_default_options(), wi, s.alpha_x, s.alpha_y);
            double moment = 0, drawn = 0;
            for (uint64_t k = 0; k < WALKS; ++k) {
                double weights[2];
                lobe_walk w = lobe_walk_sample(s, laws, 2, wi, 6, k, MOST, weights);
                if (w.bounces == 1) moment += w.wo.x / WALKS;
                lobe_random4 r = lobe_random(7, 0, k);
                lobe_reflection_draw_f64 d =
                    lobe_reflection_sample_f64(&model, lobe_random_unit_f64(r.word[0], r.word[1]),
                                               lobe_random_unit_f64(r.word[2], r.word[3]), 0);
                drawn += d.weight * d.wo.x / WALKS;
            }
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

/* Integrated over wo, drawn by the cosine, the estimated values are the mean of the walks: their sum, and a
 * moment of where they go. */
static void values_are_those_of_walks(void **state) {
    (void)state;
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ++ndf)
        for (int a = 1; a < 3; ++a)
            for (int c = 0; c < 3; ++c) {
                lobe_microsurface s = surface_of(ndf, alphas[a][0], alphas[a][1]);
                lobe_vec3_f64 wi = toward(cosines[c], 0.4);
                double sum[2] = {0}, squares[2] = {0};
                for (uint64_t k = 0; k < WALKS; ++k) {
                    double walked[2], values[2];
                    lobe_walk w = lobe_walk_sample(s, laws, 2, wi, 11, k, MOST, walked);
                    lobe_random4 r = lobe_random(12, 0, k);
                    double mu = sqrt(fmax(lobe_random_unit_f64(r.word[0], r.word[1]), 1e-12));
                    lobe_vec3_f64 wo =
                        toward(mu, 6.283185307179586 * lobe_random_unit_f64(r.word[2], r.word[3]));
                    assert_true(lobe_walk_eval(s, laws, 2, wi, wo, 13, k, MOST, values));
                    double value = values[1] * 3.14159265358979 / mu;
                    double difference[2] = {value - walked[1], value * wo.x - walked[1] * w.wo.x};
                    for (int m = 0; m < 2; ++m) {
                        sum[m] += difference[m];
                        squares[m] += difference[m] * difference[m];
                    }
                }
                for (int m = 0; m < 2; ++m)
                    if (!(fabs(sum[m]) < 5 * sqrt(squares[m])))
                        fail_msg("ndf %d, alpha %g, cosine %g, moment %d: off by %g of %g", ndf,
                                 s.alpha_x, cosines[c], m, sum[m], sqrt(squares[m]));
            }
}

/* What one bounce makes of a rough dielectric is lobe/dielectric.h, reflected and transmitted, from both sides; all
 * bounces lose nothing. */
static void dielectrics_begin_as_one_bounce(void **state) {
    (void)state;
    lobe_dielectric_options options = lobe_dielectric_default_options();
    options.transport = LOBE_TRANSPORT_IMPORTANCE;
    const double indices[] = {1.5, 0.7};
    for (int n = 0; n < 2; ++n)
        for (int a = 0; a < 3; ++a)
            for (int c = 0; c < 6; ++c) {
                lobe_microsurface s = surface(alphas[a][0], alphas[a][1]);
                lobe_vec3_f64 wi = toward(cosines[c % 3], 0.4);
                if (c > 2) wi.z = -wi.z;
                lobe_dielectric_f64 model =
                    lobe_dielectric_prepare_f64(options, wi, s.alpha_x, s.alpha_y, indices[n]);
                double sum[4] = {0}, squares[4] = {0};
                for (uint64_t k = 0; k < WALKS; ++k) {
                    lobe_walk w = lobe_walk_dielectric_sample(s, indices[n], wi, 14, k, MOST);
                    assert_true(w.bounces >= 1 && w.wo.z != 0);
                    lobe_random4 r = lobe_random(15, 0, k), q = lobe_random(16, 0, k);
                    lobe_dielectric_draw_f64 d = lobe_dielectric_sample_f64(
                        &model, lobe_random_unit_f64(r.word[0], r.word[1]),
                        lobe_random_unit_f64(r.word[2], r.word[3]),
                        lobe_random_unit_f64(q.word[0], q.word[1]));
                    double once = w.bounces == 1, crossed = w.wo.z * wi.z < 0;
                    double weight = d.pdf > 0 ? d.weight : 0, passed = d.transmitted;
                    double difference[4] = {once * (1 - crossed) - weight * (1 - passed),
                                            once * crossed - weight * passed,
                                            once * w.wo.x - weight * d.wo.x,
                                            once * w.wo.y * w.wo.z - weight * d.wo.y * d.wo.z};
                    for (int m = 0; m < 4; ++m) {
                        sum[m] += difference[m];
                        squares[m] += difference[m] * difference[m];
                    }
                }
                for (int m = 0; m < 4; ++m)
                    if (!(fabs(sum[m]) < 5 * sqrt(squares[m]) + 1e-9))
                        fail_msg("index %g, alpha %g, cosine %g, moment %d: off by %g of %g",
                                 indices[n], s.alpha_x, wi.z, m, sum[m], sqrt(squares[m]));
            }
}

/* Even light on both sides, in proportion to the square of the index, stays so: what crosses from one side is
 * what crosses from the other. Equal indices let everything pass straight. */
static void dielectrics_keep_their_balance(void **state) {
    (void)state;
    const double index = 1.4;
    lobe_microsurface s = surface(0.9, 0.5);
    double crossed[2] = {0};
    for (int side = 0; side < 2; ++side)
        for (uint64_t k = 0; k < 4 * WALKS; ++k) {
            lobe_random4 r = lobe_random(17, (uint64_t)side, k);
            double mu = sqrt(fmax(lobe_random_unit_f64(r.word[0], r.word[1]), 1e-12));
            lobe_vec3_f64 wi =
                toward(mu, 6.283185307179586 * lobe_random_unit_f64(r.word[2], r.word[3]));
            if (side) wi.z = -wi.z;
            lobe_walk w = lobe_walk_dielectric_sample(s, index, wi, 18, k, MOST);
            crossed[side] += w.wo.z * wi.z < 0 ? 0.25 / WALKS : 0;
            w = lobe_walk_dielectric_sample(s, 1, wi, 18, k, MOST);
            assert_true(fabs(w.wo.x + wi.x) + fabs(w.wo.z + wi.z) < 1e-9);
        }
    double room = 5 * sqrt(0.25 / (4 * WALKS)) * (1 + index * index);
    assert_true(fabs(crossed[0] - index * index * crossed[1]) < room);
}

static void add(double sum[], double squares[], int m, double difference) {
    sum[m] += difference;
    squares[m] += difference * difference;
}

static void assert_none(const double sum[], const double squares[], int count, const char *what,
                        lobe_microsurface s, double cosine) {
    for (int m = 0; m < count; ++m)
        if (!(fabs(sum[m]) < 5 * sqrt(squares[m]) + 1e-9))
            fail_msg("%s, ndf %d, alpha %g, cosine %g, moment %d: off by %g of %g", what, s.ndf,
                     s.alpha_x, cosine, m, sum[m], sqrt(squares[m]));
}

/* Directions of the whole sphere, by the cosine on a side of even chance. */
static lobe_vec3_f64 random_direction(uint64_t seed, uint64_t k, double *density) {
    lobe_random4 r = lobe_random(seed, 0, k);
    double u = 2 * lobe_random_unit_f64(r.word[0], r.word[1]);
    double mu = sqrt(fmax(u < 1 ? u : u - 1, 1e-12));
    lobe_vec3_f64 w = toward(mu, 6.283185307179586 * lobe_random_unit_f64(r.word[2], r.word[3]));
    *density = mu / (2 * 3.14159265358979);
    if (u < 1) w.z = -w.z;
    return w;
}

/* Integrated over both sides, the estimated values of a dielectric are its walks: what is reflected, what is
 * transmitted, where they go; and all of it together is all of the light. */
static void dielectric_values_are_those_of_walks(void **state) {
    (void)state;
    const double indices[] = {1.5, 0.7};
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ++ndf)
        for (int a = 1; a < 3; ++a)
            for (int c = 0; c < 6; ++c) {
                lobe_microsurface s = surface_of(ndf, alphas[a][0], alphas[a][1]);
                lobe_vec3_f64 wi = toward(cosines[c % 3], 0.4);
                if (c > 2) wi.z = -wi.z;
                double index = indices[(c + ndf) % 2], sum[5] = {0}, squares[5] = {0};
                for (uint64_t k = 0; k < WALKS; ++k) {
                    double density, value;
                    lobe_walk w = lobe_walk_dielectric_sample(s, index, wi, 21, k, MOST);
                    lobe_vec3_f64 wo = random_direction(22, k, &density);
                    assert_true(lobe_walk_dielectric_eval(s, index, wi, wo, 23, k, MOST, &value));
                    value /= density;
                    double here = wo.z * wi.z > 0, there = w.wo.z * wi.z > 0;
                    add(sum, squares, 0, value * here - there);
                    add(sum, squares, 1, value * (1 - here) - (1 - there));
                    add(sum, squares, 2, value - 1);
                    add(sum, squares, 3, value * wo.x - w.wo.x);
                    add(sum, squares, 4, value * wo.y * wo.z - w.wo.y * w.wo.z);
                }
                assert_none(sum, squares, 5, "values of a dielectric", s, wi.z);
            }
}

/* What is known exactly of a value is that of lobe/dielectric.h. */
static void first_value_is_exact(void **state) {
    (void)state;
    lobe_dielectric_options options = lobe_dielectric_default_options();
    options.transport = LOBE_TRANSPORT_IMPORTANCE;
    int crossed = 0;
    for (uint64_t k = 0; k < 4000; ++k) {
        double density, value, index = k % 3 ? 1.5 : 0.6;
        lobe_microsurface s = surface(alphas[k % 3][0], alphas[k % 3][1]);
        lobe_vec3_f64 wi = random_direction(24, k, &density),
                      wo = random_direction(25, k, &density);
        lobe_dielectric_f64 model =
            lobe_dielectric_prepare_f64(options, wi, s.alpha_x, s.alpha_y, index);
        lobe_dielectric_eval_f64 e = lobe_dielectric_eval_wo_f64(&model, wo);
        assert_true(lobe_walk_dielectric_eval(s, index, wi, wo, 26, k, 1, &value));
        if (!(fabs(value - e.f_cos) <= 1e-9 * e.f_cos + 1e-14))
            fail_msg("%d: %g is not %g", (int)k, value, e.f_cos);
        crossed += e.f_cos > 0 && e.transmitted;
    }
    assert_true(crossed > 500);
}

/* f(i,o)/n_o^2 = f(o,i)/n_i^2, one walk from each end: on one side and through the surface. Not near the horizon,
 * where few walks carry most of a value. */
static void dielectric_values_are_reciprocal(void **state) {
    (void)state;
    const double index = 1.5, heights[] = {0.9, 0.5, -0.5, -0.9};
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ++ndf)
        for (int pair = 0; pair < 12; ++pair) {
            lobe_microsurface s = surface_of(ndf, 1, 0.6);
            double z_i = heights[pair / 3], z_o = heights[(pair / 3 + pair % 3 + 1) % 4];
            lobe_vec3_f64 i = toward(fabs(z_i), 0.3), o = toward(fabs(z_o), 1.0 + pair);
            i.z = z_i;
            o.z = z_o;
            double n2_i = z_i > 0 ? 1 : index * index, n2_o = z_o > 0 ? 1 : index * index;
            double sum = 0, squares = 0;
            for (uint64_t k = 0; k < WALKS / 2; ++k) {
                double there, back;
                lobe_walk_dielectric_eval(s, index, i, o, 29, k, MOST, &there);
                lobe_walk_dielectric_eval(s, index, o, i, 30, k, MOST, &back);
                add(&sum, &squares, 0, there / (fabs(z_o) * n2_o) - back / (fabs(z_i) * n2_i));
            }
            assert_none(&sum, &squares, 1, "reciprocity", s, z_i);
        }
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
    const lobe_vec3_f64 up = toward(0.5, 0), down = {0, 0, -1};
    assert_false(lobe_walk_eval(s, laws, 1, up, down, 1, 0, 10, &weight));
    assert_true(weight == 0);
    assert_false(lobe_walk_eval(s, laws, 1, down, up, 1, 0, 10, &weight));
    assert_int_equal(lobe_walk_dielectric_sample(s, 0, up, 1, 0, 10).bounces, 0);
    assert_int_equal(lobe_walk_dielectric_sample(s, NAN, up, 1, 0, 10).bounces, 0);
    const lobe_vec3_f64 edge = {1, 0, 0};
    weight = 7;
    assert_false(lobe_walk_dielectric_eval(s, NAN, up, down, 1, 0, 10, &weight));
    assert_false(lobe_walk_dielectric_eval(s, 1.5, up, edge, 1, 0, 10, &weight));
    assert_false(lobe_walk_dielectric_eval(s, 1.5, edge, up, 1, 0, 10, &weight));
    assert_true(weight == 0);
    assert_true(lobe_walk_dielectric_eval(s, 1, up, down, 1, 0, 10, &weight) && weight == 0);
    s.masking = LOBE_MASKING_VCAVITY;
    assert_int_equal(lobe_walk_sample(s, laws, 1, up, 1, 0, 10, &weight).bounces, 0);
    assert_int_equal(
        lobe_walk_sample(surface(NAN, 1), laws, 1, toward(0.5, 0), 1, 0, 10, &weight).bounces, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(white_walks_lose_nothing),
                                       cmocka_unit_test(one_bounce_is_one_scattering),
                                       cmocka_unit_test(walks_are_reciprocal),
                                       cmocka_unit_test(values_are_those_of_walks),
                                       cmocka_unit_test(dielectrics_begin_as_one_bounce),
                                       cmocka_unit_test(dielectrics_keep_their_balance),
                                       cmocka_unit_test(dielectric_values_are_those_of_walks),
                                       cmocka_unit_test(first_value_is_exact),
                                       cmocka_unit_test(dielectric_values_are_reciprocal),
                                       cmocka_unit_test(walks_are_cut_and_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
