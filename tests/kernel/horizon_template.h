/* tests/kernel/horizon_template.h: the horizon samplers' draws and densities. Before including: a
 * binding, and
 *   VECTOR_WO, VECTOR_PDF   largest |wo - reference| and relative error of the density
 *   SAME_PDF                the same between a draw's density and that of its own (m, wo, wi.m)
 *   SAME_PDF_WO             and that of its wo alone, times 1 + 1/(what cancels there)
 *   UNIT                    | |wo| - 1 | */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "horizon_methods.h"
#include "lobe/random.h"
#include "tests/vectors/horizon.h"

#include <inttypes.h>
#include <math.h>

static v3 v3_from(const double x[3]) {
    return v3_of((real)x[0], (real)x[1], (real)x[2]);
}

static double distance(v3 a, const double b[3]) {
    return hypot(hypot((double)a.x - b[0], (double)a.y - b[1]), (double)a.z - b[2]);
}

static void reference_vectors(void **state) {
    (void)state;
    double worst_wo = 0, worst_pdf = 0;
    for (size_t k = 0; k < sizeof horizon_vectors / sizeof *horizon_vectors; ++k) {
        const horizon_vector *r = &horizon_vectors[k];
        ggx_base g =
            base_with_floor(v3_from(r->wi), (real)r->alpha[0], (real)r->alpha[1], (real)r->delta);
        for (int j = 0; j < METHOD_COUNT; ++j) {
            horizon_any s = any_prepare((horizon_method)j, g);
            facet_draw d = any_draw(&s, (real)r->u[0], (real)r->u[1], (real)r->u[2]);
            double wo = distance(d.wo, r->drawn[j]), pdf = fabs((double)d.pdf / r->drawn[j][3] - 1);
            if (!(wo < VECTOR_WO) || !(pdf < VECTOR_PDF))
                fail_msg("row %zu %s: wo off by %.3g, pdf by %.3g", k, method_name[j], wo, pdf);
            worst_wo = fmax(worst_wo, wo);
            worst_pdf = fmax(worst_pdf, pdf);
        }
    }
    print_message("vectors: wo within %.2g, density within %.2g\n", worst_wo, worst_pdf);
}

static real unit(uint64_t k, int stream, int word) {
    return (real)lobe_random_unit_f32(lobe_random(31, (uint64_t)stream, k).word[word]);
}

/* Any direction; a fifth of them within 1e-4 of the horizon or of the normal. */
static v3 direction(uint64_t k, double lowest_z) {
    double z = lowest_z + (1 - lowest_z) * (double)unit(k, 0, 0);
    if (k % 5 == 1) z = (k % 2 ? 1 : -1) * pow(10, -6 * (double)unit(k, 0, 0));
    if (k % 5 == 2) z = 1 - pow(10, -8 * (double)unit(k, 0, 0)) * 0.01;
    if (z < lowest_z) z = lowest_z;
    double phi = k % 3 == 0 ? 0.5 * 3.141592653589793 * (double)(k % 4)
                            : 2 * 3.141592653589793 * (double)unit(k, 0, 1);
    double s = sqrt(1 - z * z);
    return v3_of((real)(s * cos(phi)), (real)(s * sin(phi)), (real)z);
}

static real roughness(uint64_t k, int word, double low, double high) {
    return (real)(low * pow(high / low, (double)unit(k, 1, word)));
}

/* u in [0, 1) with its ends. */
static real ends(uint64_t k, int word) {
    real u = unit(k, 2, word);
    switch ((k >> (2 * word)) % 16) {
    case 0:
        return R(0.0);
    case 1:
        return K_BELOW_ONE;
    case 2:
        return k_min(R(1.0) - u * R(1e-6), K_BELOW_ONE);
    case 3:
        return u * R(1e-6);
    default:
        return u;
    }
}

/* A draw's own pair gives its density back, whatever the angle; from wo alone m.i = 0 is a rim where the
 * density of the normals is divided by nothing, and straight back m itself is lost. */
static void density_of_a_draw(void **state) {
    (void)state;
    double worst_pair = 0, worst_wo = 0;
    for (uint64_t k = 0; k < 100000; ++k) {
        real ax = roughness(k, 0, 0.01, 3), ay = k % 4 == 0 ? ax : roughness(k, 1, 0.01, 3);
        ggx_base g = base_with_floor(direction(k, -0.9), ax, ay, (real)(k % 5) / R(4.0));
        horizon_any s = any_prepare((horizon_method)(k % METHOD_COUNT), g);
        facet_draw d = any_draw(&s, unit(k, 2, 0), R(0.999) * unit(k, 2, 1), unit(k, 2, 2));
        if (!(d.pdf > R(0.0))) continue;
        facet_pair pair = ggx_pair_of_wo(g, d.wo);
        facet_pair own = pair;
        own.m = d.m;
        own.cos_im = d.cos_im;
        own.d = ggx_d(g, d.m);
        double of_own = fabs((double)(any_pdf(&s, own) / d.pdf) - 1);
        double of_wo = fabs((double)(any_pdf(&s, pair) / d.pdf) - 1);
        double cancels = (double)(d.cos_im * (ax < ay ? ax : ay));
        double scaled = of_wo / (1 + 1 / cancels);
        if (!(of_own < SAME_PDF) || !(scaled < SAME_PDF_WO))
            fail_msg("%" PRIu64 " %s wi %g %g %g alpha %g %g: density off by %.3g, of wo %.3g", k,
                     method_name[s.method], (double)g.wi.x, (double)g.wi.y, (double)g.wi.z,
                     (double)ax, (double)ay, of_own, of_wo);
        worst_pair = fmax(worst_pair, of_own);
        worst_wo = fmax(worst_wo, scaled);
    }
    print_message("density again: within %.2g by m, %.2g (1 + 1/(alpha i.m)) by wo\n", worst_pair,
                  worst_wo);
}

/* 10^6 draws over all that a base admits: every one leaves, with a density and a weight. */
static void nothing_below_the_horizon(void **state) {
    (void)state;
    double worst_unit = 0, largest_weight = 0;
    for (uint64_t k = 0; k < 1000000; ++k) {
        bool harsh = k % 8 == 0;
        real ax = roughness(k, 0, harsh ? 1e-4 : 0.002, harsh ? 1e4 : 2);
        real ay = k % 4 == 0 ? ax : roughness(k, 1, harsh ? 1e-4 : 0.002, harsh ? 1e4 : 2);
        ggx_base g = base_with_floor(direction(k, -0.999), ax, ay, (real)(k % 5) / R(4.0));
        horizon_any s = any_prepare((horizon_method)(k / 3 % METHOD_COUNT), g);
        facet_draw d = any_draw(&s, ends(k, 0), ends(k, 1), ends(k, 2));
        double length = sqrt((double)v3_dot(d.wo, d.wo)) - sqrt((double)v3_dot(g.wi, g.wi));
        if (!(d.wo.z > R(0.0)) || !(d.pdf > R(0.0)) || !(d.weight > R(0.0)) ||
            !(d.pdf_m > R(0.0)) || !(d.m.z >= R(0.0)) || !(fabs(length) < UNIT))
            fail_msg("%" PRIu64
                     " %s wi %a %a %a alpha %a %a u %a %a: wo.z %g pdf %g weight %g |wo| 1 + %g",
                     k, method_name[s.method], (double)g.wi.x, (double)g.wi.y, (double)g.wi.z,
                     (double)ax, (double)ay, (double)ends(k, 0), (double)ends(k, 1), (double)d.wo.z,
                     (double)d.pdf, (double)d.weight, length);
        worst_unit = fmax(worst_unit, fabs(length));
        largest_weight = fmax(largest_weight, (double)d.weight);
    }
    print_message("10^6 draws: | |wo| - 1 | within %.2g, largest weight %.3g\n", worst_unit,
                  largest_weight);
}

/* Outside the useful set nothing is drawn; the normals' density is 4 i.m that of the directions. */
static void outside_is_zero(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 20000; ++k) {
        ggx_base g = base_with_floor(direction(k, -0.9), roughness(k, 0, 0.05, 2),
                                     roughness(k, 1, 0.05, 2), R(0.25));
        horizon_any s = any_prepare((horizon_method)(k % METHOD_COUNT), g);
        double z = (double)unit(k, 3, 0), phi = 6.283185307179586 * (double)unit(k, 3, 1);
        double r = sqrt(1 - z * z);
        facet_pair pair =
            ggx_pair_of_m(g, v3_of((real)(r * cos(phi)), (real)(r * sin(phi)), (real)z));
        real pdf = any_pdf(&s, pair), pdf_m = any_pdf_m(&s, pair);
        bool useful = pair.cos_im > R(0.0) && pair.wo.z > R(0.0);
        assert_true((pdf > R(0.0)) == useful);
        assert_true((pdf_m > R(0.0)) == useful);
        if (useful)
            assert_true(k_abs(pdf_m / (R(4.0) * pair.cos_im * pdf) - R(1.0)) < R(4.0) * K_EPS);
    }
}

/* Before Tokuyoshi 2021 the density from behind was (1 + i_z)/(1 - i_z) of what is drawn. */
static void previous_normalisation(void **state) {
    (void)state;
    v3 wi = v3_of(R(0.8), R(0.0), R(-0.6));
    facet_options options = facet_options_of(false, true);
    ggx_base biased = ggx_base_of(wi, R(0.4), R(0.7), options);
    ggx_base right = ggx_base_of(wi, R(0.4), R(0.7), facet_options_of(false, false));
    for (int j = 0; j < METHOD_COUNT; ++j) {
        horizon_any b = any_prepare((horizon_method)j, biased);
        horizon_any r = any_prepare((horizon_method)j, right);
        facet_draw x = any_draw(&b, R(0.3), R(0.4), R(0.5));
        facet_draw y = any_draw(&r, R(0.3), R(0.4), R(0.5));
        assert_true(k_abs(x.pdf / y.pdf - biased.density_bias) < R(8.0) * K_EPS);
        assert_true(k_abs(y.weight / x.weight - biased.density_bias) < R(8.0) * K_EPS);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_vectors), cmocka_unit_test(density_of_a_draw),
        cmocka_unit_test(nothing_below_the_horizon), cmocka_unit_test(outside_is_zero),
        cmocka_unit_test(previous_normalisation)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
