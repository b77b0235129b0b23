/* tests/lib/test_albedo_above.c: albedos above a geometric surface: against those without one, against
 * draws, and against themselves with fewer nodes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <lobe/lobe.h>

#include <math.h>

enum { KINDS = LOBE_NDF_COUNT * LOBE_MASKING_COUNT * 2 };

/* Every distribution, masking and G2. */
static lobe_microsurface kind(int k, double alpha_x, double alpha_y) {
    lobe_microsurface s = {(lobe_ndf)(k / 2 % LOBE_NDF_COUNT),
                           (lobe_masking)(k / 2 / LOBE_NDF_COUNT), (lobe_g2)(k % 2), alpha_x,
                           alpha_y};
    return s;
}

static lobe_vec3_f64 toward(double mu, double azimuth) {
    const double plane = sqrt(fmax(1 - mu * mu, 0));
    const lobe_vec3_f64 w = {plane * cos(azimuth), plane * sin(azimuth), mu};
    return w;
}

static double dot(lobe_vec3_f64 a, lobe_vec3_f64 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double above(lobe_microsurface s, lobe_vec3_f64 wi, lobe_vec3_f64 g, lobe_effort effort) {
    return lobe_albedo_above(s, lobe_reflectance_one(), wi, g, effort);
}

/* A plane along the shading plane cuts nothing more away. */
static void the_shading_plane_changes_nothing(void **state) {
    (void)state;
    const lobe_vec3_f64 up = {0, 0, 1};
    for (int k = 0; k < KINDS; ++k)
        for (double alpha = 1e-3; alpha < 1.1; alpha *= 10)
            for (double mu = 0.02; mu < 1; mu += 0.24) {
                const lobe_microsurface s = kind(k, alpha, alpha / 3);
                const lobe_vec3_f64 wi = toward(mu, 0.4);
                const double e = lobe_albedo(s, lobe_reflectance_one(), wi, LOBE_EFFORT_FINE);
                if (!(fabs(above(s, wi, up, LOBE_EFFORT_FINE) - e) < 1e-8))
                    fail_msg("kind %d, alpha %g, cosine %g", k, alpha, mu);
            }
}

static double drawn(lobe_microsurface s, lobe_vec3_f64 wi, lobe_vec3_f64 g, uint64_t stream,
                    double *error) {
    enum { DRAWS = 20000 };
    lobe_reflection_options o = lobe_reflection_default_options();
    o.model = (lobe_model){s.ndf, s.masking, lobe_best_method(s.ndf, s.masking)};
    o.g2 = s.g2;
    const lobe_reflection_f64 model =
        lobe_reflection_prepare_above_f64(o, wi, s.alpha_x, s.alpha_y, g);
    double sum = 0, squares = 0;
    for (uint64_t k = 0; k < DRAWS; ++k) {
        double u[3];
        lobe_draw_numbers_f64(stream, k, u);
        const double w = lobe_reflection_sample_f64(&model, u[0], u[1], u[2]).weight;
        sum += w / DRAWS;
        squares += w * w / DRAWS;
    }
    *error = sqrt(fmax(squares - sum * sum, 0) / DRAWS);
    return sum;
}

/* 5 standard errors each: of some 300 cases a right quadrature fails one in 2e-4 of the times. */
static void draws_agree(void **state) {
    (void)state;
    const double cosines[] = {-0.3, 0.05, 0.3, 0.8}, tilts[] = {0.3, 0.8, 1.3};
    uint64_t stream = 0;
    int cases = 0;
    for (int k = 0; k < KINDS; ++k)
        for (int c = 0; c < 4; ++c)
            for (int t = 0; t < 3; ++t)
                for (int turn = 0; turn < 6; ++turn) {
                    const lobe_microsurface s = kind(k, 0.5, turn % 2 ? 0.5 : 0.15);
                    const lobe_vec3_f64 wi = toward(cosines[c], 0.4),
                                        g = toward(cos(tilts[t]), 1.1 * turn);
                    if (!(dot(wi, g) > 0.01)) continue;
                    double error;
                    const double mean = drawn(s, wi, g, stream++, &error);
                    const double e = above(s, wi, g, LOBE_EFFORT_MEDIUM);
                    if (!(fabs(mean - e) < 5 * error + 2e-4))
                        fail_msg("kind %d, cosine %g, tilt %g, turn %d: %g is not %g +- %g", k,
                                 cosines[c], tilts[t], turn, e, mean, error);
                    ++cases;
                }
    assert_in_range(cases, 250, 600);
}

/* Half of the nodes; V-cavities have creases that a corner can cut. */
static void efforts_agree(void **state) {
    (void)state;
    for (int k = 0; k < KINDS; ++k)
        for (double alpha = 1e-2; alpha < 1.1; alpha *= 5)
            for (double mu = 0.02; mu < 1; mu += 0.31)
                for (int turn = 0; turn < 4; ++turn) {
                    const lobe_microsurface s = kind(k, alpha, alpha / (1 + turn));
                    const lobe_vec3_f64 wi = toward(mu, 0.4), g = toward(0.7, 1.7 * turn);
                    if (!(dot(wi, g) > 0)) continue;
                    const double room = s.masking == LOBE_MASKING_VCAVITY ? 1e-4 : 5e-5;
                    const double fine = above(s, wi, g, LOBE_EFFORT_FINE);
                    const double medium = above(s, wi, g, LOBE_EFFORT_MEDIUM);
                    if (!(fabs(fine - medium) < room))
                        fail_msg("kind %d, alpha %g, cosine %g, turn %d: %g and %g", k, alpha, mu,
                                 turn, fine, medium);
                }
}

static void mirrors_and_bad_input(void **state) {
    (void)state;
    const lobe_microsurface mirror = kind(0, 0, 0), s = kind(0, 0.3, 0.3);
    const lobe_vec3_f64 wi = {0.6, 0, 0.8}, toward_wi = {0.6, 0, 0.8}, away = {-0.8, 0, 0.6};
    const lobe_vec3_f64 steep = {0.96, 0, 0.28}, nothing = {0, 0, 0}, bad = {NAN, 0, 1};
    const lobe_reflectance half = {LOBE_REFLECTANCE_SCHLICK, 0.5, 0};
    const lobe_vec3_f64 normal = {0, 0, 1};
    assert_true(lobe_albedo_above(mirror, half, normal, normal, LOBE_EFFORT_COARSE) == 0.5);
    assert_true(above(mirror, wi, toward_wi, LOBE_EFFORT_COARSE) == 1);
    assert_true(above(mirror, wi, steep, LOBE_EFFORT_COARSE) == 0);
    assert_true(isnan(above(s, wi, away, LOBE_EFFORT_COARSE)));
    assert_true(isnan(above(s, wi, nothing, LOBE_EFFORT_COARSE)));
    assert_true(isnan(above(s, wi, bad, LOBE_EFFORT_COARSE)));
    assert_true(isnan(above(s, bad, normal, LOBE_EFFORT_COARSE)));
    assert_true(isnan(above(kind(0, -1, 1), wi, normal, LOBE_EFFORT_COARSE)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_shading_plane_changes_nothing), cmocka_unit_test(draws_agree),
        cmocka_unit_test(efforts_agree), cmocka_unit_test(mirrors_and_bad_input)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
