/* tests/lib/test_dielectric.c: rough dielectrics: optics from first principles, draws against density
 * and value, reciprocity, point masses, energy, special numbers, float against double. Draws over
 * both hemispheres are tested in tests/verify/test_dielectric.c. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "cases.h"

#include <float.h>

static const double iors[] = {1 + 1e-6, 1.0001, 1.33, 1.5, 2.4, 1 / 1.5};
static const double alphas[][2] = {{0.01, 0.01}, {0.3, 0.3}, {0.1, 0.6}, {1, 1}};
static const double degrees[] = {0, 30, 60, 85, 89.9, 90, 95, 120, 150, 180};
enum { IORS = 6, ALPHAS = 4, DEGREES = 10 };

static void assert_near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.17g is not %.17g +- %g", value, expected, tolerance);
}

static double dot(lobe_vec3_f64 a, lobe_vec3_f64 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static lobe_dielectric_options options_of(lobe_g2 g2, lobe_transport transport) {
    lobe_dielectric_options options = lobe_dielectric_default_options();
    options.g2 = g2;
    options.transport = transport;
    return options;
}

static void random_triple(uint64_t stream, uint64_t k, double u[3]) {
    double unused;
    case_random(stream, k, &u[0], &u[1]);
    case_random(stream + 1000, k, &u[2], &unused);
}

/* A configuration of the lists above. */
typedef struct configuration {
    lobe_dielectric_options options;
    lobe_vec3_f64 wi;
    double alpha_x, alpha_y, ior;
} configuration;

enum { CONFIGURATIONS = IORS * ALPHAS * DEGREES * 4 };

static configuration configuration_at(int k) {
    int g2 = k & 1, transport = k >> 1 & 1, rest = k >> 2;
    configuration c = {.options = options_of((lobe_g2)g2, (lobe_transport)transport)};
    c.wi = case_direction(degrees[rest % DEGREES], 27);
    const double *alpha = alphas[rest / DEGREES % ALPHAS];
    c.alpha_x = alpha[0];
    c.alpha_y = alpha[1];
    c.ior = iors[rest / DEGREES / ALPHAS];
    return c;
}

static lobe_dielectric_f64 model_of(const configuration *c) {
    return lobe_dielectric_prepare_f64(c->options, c->wi, c->alpha_x, c->alpha_y, c->ior);
}

/* Mirrored about m, or in the plane of incidence at Snell's angle; on the side that the flag says. */
static void check_optics(const configuration *c, const lobe_dielectric_draw_f64 *s) {
    double cosine = dot(c->wi, s->m);
    assert_near(dot(s->wo, s->wo), 1, 1e-12);
    assert_near(dot(s->m, s->m), 1, 1e-12);
    assert_true((c->wi.z < 0) == (s->m.z < 0));
    assert_true(s->transmitted == ((c->wi.z < 0) != (s->wo.z < 0)));
    double n_i = c->wi.z < 0 ? c->ior : 1, n_o = c->wi.z < 0 ? 1 : c->ior;
    if (!s->transmitted) n_o = n_i;
    lobe_vec3_f64 along = {
        n_i * (c->wi.x - cosine * s->m.x) + n_o * (s->wo.x - dot(s->wo, s->m) * s->m.x),
        n_i * (c->wi.y - cosine * s->m.y) + n_o * (s->wo.y - dot(s->wo, s->m) * s->m.y),
        n_i * (c->wi.z - cosine * s->m.z) + n_o * (s->wo.z - dot(s->wo, s->m) * s->m.z)};
    assert_near(dot(along, along), 0, 1e-24);
    assert_true(dot(s->wo, s->m) * (s->transmitted ? -1 : 1) > 0);
    double eta = c->wi.z < 0 ? 1 / c->ior : c->ior;
    double room = 1e-13 / fmax(fabs(eta * eta - 1 + cosine * cosine), 1e-9);
    assert_near(s->fresnel, lobe_fresnel_dielectric_f64(eta, cosine), room + 1e-9 * s->fresnel);
}

/* pdf and weight of a draw are those of the direction it returns, where rounding that direction leaves
 * enough of it: |n_i wi + n_o wo| is small for an index near 1. */
static void check_density(const configuration *c, const lobe_dielectric_f64 *model,
                          const lobe_dielectric_draw_f64 *s) {
    lobe_dielectric_eval_f64 e = lobe_dielectric_eval_wo_f64(model, s->wo);
    double half = s->transmitted ? fabs(c->ior - 1) / 2 : s->cos_im;
    double spread = half * fmin(c->alpha_x, c->alpha_y) * s->cos_im;
    double room = 1e-12 + 1e-14 / (spread * spread) + 1e-15 / (fabs(s->wo.z) * half);
    if (room > 1e-3) return;
    if (!(fabs(e.pdf / s->pdf - 1) < room) || !(fabs(e.f_cos - s->weight * s->pdf) < room * s->pdf))
        fail_msg("ior %g alpha %g %g wi %g %g %g wo %g %g %g: pdf %.17g, drawn with %.17g; f cos "
                 "%.17g, weight * pdf %.17g",
                 c->ior, c->alpha_x, c->alpha_y, c->wi.x, c->wi.y, c->wi.z, s->wo.x, s->wo.y,
                 s->wo.z, e.pdf, s->pdf, e.f_cos, s->weight * s->pdf);
    assert_true(e.transmitted == s->transmitted);
    assert_true(e.pdf == lobe_dielectric_pdf_f64(model, s->wo));
}

static void draws_are_optics_and_agree_with_density_and_value(void **state) {
    (void)state;
    uint64_t rejected_outside = 0, rejected_inside = 0;
    for (int k = 0; k < CONFIGURATIONS; ++k) {
        configuration c = configuration_at(k);
        lobe_dielectric_f64 model = model_of(&c);
        int low_index = (c.wi.z < 0) == (c.ior < 1);
        double most =
            c.options.transport == LOBE_TRANSPORT_RADIANCE ? 1 / (model.eta * model.eta) : 1;
        for (uint64_t i = 0; i < 400; ++i) {
            double u[3];
            random_triple(7, i, u);
            lobe_dielectric_draw_f64 s = lobe_dielectric_sample_f64(&model, u[0], u[1], u[2]);
            assert_true(isfinite(s.pdf) && s.pdf >= 0 && s.weight >= 0 && !s.is_point);
            assert_true(s.weight <= (s.transmitted ? most : 1) * (1 + 1e-12));
            if (!(s.pdf > 0)) {
                *(low_index ? &rejected_outside : &rejected_inside) += 1;
                assert_true(s.weight == 0);
                continue;
            }
            check_optics(&c, &s);
            check_density(&c, &model, &s);
        }
    }
    assert_true(rejected_outside == 0);
    assert_true(rejected_inside > 0);
}

static lobe_vec3_f64 uniform_direction(uint64_t stream, uint64_t k) {
    double u1, u2;
    case_random(stream, k, &u1, &u2);
    double z = 2 * u1 - 1, s = sqrt((1 - z) * (1 + z));
    return (lobe_vec3_f64){s * cos(2 * CASES_PI * u2), s * sin(2 * CASES_PI * u2), z};
}

/* f(i,o)/n_o^2 = f(o,i)/n_i^2 for importance, f(i,o)/n_i^2 = f(o,i)/n_o^2 for radiance. */
static void values_are_reciprocal(void **state) {
    (void)state;
    int transmitted = 0, reflected = 0;
    for (int k = 0; k < CONFIGURATIONS; ++k) {
        configuration c = configuration_at(k);
        if (c.alpha_x < 0.1 || c.ior < 1.2)
            continue; /* few pairs of random directions scatter there */
        for (uint64_t i = 0; i < 50; ++i) {
            c.wi = uniform_direction(11, i + 50 * (uint64_t)k);
            lobe_vec3_f64 wo = uniform_direction(12, i + 50 * (uint64_t)k);
            configuration back = c;
            back.wi = wo;
            lobe_dielectric_f64 there = model_of(&c), here = model_of(&back);
            double n_i = c.wi.z < 0 ? c.ior : 1, n_o = wo.z < 0 ? c.ior : 1;
            int is_radiance = c.options.transport == LOBE_TRANSPORT_RADIANCE;
            double f = lobe_dielectric_eval_wo_f64(&there, wo).f_cos / fabs(wo.z);
            double g = lobe_dielectric_eval_wo_f64(&here, c.wi).f_cos / fabs(c.wi.z);
            double a = f / (is_radiance ? n_i * n_i : n_o * n_o);
            double b = g / (is_radiance ? n_o * n_o : n_i * n_i);
            assert_near(a, b, 1e-8 * (a + b) + 1e-13);
            if (a > 0) *(n_i != n_o ? &transmitted : &reflected) += 1;
        }
    }
    assert_true(transmitted > 1000 && reflected > 1000);
}

/* R and T of a regular grid of n x n normals, the choice stratified with an offset of its own for each. */
static void furnace(const lobe_dielectric_f64 *model, int n, double *reflected, double *passed) {
    enum { CHOICES = 8 };
    double sum[2] = {0, 0};
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < CHOICES; ++k) {
                double u3 = (k + fmod(0.618033988749895 * (i * n + j), 1)) / CHOICES;
                lobe_dielectric_draw_f64 s =
                    lobe_dielectric_sample_f64(model, (i + 0.5) / n, (j + 0.5) / n, u3);
                sum[s.transmitted] += s.weight;
            }
    *reflected = sum[0] / (n * n * CHOICES);
    *passed = sum[1] / (n * n * CHOICES);
}

static void energy_is_never_made(void **state) {
    (void)state;
    for (int k = 0; k < CONFIGURATIONS; ++k) {
        configuration c = configuration_at(k);
        if (c.options.transport == LOBE_TRANSPORT_RADIANCE) continue;
        double r, t;
        lobe_dielectric_f64 model = model_of(&c);
        furnace(&model, 12, &r, &t);
        assert_true(r + t <= 1 + 1e-9);
    }
}

/* A nearly smooth surface reflects and transmits as Fresnel says. */
static void smooth_limit(void **state) {
    (void)state;
    for (int side = -1; side <= 1; side += 2) {
        configuration c = {options_of(LOBE_G2_CORRELATED, LOBE_TRANSPORT_IMPORTANCE),
                           {0.5, 0, side * sqrt(0.75)},
                           1e-3,
                           1e-3,
                           1.5};
        lobe_dielectric_f64 model = model_of(&c);
        double r, t, f = lobe_fresnel_dielectric_f64(side < 0 ? 1 / 1.5 : 1.5, sqrt(0.75));
        furnace(&model, 64, &r, &t);
        assert_near(r, f, 1e-3);
        assert_near(t, 1 - f, 1e-3);
    }
}

/* Beyond the critical angle, with little roughness, all is reflected. */
static void total_internal_reflection(void **state) {
    (void)state;
    configuration c = {options_of(LOBE_G2_SEPARABLE, LOBE_TRANSPORT_RADIANCE),
                       case_direction(120, 0), 0.01, 0.01, 1.5};
    lobe_dielectric_f64 model = model_of(&c);
    double r, t;
    furnace(&model, 64, &r, &t);
    assert_near(r, 1, 2e-3);
    assert_near(t, 0, 1e-4);
}

static void smooth_surfaces_are_point_masses(void **state) {
    (void)state;
    for (int side = -1; side <= 1; side += 2) {
        lobe_vec3_f64 wi = {0.6, 0, side * 0.8};
        lobe_dielectric_options options = options_of(LOBE_G2_CORRELATED, LOBE_TRANSPORT_RADIANCE);
        lobe_dielectric_f64 model = lobe_dielectric_prepare_f64(options, wi, 0, 5e-5, 1.25);
        double eta = side < 0 ? 0.8 : 1.25, f = lobe_fresnel_dielectric_f64(eta, 0.8);
        assert_true(model.is_smooth && model.eta == eta);
        lobe_dielectric_draw_f64 s = lobe_dielectric_sample_f64(&model, 0.3, 0.8, f - 1e-9);
        assert_true(s.is_point && !s.transmitted && s.weight == 1);
        assert_near(s.pdf, f, 1e-14);
        assert_near(s.wo.x, -0.6, 1e-15);
        assert_near(s.wo.z, wi.z, 1e-15);
        s = lobe_dielectric_sample_f64(&model, 0.3, 0.8, f + 1e-9);
        assert_true(s.is_point && s.transmitted);
        assert_near(s.pdf, 1 - f, 1e-14);
        assert_near(s.weight, 1 / (eta * eta), 1e-14);
        assert_near(s.wo.x, -0.6 / eta, 1e-14);
        assert_true(s.wo.z * side < 0);
        assert_true(lobe_dielectric_pdf_f64(&model, s.wo) == 0);
    }
}

/* Straight on, all of it, at any roughness and from both sides. */
static void equal_indices_are_no_surface(void **state) {
    (void)state;
    for (int k = 0; k < ALPHAS * DEGREES; ++k) {
        lobe_vec3_f64 wi = case_direction(degrees[k % DEGREES], 40);
        if (fabs(wi.z) < 1e-9) continue;
        const double *alpha = alphas[k / DEGREES];
        lobe_dielectric_f64 model = lobe_dielectric_prepare_f64(lobe_dielectric_default_options(),
                                                                wi, alpha[0], alpha[1], 1);
        assert_true(model.is_matched);
        lobe_dielectric_draw_f64 s = lobe_dielectric_sample_f64(&model, 0.4, 0.2, 0);
        assert_true(s.is_point && s.transmitted && s.weight == 1 && s.pdf == 1 && s.fresnel == 0);
        assert_true(s.wo.x == -wi.x && s.wo.y == -wi.y && s.wo.z == -wi.z);
        assert_true(lobe_dielectric_eval_wo_f64(&model, s.wo).f_cos == 0);
    }
}

/* A pair whose facet is grazed, cos(i, m) = `cosine`, from outside: from inside it is next to total reflection. */
static int grazing_pair(uint64_t k, double cosine, double ior, lobe_vec3_f32 *wi,
                        lobe_vec3_f32 *wo) {
    lobe_vec3_f64 m = uniform_direction(21, k), side = uniform_direction(22, k);
    m.z = fabs(m.z);
    const double part = dot(m, side), inner = sqrt(1 - (1 - cosine * cosine) / (ior * ior));
    const double length = sqrt(1 - part * part), sine = sqrt(1 - cosine * cosine);
    const lobe_vec3_f64 t = {(side.x - part * m.x) / length, (side.y - part * m.y) / length,
                             (side.z - part * m.z) / length};
    *wi = (lobe_vec3_f32){(float)(cosine * m.x + sine * t.x), (float)(cosine * m.y + sine * t.y),
                          (float)(cosine * m.z + sine * t.z)};
    *wo = (lobe_vec3_f32){(float)(-inner * m.x - sine / ior * t.x),
                          (float)(-inner * m.y - sine / ior * t.y),
                          (float)(-inner * m.z - sine / ior * t.z)};
    return wi->z > 0.01f && wo->z < -0.01f;
}

/* Both sides see the light that passes next to the critical angle, and as much of it. */
static void critical_angle_from_both_sides(void **state) {
    (void)state;
    const double cosines[] = {1e-2, 1e-3, 1e-4}, indices[] = {1.2, 1.5, 2.4};
    lobe_dielectric_options options = options_of(LOBE_G2_CORRELATED, LOBE_TRANSPORT_IMPORTANCE);
    int pairs = 0;
    for (uint64_t k = 0; k < 1800; ++k) {
        const double cosine = cosines[k % 3], ior = (float)indices[k / 3 % 3];
        lobe_vec3_f32 wi, wo;
        if (!grazing_pair(k, cosine, ior, &wi, &wo)) continue;
        lobe_dielectric_f32 there =
            lobe_dielectric_prepare_f32(options, wi, 0.8f, 0.8f, (float)ior);
        lobe_dielectric_f32 here = lobe_dielectric_prepare_f32(options, wo, 0.8f, 0.8f, (float)ior);
        const double a = lobe_dielectric_eval_wo_f32(&there, wo).f_cos / fabs(wo.z) / (ior * ior);
        const double b = lobe_dielectric_eval_wo_f32(&here, wi).f_cos / fabs(wi.z);
        assert_true(a > 0 && b > 0);
        assert_near(a / b, 1, 64 * FLT_EPSILON / cosine);
        pairs += 1;
    }
    assert_true(pairs > 500);
}

/* Every index next to 1 gives finite draws that leave wi nearly straight. */
static void near_equal_indices_do_not_blow_up(void **state) {
    (void)state;
    for (int step = -400; step <= 400; ++step) {
        float ior = 1 + (float)step * FLT_EPSILON;
        for (int d = 0; d < DEGREES; ++d) {
            lobe_vec3_f32 wi = case_to_f32(case_direction(degrees[d], 40));
            if (fabsf(wi.z) < 0.01f) continue;
            lobe_dielectric_f32 model = lobe_dielectric_prepare_f32(
                options_of(LOBE_G2_SEPARABLE, LOBE_TRANSPORT_RADIANCE), wi, 0.3f, 0.3f, ior);
            lobe_dielectric_draw_f32 s = lobe_dielectric_sample_f32(&model, 0.7f, 0.3f, 0.5f);
            assert_true(isfinite(s.pdf) && s.pdf > 0 && s.transmitted);
            assert_true(s.weight > 0 && s.weight <= 1 + 1e-4f);
            assert_near(s.wo.x, -wi.x, 2e-3);
            assert_near(s.wo.z, -wi.z, 2e-3);
            lobe_dielectric_eval_f32 e = lobe_dielectric_eval_wo_f32(&model, s.wo);
            assert_true(isfinite(e.f_cos) && e.f_cos >= 0 && isfinite(e.pdf) && e.pdf >= 0);
        }
    }
}

/* F' = 2F/(1 + F) at each facet; the rest passes straight; compensated, nothing is lost. */
static void thin_walls(void **state) {
    (void)state;
    lobe_dielectric_options options = options_of(LOBE_G2_CORRELATED, LOBE_TRANSPORT_RADIANCE);
    options.thin = 1;
    for (int compensate = 0; compensate < 2; ++compensate)
        for (int d = 0; d < DEGREES; ++d) {
            lobe_vec3_f64 wi = case_direction(degrees[d], 40);
            if (fabs(wi.z) < 1e-9) continue;
            options.compensate = compensate;
            lobe_dielectric_f64 model = lobe_dielectric_prepare_f64(options, wi, 0.4, 0.7, 1.5);
            lobe_dielectric_draw_f64 s = lobe_dielectric_sample_f64(&model, 0.1, 0.3, 1 - 1e-9);
            assert_true(s.transmitted && s.is_point && s.wo.z == -wi.z && s.wo.x == -wi.x);
            double f = lobe_fresnel_dielectric_f64(1.5, s.cos_im);
            assert_near(s.fresnel, 2 * f / (1 + f), 1e-13);
            double r, t;
            furnace(&model, 16, &r, &t);
            assert_true(r + t <= 1 + 1e-12);
            if (compensate) assert_near(r + t, 1, 1e-12);
            /* both sides are outside */
            lobe_vec3_f64 turned = {wi.x, wi.y, -wi.z};
            lobe_dielectric_f64 other = lobe_dielectric_prepare_f64(options, turned, 0.4, 0.7, 1.5);
            lobe_vec3_f64 up = {0.1, 0.2, sqrt(0.95)}, down = {0.1, 0.2, -sqrt(0.95)};
            int above = wi.z > 0;
            assert_true(lobe_dielectric_eval_wo_f64(&model, above ? up : down).f_cos ==
                        lobe_dielectric_eval_wo_f64(&other, above ? down : up).f_cos);
            assert_true(lobe_dielectric_pdf_f64(&model, above ? down : up) == 0);
        }
}

/* Reflected and transmitted light add up to 1, from both sides. */
static void compensation_restores_the_furnace(void **state) {
    (void)state;
    const double cosines[] = {1, 0.7, 0.3, 0.05, -0.05, -0.3, -0.7, -1};
    const double roughness[] = {0.05, 0.3, 0.6, 1}, indices[] = {1.02, 1.15, 1.5, 2.4};
    for (int k = 0; k < 8 * 4 * 4 * 2; ++k) {
        lobe_dielectric_options options = options_of((lobe_g2)(k & 1), LOBE_TRANSPORT_IMPORTANCE);
        options.compensate = 1;
        double z = cosines[k / 2 % 8], alpha = roughness[k / 16 % 4], ior = indices[k / 64];
        lobe_vec3_f64 wi = {sqrt(1 - z * z), 0, z};
        lobe_dielectric_f64 model = lobe_dielectric_prepare_f64(options, wi, alpha, alpha, ior);
        double r, t;
        furnace(&model, 96, &r, &t);
        if (!(fabs(r + t - 1) < 0.006))
            fail_msg("wi.z %g alpha %g ior %g: %g", z, alpha, ior, r + t);
    }
}

/* Nor does it leave much where the roughnesses differ, along both axes and between them: the worst that the
 * table leaves here is 0.0025 at 2 : 1, 0.0073 at 4 : 1. */
static void compensation_knows_two_roughnesses(void **state) {
    (void)state;
    const double cosines[] = {0.9, 0.1, -0.1, -0.9}, turns[] = {0, 0.7, 1.5707963};
    const double roughness[] = {0.2, 0.7, 1}, indices[] = {1.02, 1.5, 2.2};
    for (int k = 0; k < 4 * 3 * 3 * 3 * 2; ++k) {
        lobe_dielectric_options options = options_of((lobe_g2)(k & 1), LOBE_TRANSPORT_IMPORTANCE);
        options.compensate = 1;
        double z = cosines[k / 2 % 4], turn = turns[k / 8 % 3], sine = sqrt(1 - z * z);
        double alpha = roughness[k / 24 % 3], ior = indices[k / 72], ratio = k % 4 < 2 ? 2 : 4;
        lobe_vec3_f64 wi = {sine * cos(turn), sine * sin(turn), z};
        double wide_x = k % 3 == 0 ? alpha / ratio : alpha;
        lobe_dielectric_f64 model =
            lobe_dielectric_prepare_f64(options, wi, wide_x, alpha * alpha / ratio / wide_x, ior);
        double r, t;
        furnace(&model, 96, &r, &t);
        if (!(fabs(r + t - 1) < (ratio < 3 ? 0.004 : 0.009)))
            fail_msg("wi.z %g turn %g alpha %g,%g ior %g: %g", z, turn, model.alpha_x,
                     model.alpha_y, ior, r + t);
    }
}

/* It multiplies values and weights alike and leaves the densities. */
static void compensation_is_a_factor(void **state) {
    (void)state;
    lobe_dielectric_options options = options_of(LOBE_G2_SEPARABLE, LOBE_TRANSPORT_RADIANCE);
    lobe_vec3_f64 wi = case_direction(70, 10);
    lobe_dielectric_f64 plain = lobe_dielectric_prepare_f64(options, wi, 0.5, 0.5, 1.5);
    options.compensate = 1;
    lobe_dielectric_f64 full = lobe_dielectric_prepare_f64(options, wi, 0.5, 0.5, 1.5);
    assert_true(plain.energy_factor == 1 && full.energy_factor > 1.05);
    for (uint64_t i = 0; i < 200; ++i) {
        double u[3];
        random_triple(9, i, u);
        lobe_dielectric_draw_f64 a = lobe_dielectric_sample_f64(&plain, u[0], u[1], u[2]);
        lobe_dielectric_draw_f64 b = lobe_dielectric_sample_f64(&full, u[0], u[1], u[2]);
        assert_true(a.pdf == b.pdf && a.wo.x == b.wo.x);
        assert_near(b.weight, a.weight * full.energy_factor, 1e-14);
        assert_near(lobe_dielectric_eval_wo_f64(&full, a.wo).f_cos,
                    lobe_dielectric_eval_wo_f64(&plain, a.wo).f_cos * full.energy_factor,
                    1e-13 * a.pdf);
    }
}

/* Float draws follow double ones, and their density is that of the exact model at what was drawn. The
 * bounds are those at the foot of kernel/ggx_dielectric.h with some room. */
static void float_follows_double(void **state) {
    (void)state;
    double worst = 0;
    for (int k = 0; k < CONFIGURATIONS; ++k) {
        configuration c = configuration_at(k);
        float ax = (float)c.alpha_x, ay = (float)c.alpha_y, ior = (float)c.ior;
        lobe_vec3_f32 wi = case_to_f32(c.wi);
        lobe_dielectric_f32 f = lobe_dielectric_prepare_f32(c.options, wi, ax, ay, ior);
        lobe_dielectric_f64 d =
            lobe_dielectric_prepare_f64(c.options, case_to_f64(wi), ax, ay, ior);
        for (uint64_t i = 0; i < 100; ++i) {
            double u[3];
            random_triple(13, i, u);
            for (int w = 0; w < 3; ++w) u[w] = (float)(0.98 * u[w]);
            lobe_dielectric_draw_f32 a =
                lobe_dielectric_sample_f32(&f, (float)u[0], (float)u[1], (float)u[2]);
            lobe_dielectric_draw_f64 b = lobe_dielectric_sample_f64(&d, u[0], u[1], u[2]);
            if (a.pdf == 0 || b.pdf == 0 || a.transmitted != b.transmitted || a.is_point) continue;
            double error = fabs(a.wo.x - b.wo.x) + fabs(a.wo.y - b.wo.y) + fabs(a.wo.z - b.wo.z);
            worst = fmax(worst, error);
        }
    }
    print_message("direction %.2g\n", worst);
    assert_true(worst < 3e-4);
}

static const float specials[] = {0.0f,  -0.0f, 1e-45f,  1e-38f,   1e-4f,     0.5f, 1.0f,
                                 -1.0f, 2.0f,  FLT_MAX, INFINITY, -INFINITY, NAN,  0.99999994f};
enum { SPECIALS = sizeof specials / sizeof *specials };

static int is_number(float x) {
    return isfinite(x) && x >= 0;
}

static void assert_sane(const lobe_dielectric_f32 *model, lobe_vec3_f32 wo, float u1, float u2,
                        float u3) {
    lobe_dielectric_draw_f32 s = lobe_dielectric_sample_f32(model, u1, u2, u3);
    assert_true(is_number(s.pdf) && is_number(s.weight) && is_number(s.fresnel));
    assert_true(isfinite(s.wo.x) && isfinite(s.wo.y) && isfinite(s.wo.z));
    assert_true(isfinite(s.m.x) && isfinite(s.m.y) && isfinite(s.m.z));
    assert_true(s.pdf > 0 || s.weight == 0);
    lobe_dielectric_eval_f32 e = lobe_dielectric_eval_wo_f32(model, wo);
    assert_true(is_number(e.f_cos) && is_number(e.pdf) && is_number(e.fresnel));
    assert_true(e.pdf > 0 || e.f_cos == 0);
}

static void special_numbers(void **state) {
    (void)state;
    const int cubes = SPECIALS * SPECIALS * SPECIALS;
    lobe_vec3_f32 up = {0.6f, 0, 0.8f}, down = {0, 0.6f, -0.8f};
    for (int k = 0; k < 16 * cubes; ++k) {
        lobe_dielectric_options options = lobe_dielectric_default_options();
        options.g2 = (lobe_g2)(k & 1);
        options.transport = (lobe_transport)(k >> 1 & 1);
        options.thin = k >> 2 & 1;
        options.compensate = k >> 3 & 1;
        int cube = k >> 4;
        lobe_vec3_f32 v = {specials[cube % SPECIALS], specials[cube / SPECIALS % SPECIALS],
                           specials[cube / SPECIALS / SPECIALS]};
        lobe_vec3_f32 wi = k & 2 ? up : down;
        lobe_dielectric_f32 m = lobe_dielectric_prepare_f32(options, wi, v.x, v.y, v.z);
        assert_sane(&m, up, 0.3f, 0.7f, 0.5f);
        assert_sane(&m, down, 0.9f, 0.2f, 0.1f);
        m = lobe_dielectric_prepare_f32(options, v, 0.3f, 0.3f, 1.5f);
        assert_sane(&m, up, 0.3f, 0.7f, 0.5f);
        m = lobe_dielectric_prepare_f32(options, wi, 0.3f, 0.1f, 1.5f);
        assert_sane(&m, v, v.x, v.y, v.z);
    }
}

static void unusable_parameters_make_an_invalid_model(void **state) {
    (void)state;
    const double bad[] = {0, -1, 1e-4, 1e4, INFINITY, NAN};
    for (int k = 0; k < 6; ++k) {
        lobe_dielectric_f64 m = lobe_dielectric_prepare_f64(
            lobe_dielectric_default_options(), case_direction(30, 0), 0.3, 0.3, bad[k]);
        assert_false(m.is_valid);
        assert_true(lobe_dielectric_sample_f64(&m, 0.5, 0.5, 0.5).pdf == 0);
        assert_true(lobe_dielectric_pdf_f64(&m, case_direction(30, 180)) == 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_are_optics_and_agree_with_density_and_value),
        cmocka_unit_test(values_are_reciprocal),
        cmocka_unit_test(energy_is_never_made),
        cmocka_unit_test(smooth_limit),
        cmocka_unit_test(total_internal_reflection),
        cmocka_unit_test(critical_angle_from_both_sides),
        cmocka_unit_test(smooth_surfaces_are_point_masses),
        cmocka_unit_test(equal_indices_are_no_surface),
        cmocka_unit_test(near_equal_indices_do_not_blow_up),
        cmocka_unit_test(thin_walls),
        cmocka_unit_test(compensation_restores_the_furnace),
        cmocka_unit_test(compensation_knows_two_roughnesses),
        cmocka_unit_test(compensation_is_a_factor),
        cmocka_unit_test(float_follows_double),
        cmocka_unit_test(special_numbers),
        cmocka_unit_test(unusable_parameters_make_an_invalid_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
