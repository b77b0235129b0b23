/* tests/render/test_coat.c: what a white dielectric reflects, by quadrature: never more than all, and
 * nearly all. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "render/material.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static surface surface_of(const coat_table *table, float roughness, float anisotropy, double cosine,
                          double azimuth, float color) {
    surface_options options = {.ggx = lobe_reflection_default_options(),
                               .coat = table,
                               .tint = lobe_coat_tint(table->ior, 1.0f, v3_all(1.0f))};
    frame shading = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double plane = sqrt(1 - cosine * cosine);
    vec3 wi = {(float)(plane * cos(azimuth)), (float)(plane * sin(azimuth)), (float)cosine};
    surface s;
    lobe_surface_make(&s, &options, shading, shading.z, wi, v3_all(color), 0.0f, roughness,
                      anisotropy, 0);
    return s;
}

static double value(const surface *s, double x, double y, double z) {
    float pdf;
    return (double)lobe_surface_value(s, (vec3){(float)x, (float)y, (float)z}, &pdf).x;
}

/* Nodes of the double exponential rule on (0, 1). */
enum { NODES = 33 };
static struct { double x, weight; } node[NODES];

static int make_nodes(void **state) {
    (void)state;
    for (int k = 0; k < NODES; ++k) {
        double t = 6.0 * (k + 0.5) / NODES - 3.0, e = PI / 2 * sinh(t);
        node[k].x = 1 / (1 + exp(-2 * e));
        node[k].weight = 6.0 / NODES * PI / 4 * cosh(t) / (cosh(e) * cosh(e));
    }
    return 0;
}

/* One turn of the slopes s = rho (ax cos psi, ay sin psi), m along (s, 1), whose reflection leaves:
 * |s - i_xy/i_z| <= 1/i_z. D cos dm = 2 rho drho/(1 + rho^2)^2 dpsi/2 pi. */
static double coat_along(const surface *s, double psi) {
    vec3 i = s->ggx.wi;
    double cx = (double)s->ggx.alpha_x * cos(psi), cy = (double)s->ggx.alpha_y * sin(psi);
    double mu = (double)i.z, ix = (double)i.x, iy = (double)i.y;
    double a = cx * cx + cy * cy, b = (cx * ix + cy * iy) / mu, root = sqrt(b * b + a);
    double last = b < 0 ? 1 / (root - b) : (root + b) / a;
    double length = asinh(last), sum = 0;
    for (int k = 0; k < NODES; ++k) {
        double rho = sinh(length * node[k].x), x = rho * cx, y = rho * cy;
        double n2 = 1 + x * x + y * y, im = mu + ix * x + iy * y, f = 2 * im / n2;
        if (!(f > mu)) continue;
        double r2 = 1 + rho * rho;
        double d = n2 * n2 / (PI * (double)s->ggx.alpha_x * (double)s->ggx.alpha_y * r2 * r2);
        double jacobian = 4 * im / d; /* im/mz over D mz / mz */
        sum += node[k].weight * length * 2 * rho / (r2 * sqrt(r2)) * jacobian *
               value(s, f * x - ix, f * y - iy, f - mu);
    }
    return sum;
}

/* The coat alone, what a black base leaves. Half vectors in float do not resolve a roughness below 0.1:
 * there in double. */
static double coat_energy(const surface *black, float roughness) {
    const lobe_reflection_f32 *g = &black->ggx;
    if (g->is_mirror) return (double)lobe_fresnel_dielectric_f32(COAT_IOR, g->wi.z);
    if (roughness < 0.1f) {
        lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED,
                               (double)g->alpha_x, (double)g->alpha_y};
        lobe_reflectance f = {LOBE_REFLECTANCE_DIELECTRIC, (double)COAT_IOR, 0};
        lobe_vec3_f64 wi = {(double)g->wi.x, (double)g->wi.y, (double)g->wi.z};
        return lobe_albedo(s, f, wi, LOBE_EFFORT_MEDIUM);
    }
    vec3 i = black->ggx.wi;
    double turn = atan2((double)(black->ggx.alpha_y * i.y), (double)(black->ggx.alpha_x * i.x));
    double sum = 0;
    for (int q = 0; q < 4; ++q)
        for (int k = 0; k < NODES; ++k)
            sum += node[k].weight / 4 * coat_along(black, turn + (q + node[k].x) * PI / 2);
    return sum;
}

/* The base alone: what white adds. */
static double base_energy(const surface *white, const surface *black) {
    enum { STEPS = 67, TURNS = 28 };
    double sum = 0;
    for (int j = 0; j < TURNS; ++j)
        for (int i = 0; i < STEPS; ++i) {
            double t = (i + 0.5) / STEPS, z = t * t, plane = sqrt(1 - z * z);
            double angle = 2 * PI * (j + 0.5) / TURNS;
            double x = plane * cos(angle), y = plane * sin(angle);
            double difference = value(white, x, y, z) - value(black, x, y, z);
            sum += difference * 2 * t * 2 * PI / (STEPS * TURNS);
        }
    return sum;
}

static double energy(const coat_table *table, float roughness, float anisotropy, double cosine,
                     double azimuth) {
    surface white = surface_of(table, roughness, anisotropy, cosine, azimuth, 1.0f);
    surface black = surface_of(table, roughness, anisotropy, cosine, azimuth, 0.0f);
    return coat_energy(&black, roughness) + base_energy(&white, &black);
}

/* Over roughness and cosine, crowded toward small ones. */
static void assert_energy(const coat_table *table, float anisotropy, int azimuths, double least) {
    enum { ROUGHNESSES = 13, COSINES = 6 };
    for (int r = 0; r < ROUGHNESSES; ++r)
        for (int c = 0; c < COSINES; ++c)
            for (int a = 0; a < azimuths; ++a) {
                float root = (float)r / (ROUGHNESSES - 1), roughness = root * root;
                double cosine = pow(10, -3.0 + 3.0 * c / (COSINES - 1));
                double azimuth = PI / 2 * (azimuths - 1 - a) / (azimuths - 0.999);
                double e = energy(table, roughness, anisotropy, cosine, azimuth);
                if (!(e < 1 + 1e-3 && e > least))
                    fail_msg("roughness %g, anisotropy %g, cosine %g, azimuth %g: %g",
                             (double)roughness, (double)anisotropy, cosine, azimuth, e);
            }
}

static const coat_table *table_of(lobe_g2 g2, int has_anisotropy) {
    return lobe_coat_table(LOBE_NDF_GGX, LOBE_MASKING_SMITH, g2, COAT_IOR, has_anisotropy);
}

static void isotropic_white_is_white(void **state) {
    (void)state;
    assert_energy(table_of(LOBE_G2_CORRELATED, 0), 0.0f, 1, 0.99);
    assert_energy(table_of(LOBE_G2_CORRELATED, 1), 0.0f, 1, 0.99);
}

static void anisotropic_white_is_nearly_white(void **state) {
    (void)state;
    const coat_table *table = table_of(LOBE_G2_CORRELATED, 1);
    assert_energy(table, 0.1f, 4, 0.99);
    assert_energy(table, 0.3f, 4, 0.99);
    assert_energy(table, -0.6f, 4, 0.985);
    assert_energy(table, 0.9f, 4, 0.95);
    assert_energy(table, 0.95f, 4, 0.95);
}

/* What is kept is what would be built. */
static void ready_table_is_reproduced(void **state) {
    (void)state;
    static coat_table built = {.ior = COAT_IOR};
    assert_true(lobe_coat_build(&built, LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, 1));
    const coat_table *ready = table_of(LOBE_G2_CORRELATED, 1);
    const float *a = &built.albedo[0][0][0][0], *b = &ready->albedo[0][0][0][0];
    for (size_t k = 0; k < sizeof built.albedo / sizeof *a; ++k)
        assert_true(b[k] >= a[k] - 1e-6f && b[k] < a[k] + 2e-5f);
    for (int r = 0; r < COAT_AVERAGE_ROWS; ++r)
        for (int k = 0; k < COAT_AVERAGE_RATIOS; ++k)
            assert_true(fabsf(built.average[r][k] - ready->average[r][k]) < 1e-6f);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(ready_table_is_reproduced),
                                       cmocka_unit_test(isotropic_white_is_white),
                                       cmocka_unit_test(anisotropic_white_is_nearly_white)};
    return cmocka_run_group_tests(tests, make_nodes, NULL);
}
