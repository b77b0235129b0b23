/* tests/kernel/dielectric_template.h: masking through a surface and refraction at a facet, against long
 * double. Before including: a binding, and BETA_ERROR and LIGHT_ERROR, relative. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "kernel/dielectric_masking.h"
#include "kernel/refract.h"
#include "lobe/random.h"

#include <math.h>

static double uniform(uint64_t k, int word) {
    return lobe_random_unit_f32(lobe_random(6, 0, k).word[word]);
}

static void assert_close(double value, double exact, double error, const char *what, double x,
                         double y) {
    if (!(fabs(value - exact) <= error * fabs(exact)))
        fail_msg("%s(%g, %g) = %.17g, exactly %.17g", what, x, y, value, exact);
}

/* B by the library's log Gamma, where the result is not lost below 1e-6 of its largest factor. */
static void beta_is_the_beta_function(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 200000; ++k) {
        real a = (real)pow(10, -4 + 9 * uniform(k, 0)), b = (real)pow(10, -4 + 9 * uniform(k, 1));
        long double logs = lgammal(1 + (long double)a) + lgammal(1 + (long double)b);
        double exact = (double)expl(logs - lgammal(2 + (long double)a + (long double)b));
        if (exact * (1 + fmax(a, b)) < 1e-6) continue;
        assert_close(dielectric_beta(a, b), exact, BETA_ERROR, "beta", a, b);
        assert_true(dielectric_beta(a, b) == dielectric_beta(b, a));
    }
    for (int a = 0; a < 60; ++a)
        assert_close(dielectric_beta((real)a, R(0.0)), 1.0 / (1 + a), BETA_ERROR, "beta", a, 0);
}

/* Also beyond every range, and never more than the separable form. */
static void shadowing_is_a_share(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 100000; ++k) {
        double z = pow(10, -9 * uniform(k, 0)), w = pow(10, -9 * uniform(k, 1));
        v3 wi = v3_of((real)sqrt(1 - z * z), R(0.0), (real)z);
        v3 wo = v3_of(R(0.0), (real)sqrt(1 - w * w), (real)-w);
        real a = (real)pow(10, -4 + 5 * uniform(k, 2)), b = (real)pow(10, -4 + 5 * uniform(k, 3));
        real separable = dielectric_shadowing(wi, wo, a, b, true);
        real correlated = dielectric_shadowing(wi, wo, a, b, false);
        assert_true(correlated >= R(0.0) && separable <= R(1.0));
        assert_true(correlated <= separable * (1 + R(2.0) * (real)BETA_ERROR));
    }
}

/* g, bend, F and T of an index that may be next to 1, from both sides. */
static void light_at_a_facet(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 200000; ++k) {
        real step = (real)((k & 1 ? 1 : -0.5) * pow(10, -5 * uniform(k, 0)));
        real ior = R(1.0) + step;
        bool inside = k & 2;
        real c = (real)uniform(k, 1);
        long double eta = inside ? 1 / (long double)ior : (long double)ior;
        long double n = ior, gap = (n - 1) * (n + 1);
        if (inside) gap = -gap / (n * n);
        long double g2 = gap + (long double)c * c;
        /* next to the critical angle g is the root of a difference */
        if (fabsl(g2) < 1e-3L * c * c) continue;
        refract_light l = refract_at(refract_index_of(ior, inside), c);
        if (g2 < 0) {
            assert_true(l.reflectance == R(1.0) && l.transmittance == R(0.0));
            continue;
        }
        long double g = sqrtl(g2), s = gap / ((g + c) * (g + c));
        long double p = (g - eta * eta * c) / (g + eta * eta * c);
        long double t =
            2 * c * g *
            (1 / ((g + c) * (g + c)) + eta * eta / ((g + eta * eta * c) * (g + eta * eta * c)));
        double room = LIGHT_ERROR * (double)fmaxl(1, c * c / g2);
        assert_close(l.g, (double)g, room, "g", ior, c);
        assert_close(l.bend, (double)(gap / (g + c)), room, "bend", ior, c);
        assert_close(l.transmittance, (double)t, room, "T", ior, c);
        assert_true(fabs(l.reflectance - (double)((s * s + p * p) / 2)) <= room);
        assert_true(fabs(l.reflectance + l.transmittance - 1) <= room);
    }
}

/* The half vector of a pair that was refracted is the normal that refracted it. */
static void half_vector_inverts_refraction(void **state) {
    (void)state;
    for (uint64_t k = 0; k < 100000; ++k) {
        real ior = (real)(1 + (k & 1 ? 1.5 : -0.5) * pow(10, -3 * uniform(k, 0)));
        double phi = 6.283185307179586 * uniform(k, 1), c = 0.2 + 0.8 * uniform(k, 2);
        v3 m = v3_of(R(0.6), R(0.0), R(0.8));
        double s = sqrt(1 - c * c);
        /* i at the angle acos(c) from m */
        v3 across = v3_of(R(0.8), R(0.0), R(-0.6));
        v3 i = v3_combine(m, (real)c, across, (real)(s * cos(phi)), v3_of(R(0.0), R(1.0), R(0.0)),
                          (real)(s * sin(phi)));
        refract_index n = refract_index_of(ior, k & 2);
        refract_light l = refract_at(n, v3_dot(i, m));
        if (l.g < R(0.05)) continue;
        v3 h = v3_normalize(refract_half_vector(n, i, refract_out(n, l, i, m)));
        double room = 16 * K_EPS / fabs((double)ior - 1);
        assert_true(fabs((double)(h.x - m.x)) < room && fabs((double)(h.y - m.y)) < room);
        assert_true(fabs((double)(h.z - m.z)) < room);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beta_is_the_beta_function), cmocka_unit_test(shadowing_is_a_share),
        cmocka_unit_test(light_at_a_facet), cmocka_unit_test(half_vector_inverts_refraction)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
