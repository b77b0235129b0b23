/* tests/lib/test_albedo.c: albedos against closed forms and draws; tables and fits against the
 * quadrature; both compensations in the furnace. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <lobe/lobe.h>

#include <math.h>
#include <stdbool.h>

static const double QUARTER = 1.57079632679489661923;

static lobe_microsurface surface(lobe_g2 g2, double alpha_x, double alpha_y) {
    lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, g2, alpha_x, alpha_y};
    return s;
}

/* Every distribution, masking and G2. */
enum { KINDS = LOBE_NDF_COUNT * LOBE_MASKING_COUNT * 2 };

static lobe_microsurface kind(int k, double alpha_x, double alpha_y) {
    lobe_microsurface s = {(lobe_ndf)(k / 2 % LOBE_NDF_COUNT),
                           (lobe_masking)(k / 2 / LOBE_NDF_COUNT), (lobe_g2)(k % 2), alpha_x,
                           alpha_y};
    return s;
}

static lobe_vec3_f64 toward(double mu, double azimuth) {
    double plane = sqrt(fmax(1 - mu * mu, 0));
    lobe_vec3_f64 w = {plane * cos(azimuth), plane * sin(azimuth), mu};
    return w;
}

static double albedo(lobe_microsurface s, double mu, double azimuth) {
    return lobe_albedo(s, lobe_reflectance_one(), toward(mu, azimuth), LOBE_EFFORT_MEDIUM);
}

static double fine(lobe_microsurface s, double mu, double azimuth) {
    return lobe_albedo(s, lobe_reflectance_one(), toward(mu, azimuth), LOBE_EFFORT_FINE);
}

/* 1 - E of the table */
static double missing(const lobe_albedo_f32 *a, double mu, double azimuth) {
    lobe_vec3_f64 w = toward(mu, azimuth);
    return (double)lobe_albedo_missing_f32(a, (lobe_vec3_f32){(float)w.x, (float)w.y, (float)w.z});
}

static double looked_up(const lobe_albedo_f32 *a, double mu, double azimuth) {
    return 1 - missing(a, mu, azimuth);
}

static lobe_albedo_f32 table_of(lobe_microsurface s) {
    return lobe_albedo_prepare_f32(s.ndf, s.masking, s.g2, (float)s.alpha_x, (float)s.alpha_y);
}

/* ---- Quadrature ------------------------------------------------------------------------------ */

static void roughness_one_is_known(void **state) {
    (void)state;
    const lobe_microsurface correlated = surface(LOBE_G2_CORRELATED, 1, 1);
    const lobe_microsurface separable = surface(LOBE_G2_SEPARABLE, 1, 1);
    const double missing = 1 - log(2);
    for (double mu = 1e-4; mu <= 1; mu *= 1.7) {
        assert_true(fabs(fine(correlated, mu, 0.3) - (1 - mu * log(1 + 1 / mu))) < 1e-8);
        assert_true(fabs(fine(separable, mu, 0.3) - 2 * missing / (1 + mu)) < 1e-8);
    }
    const lobe_reflectance one = lobe_reflectance_one();
    assert_true(fabs(lobe_albedo_average(correlated, one, LOBE_EFFORT_FINE) - 4 * missing / 3) <
                1e-8);
    assert_true(
        fabs(lobe_albedo_average(separable, one, LOBE_EFFORT_FINE) - 4 * missing * missing) < 1e-8);
}

/* At normal incidence E is an integral of one dimension, for either G2: here by the midpoint rule. */
static void normal_incidence_is_known(void **state) {
    (void)state;
    enum { STEPS = 20000 };
    for (double alpha = 0.02; alpha < 1.1; alpha *= 1.9) {
        double sum = 0;
        for (int k = 0; k < STEPS; ++k) {
            double v = (k + 0.5) / STEPS, w = v * v, up = 1 - w, a2 = alpha * alpha;
            sum += 2 * v * 2 * up / (up + sqrt(up * up + 4 * a2 * w)) * a2 / ((a2 + w) * (a2 + w));
        }
        for (int g2 = 0; g2 < 2; ++g2)
            assert_true(fabs(fine(surface((lobe_g2)g2, alpha, alpha), 1, 0) - sum / STEPS) < 2e-6);
    }
}

static double reflect(lobe_reflectance f, lobe_microsurface s, lobe_vec3_f64 wi, double *error) {
    enum { DRAWS = 40000 };
    lobe_reflection_options options = lobe_reflection_default_options();
    options.g2 = s.g2;
    lobe_reflection_f64 model = lobe_reflection_prepare_f64(options, wi, s.alpha_x, s.alpha_y);
    double sum = 0, squares = 0;
    for (uint64_t k = 0; k < DRAWS; ++k) {
        lobe_random4 r = lobe_random(3, 0, k);
        lobe_reflection_draw_f64 d =
            lobe_reflection_sample_f64(&model, lobe_random_unit_f64(r.word[0], r.word[1]),
                                       lobe_random_unit_f64(r.word[2], r.word[3]), 0);
        double value = d.weight * lobe_reflectance_at(f, d.cos_im);
        sum += value / DRAWS;
        squares += value * value / DRAWS;
    }
    *error = sqrt(fmax(squares - sum * sum, 0) / DRAWS);
    return sum;
}

/* Either side, unequal roughnesses, every law: the mean of draws. Half of a thousandth of a percent of
 * a right quadrature would fail one of 5 standard errors. */
static void draws_agree(void **state) {
    (void)state;
    const lobe_reflectance laws[] = {lobe_reflectance_one(),
                                     {LOBE_REFLECTANCE_SCHLICK, 0.2, 0},
                                     {LOBE_REFLECTANCE_F82, 0.6, 0.5},
                                     {LOBE_REFLECTANCE_DIELECTRIC, 1.5, 0},
                                     {LOBE_REFLECTANCE_CONDUCTOR, 0.2, 3.4}};
    const double cosines[] = {-0.4, -0.02, 0.02, 0.3, 0.9}, ratios[] = {1, 0.3, 4};
    for (int l = 0; l < 5; ++l)
        for (int c = 0; c < 5; ++c)
            for (int k = 0; k < 3; ++k) {
                lobe_microsurface s = surface((lobe_g2)(k % 2), 0.4, 0.4 * ratios[k]);
                lobe_vec3_f64 wi = toward(cosines[c], 0.7);
                double error, drawn = reflect(laws[l], s, wi, &error);
                double e = lobe_albedo(s, laws[l], wi, LOBE_EFFORT_MEDIUM);
                if (!(fabs(drawn - e) < 5 * error + 1e-5))
                    fail_msg("law %d, cosine %g, ratio %g: %g is not %g +- %g", l, cosines[c],
                             ratios[k], e, drawn, error);
            }
}

static void efforts_agree(void **state) {
    (void)state;
    for (int k = 0; k < KINDS; ++k)
        for (double alpha = 1e-3; alpha < 1.1; alpha *= 10)
            for (double mu = -0.5; mu < 1; mu += 0.31)
                for (double ratio = 1; ratio < 11; ratio *= 3.1) {
                    lobe_microsurface s = kind(k, alpha, alpha / ratio);
                    const bool ggx = s.ndf == LOBE_NDF_GGX;
                    double best = fine(s, mu, 1.1);
                    lobe_vec3_f64 wi = toward(mu, 1.1);
                    double room = ggx || mu > 0 ? 3e-5 : 2e-4;
                    assert_true(fabs(albedo(s, mu, 1.1) - best) < room);
                    double coarse = lobe_albedo(s, lobe_reflectance_one(), wi, LOBE_EFFORT_COARSE);
                    room = ggx || mu > 0 ? 6e-3 : 4e-2;
                    assert_true(fabs(coarse - best) < room);
                }
}

/* Every kind again, by the midpoint rule over directions o and f cos from its definition. */
static double lambda_of(lobe_microsurface s, lobe_vec3_f64 w) {
    double tangent = hypot(s.alpha_x * w.x, s.alpha_y * w.y) / w.z;
    if (s.ndf == LOBE_NDF_GGX) return (sqrt(1 + tangent * tangent) - 1) / 2;
    double a = 1 / tangent;
    return (exp(-a * a) / (a * sqrt(2 * QUARTER)) - erfc(a)) / 2;
}

static double f_cos_of(lobe_microsurface s, lobe_vec3_f64 i, lobe_vec3_f64 o) {
    double x = i.x + o.x, y = i.y + o.y, z = i.z + o.z, length = sqrt(x * x + y * y + z * z);
    double slope2 = (x * x / (s.alpha_x * s.alpha_x) + y * y / (s.alpha_y * s.alpha_y)) / (z * z);
    double mz = z / length, im = length / 2; /* i.m: half the length of i + o */
    double shape = s.ndf == LOBE_NDF_GGX ? 1 / ((1 + slope2) * (1 + slope2)) : exp(-slope2);
    double d = shape / (2 * QUARTER * s.alpha_x * s.alpha_y * mz * mz * mz * mz), g2;
    if (s.masking == LOBE_MASKING_VCAVITY) {
        double g_i = fmin(1, 2 * mz * i.z / im), g_o = fmin(1, 2 * mz * o.z / im);
        g2 = s.g2 == LOBE_G2_SEPARABLE ? g_i * g_o : fmin(g_i, g_o);
    } else {
        double l_i = lambda_of(s, i), l_o = lambda_of(s, o);
        g2 = s.g2 == LOBE_G2_SEPARABLE ? 1 / ((1 + l_i) * (1 + l_o)) : 1 / (1 + l_i + l_o);
    }
    return d * g2 / (4 * i.z);
}

static void definitions_are_integrated(void **state) {
    (void)state;
    enum { STEPS = 400, TURNS = 400 };
    const double cosines[] = {0.1, 0.5, 0.95};
    for (int k = 0; k < KINDS; ++k)
        for (int c = 0; c < 3; ++c) {
            lobe_microsurface s = kind(k, 0.7, 0.4);
            lobe_vec3_f64 wi = toward(cosines[c], 0.6);
            double sum = 0;
            for (int j = 0; j < STEPS; ++j)
                for (int turn = 0; turn < TURNS; ++turn)
                    sum += f_cos_of(s, wi, toward((j + 0.5) / STEPS, 4 * QUARTER * turn / TURNS));
            sum *= 4 * QUARTER / (STEPS * TURNS);
            if (!(fabs(sum - fine(s, cosines[c], 0.6)) < 2e-4))
                fail_msg("kind %d, cosine %g: %g is not %g", k, cosines[c],
                         fine(s, cosines[c], 0.6), sum);
        }
}

static void mirrors_and_bad_input(void **state) {
    (void)state;
    const lobe_reflectance glass = {LOBE_REFLECTANCE_DIELECTRIC, 1.5, 0};
    const lobe_microsurface mirror = surface(LOBE_G2_CORRELATED, 0, 1e-5);
    assert_true(lobe_albedo(mirror, glass, toward(0.5, 0), LOBE_EFFORT_FINE) ==
                lobe_fresnel_dielectric_f64(1.5, 0.5));
    assert_true(lobe_albedo(mirror, glass, toward(-0.5, 0), LOBE_EFFORT_FINE) == 0);
    assert_true(isnan(albedo(surface(LOBE_G2_CORRELATED, -1, 1), 0.5, 0)));
    assert_true(isnan(albedo(surface(LOBE_G2_CORRELATED, NAN, 1), 0.5, 0)));
    assert_true(isnan(lobe_albedo(mirror, glass, (lobe_vec3_f64){0, 0, 0}, LOBE_EFFORT_FINE)));
    lobe_albedo_f32 none = table_of(surface(LOBE_G2_CORRELATED, 3, 1));
    assert_true(!none.is_valid && lobe_albedo_missing_f32(&none, (lobe_vec3_f32){0, 0, 1}) == 0);
    none = table_of(surface(LOBE_G2_CORRELATED, NAN, 1));
    assert_false(none.is_valid);
    assert_false(table_of(surface((lobe_g2)7, 1, 1)).is_valid);
    assert_true(table_of(mirror).is_mirror && table_of(mirror).missing_average == 0);
}

static void averages_of_reflectance(void **state) {
    (void)state;
    const lobe_reflectance laws[] = {{LOBE_REFLECTANCE_SCHLICK, 0.2, 0},
                                     {LOBE_REFLECTANCE_F82, 0.6, 0.5},
                                     {LOBE_REFLECTANCE_DIELECTRIC, 1.5, 0},
                                     {LOBE_REFLECTANCE_CONDUCTOR, 0.2, 3.4},
                                     {LOBE_REFLECTANCE_CONDUCTOR, 1e-3, 0.5}};
    enum { STEPS = 200000 };
    for (int l = 0; l < 5; ++l) {
        double sum = 0;
        for (int k = 0; k < STEPS; ++k) {
            double mu = (k + 0.5) / STEPS;
            sum += 2 * mu * lobe_reflectance_at(laws[l], mu) / STEPS;
        }
        assert_true(fabs(lobe_reflectance_average(laws[l]) - sum) < 1e-6);
    }
    assert_true(lobe_reflectance_average(lobe_reflectance_one()) == 1);
}

/* ---- Tables and fits ------------------------------------------------------------------------- */

typedef struct worst {
    double absolute, relative;
} worst;

static void note(worst *w, double e, double approximate) {
    w->absolute = fmax(w->absolute, fabs(approximate - e));
    w->relative = fmax(w->relative, fabs(e / approximate - 1));
}

/* Roughness and cosine down to 1e-3. */
static void tables_are_close(void **state) {
    (void)state;
    for (int k = 0; k < KINDS; ++k) {
        worst table = {0}, averages = {0};
        for (int i = 0; i <= 13; ++i) {
            double alpha = pow(10, -3.0 + 3.0 * i / 13);
            lobe_microsurface s = kind(k, alpha, alpha);
            lobe_albedo_f32 a = table_of(s);
            for (int j = 0; j <= 19; ++j) {
                double mu = pow(10, -3.0 + 3.0 * j / 19);
                note(&table, s.masking ? fine(s, mu, 0) : albedo(s, mu, 0), looked_up(&a, mu, 0));
            }
            if (i % 4 == 1)
                note(&averages, lobe_albedo_average(s, lobe_reflectance_one(), LOBE_EFFORT_FINE),
                     1 - (double)a.missing_average);
        }
        if (!(table.absolute < 2e-4 && table.relative < 3e-4))
            fail_msg("kind %d: %g, relative %g", k, table.absolute, table.relative);
        assert_true(averages.absolute < 2e-5);
    }
}

static void fits_are_close(void **state) {
    (void)state;
    for (int k = 0; k < LOBE_NDF_COUNT * 2; ++k) {
        worst fit = {0};
        for (int i = 0; i <= 16; ++i) {
            double alpha = pow(10, -3.0 + 3.0 * i / 16);
            lobe_microsurface s = kind(k, alpha, alpha);
            for (int j = 0; j <= 24; ++j) {
                double mu = pow(10, -3.0 + 3.0 * j / 24), e = albedo(s, mu, 0);
                double single =
                    (double)lobe_albedo_fit_missing_f32(s.ndf, s.g2, (float)alpha, (float)mu);
                note(&fit, e, 1 - single);
                assert_true(fabs(lobe_albedo_fit_missing_f64(s.ndf, s.g2, alpha, mu) - single) <
                            1e-3);
            }
            double average = (double)table_of(s).missing_average;
            double lacks = lobe_albedo_fit_missing_average_f64(s.ndf, s.g2, alpha);
            assert_true(fabs(lacks - average) < 3e-4);
            assert_true(fabs(lacks / average - 1) < 3e-3);
        }
        assert_true(fit.absolute < 2e-3 && fit.relative < 4e-3);
    }
}

static void tables_of_unequal_roughnesses_are_close(void **state) {
    (void)state;
    const double ratios[] = {1.1, 2, 5, 10};
    worst table = {0}, averages = {0};
    for (int k = 0; k < KINDS; ++k)
        for (int r = 0; r < 4; ++r)
            for (int i = 0; i <= 6; i += k < 2 ? 1 : 2) {
                double mean = pow(10, -3.0 + 3.0 * i / 6), wide = 2 * mean / (1 + 1 / ratios[r]);
                lobe_microsurface s = kind(k, wide / ratios[r], wide);
                lobe_albedo_f32 a = table_of(s);
                for (int j = 0; j <= 5; ++j)
                    for (int turn = 0; turn <= 3; ++turn) {
                        double mu = pow(10, -3.0 + 3.0 * j / 5), azimuth = QUARTER * turn / 3;
                        note(&table, albedo(s, mu, azimuth), looked_up(&a, mu, azimuth));
                    }
                if (k == 0 && r % 2 && i % 3 == 0)
                    note(&averages,
                         1 - lobe_albedo_average(s, lobe_reflectance_one(), LOBE_EFFORT_MEDIUM),
                         (double)a.missing_average);
            }
    if (!(table.absolute < 2e-3 && table.relative < 4e-3))
        fail_msg("unequal roughnesses: off by %g, %g of E", table.absolute, table.relative);
    assert_true(averages.absolute < 2e-4 && averages.relative < 3e-2);
}

/* The committed numbers are those that the maker would make: at nodes the lookup gives them back. */
static void table_is_reproduced(void **state) {
    (void)state;
    for (int k = 0; k < KINDS; ++k)
        for (int row = 0; row < 36; row += 5)
            for (int column = 1; column < 76; column += 15) {
                double root = pow(0.1 + (pow(2, 0.25) - 0.1) * row / 35, 2);
                double v = column / 75.0, t = v * root / (1 + root - v), alpha = root * root;
                if (t > 1) continue;
                lobe_microsurface s = kind(k, alpha, alpha);
                lobe_albedo_f32 a = table_of(s);
                assert_true(fabs(looked_up(&a, t * t, 0) - fine(s, t * t, 0)) < 1e-5);
            }
}

/* ---- Multiple scattering --------------------------------------------------------------------- */

/* 1/pi * integral of (1 - E) cosine of the table over what it says is missing on average: the albedo of
 * Kulla & Conty's lobe at F = 1 over what it should be. Steps of t, mu = t^4. */
static double lobe_share(const lobe_albedo_f32 *a) {
    enum { STEPS = 200 };
    const int turns = a->alpha_x == a->alpha_y ? 1 : 24;
    double sum = 0;
    for (int j = 0; j < turns; ++j)
        for (int i = 0; i < STEPS; ++i) {
            double t = (i + 0.5) / STEPS, t3 = t * t * t;
            sum += 8 * t3 * t3 * t * missing(a, t3 * t, QUARTER * (j + 0.5) / turns);
        }
    return sum / (STEPS * turns) / (double)a->missing_average;
}

static void white_furnace_is_one(void **state) {
    (void)state;
    for (int k = 0; k < KINDS; ++k)
        for (int i = 0; i <= 12; ++i) {
            double alpha = pow(10, -3.0 + 3.0 * i / 12);
            lobe_microsurface s = kind(k, alpha, alpha);
            lobe_albedo_f32 a = table_of(s);
            double lobe = lobe_share(&a);
            double f_ms = lobe_multiscatter_fms_f64(1, (double)a.missing_average);
            assert_true(fabs(f_ms - 1) < 1e-15);
            for (int j = 0; j <= 9; ++j) {
                double mu = pow(10, -3.0 + 3.0 * j / 9), e = albedo(s, mu, 0);
                double lacks = missing(&a, mu, 0);
                assert_true(fabs(e + f_ms * lacks * lobe - 1) < 1e-3);
                assert_true(fabs(e * lobe_multiscatter_turquin_f64(1, lacks) - 1) < 1e-3);
            }
        }
}

/* The same with the fits: of Kulla & Conty's lobe the share that its own average makes of it. */
static void fitted_furnace_is_nearly_one(void **state) {
    (void)state;
    enum { STEPS = 200 };
    for (int k = 0; k < LOBE_NDF_COUNT * 2; ++k)
        for (int i = 0; i <= 12; ++i) {
            double alpha = pow(10, -3.0 + 3.0 * i / 12), lobe = 0;
            lobe_microsurface s = kind(k, alpha, alpha);
            for (int j = 0; j < STEPS; ++j) {
                double t = (j + 0.5) / STEPS, t3 = t * t * t;
                lobe += 8 * t3 * t3 * t / STEPS *
                        lobe_albedo_fit_missing_f64(s.ndf, s.g2, alpha, t3 * t);
            }
            lobe /= lobe_albedo_fit_missing_average_f64(s.ndf, s.g2, alpha);
            for (int j = 0; j <= 9; ++j) {
                double mu = pow(10, -3.0 + 3.0 * j / 9), e = albedo(s, mu, 0);
                double lacks = lobe_albedo_fit_missing_f64(s.ndf, s.g2, alpha, mu);
                assert_true(fabs(e + lacks * lobe - 1) < 1e-2);
                assert_true(fabs(e * lobe_multiscatter_turquin_f64(1, lacks) - 1) < 1e-2);
            }
        }
}

/* Every distribution and masking, also across the narrow direction of a wide surface, where tables are worst. */
static void anisotropic_furnace_is_nearly_one(void **state) {
    (void)state;
    for (int k = 0; k < LOBE_NDF_COUNT * LOBE_MASKING_COUNT; ++k)
        for (int i = 0; i <= 3; ++i)
            for (double ratio = 2; ratio < 11; ratio *= 2.23) {
                const double mean = 0.562 * pow(10, -1.5 + 1.5 * i / 3);
                const double wide = 2 * mean / (1 + 1 / ratio);
                const lobe_microsurface s = {(lobe_ndf)(k / LOBE_MASKING_COUNT),
                                             (lobe_masking)(k % LOBE_MASKING_COUNT),
                                             LOBE_G2_CORRELATED, wide, wide / ratio};
                const lobe_albedo_f32 a = table_of(s);
                const double lobe = lobe_share(&a);
                for (int j = 0; j <= 4; ++j)
                    for (int azimuth = 0; azimuth < 2; ++azimuth) {
                        const double mu = 0.562 * pow(10, -2.0 + 2.25 * j / 4);
                        const double angle = azimuth ? 1.5708 : 0.8;
                        const double e = albedo(s, fmin(mu, 1), angle);
                        const double lacks = missing(&a, fmin(mu, 1), angle);
                        assert_true(fabs(e + lacks * lobe - 1) < 4e-3);
                        assert_true(fabs(e * lobe_multiscatter_turquin_f64(1, lacks) - 1) < 4e-3);
                    }
            }
}

static void compensation_is_as_published(void **state) {
    (void)state;
    /* Hill 2018: F^2 E/(1 - F (1 - E)) */
    assert_true(fabs(lobe_multiscatter_fms_f64(0.5, 0.2) - 0.25 * 0.8 / 0.9) < 1e-15);
    assert_true(lobe_multiscatter_fms_f64(0, 0.2) == 0);
    /* reciprocal, and nothing where nothing is missing */
    assert_true(lobe_multiscatter_kulla_conty_f64(0.7, 0.3, 0.6, 0.5) ==
                lobe_multiscatter_kulla_conty_f64(0.7, 0.6, 0.3, 0.5));
    assert_true(lobe_multiscatter_kulla_conty_f64(1, 0, 0, 0) == 0);
    assert_true(lobe_multiscatter_kulla_conty_f32(1, 0, 0, 0) == 0);
    assert_true(lobe_multiscatter_turquin_f64(0.5, 0.5) == 1.5);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(roughness_one_is_known),
                                       cmocka_unit_test(normal_incidence_is_known),
                                       cmocka_unit_test(draws_agree),
                                       cmocka_unit_test(efforts_agree),
                                       cmocka_unit_test(definitions_are_integrated),
                                       cmocka_unit_test(mirrors_and_bad_input),
                                       cmocka_unit_test(averages_of_reflectance),
                                       cmocka_unit_test(tables_are_close),
                                       cmocka_unit_test(fits_are_close),
                                       cmocka_unit_test(tables_of_unequal_roughnesses_are_close),
                                       cmocka_unit_test(table_is_reproduced),
                                       cmocka_unit_test(white_furnace_is_one),
                                       cmocka_unit_test(fitted_furnace_is_nearly_one),
                                       cmocka_unit_test(anisotropic_furnace_is_nearly_one),
                                       cmocka_unit_test(compensation_is_as_published)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
