/* tools/numerics/albedo_error.c: the numbers of docs/multiple-scattering.md.
 *
 *     cc -O2 -Iinclude tools/numerics/albedo_error.c build/liblobe.a -lm -o albedo_error
 *     ./albedo_error                                            # a minute
 *
 * Fits and tables against the quadrature, public fits beside ours; rules for unequal roughnesses; the
 * colour of both compensations against random walks. */
#include <lobe/lobe.h>

#include <math.h>
#include <stdio.h>

static const lobe_reflectance one = {LOBE_REFLECTANCE_ONE, 0, 0};

static lobe_microsurface surface(lobe_g2 g2, double alpha_x, double alpha_y) {
    return (lobe_microsurface){LOBE_NDF_GGX, LOBE_MASKING_SMITH, g2, alpha_x, alpha_y};
}

static lobe_vec3_f64 toward(double mu, double azimuth) {
    const double plane = sqrt(fmax(1 - mu * mu, 0));
    return (lobe_vec3_f64){plane * cos(azimuth), plane * sin(azimuth), mu};
}

static double table(lobe_microsurface s, double mu, double azimuth) {
    const lobe_albedo_f32 a =
        lobe_albedo_prepare_f32(s.ndf, s.masking, s.g2, (float)s.alpha_x, (float)s.alpha_y);
    const lobe_vec3_f64 w = toward(mu, azimuth);
    return 1 -
           (double)lobe_albedo_missing_f32(&a, (lobe_vec3_f32){(float)w.x, (float)w.y, (float)w.z});
}

/* ---- Approximations for equal roughnesses ---------------------------------------------------- */

static double by_table_correlated(double alpha, double mu) {
    return table(surface(LOBE_G2_CORRELATED, alpha, alpha), mu, 0);
}

static double by_table_separable(double alpha, double mu) {
    return table(surface(LOBE_G2_SEPARABLE, alpha, alpha), mu, 0);
}

static double by_fit_correlated(double alpha, double mu) {
    return 1 - lobe_albedo_fit_missing_f64(LOBE_G2_CORRELATED, alpha, mu);
}

static double by_fit_separable(double alpha, double mu) {
    return 1 - lobe_albedo_fit_missing_f64(LOBE_G2_SEPARABLE, alpha, mu);
}

static double polynomial(const double c[9], double x, double y) {
    const double x2 = x * x, y2 = y * y;
    return c[0] + c[1] * x + c[2] * y + c[3] * x * y + c[4] * x2 + c[5] * y2 + c[6] * x2 * y +
           c[7] * x * y2 + c[8] * x2 * y2;
}

/* The rational fit of MaterialX for F0 = F90 = 1. */
static double by_materialx(double alpha, double mu) {
    static const double a[9] = {0.10031,  -0.63301,  9.74995,  -2.02075, 29.38247,
                                -8.24713, -26.51510, 19.98406, -5.41717};
    static const double b[9] = {0.93450,  -2.32352, 2.22823, -3.74584, 1.42450,
                                -0.76829, 1.43366,  0.29060, 0.62933};
    static const double c[9] = {1.0,      -1.76427,  8.26501,  11.54840, 28.99991,
                                -7.50867, -36.16186, 15.85408, 33.41550};
    static const double d[9] = {1.0,      0.22797,  15.93688,  -55.82466, 13.07919,
                                41.25882, 54.86775, 300.10923, -284.73288};
    return polynomial(a, mu, alpha) / polynomial(c, mu, alpha) +
           polynomial(b, mu, alpha) / polynomial(d, mu, alpha);
}

/* Kulla's numerical fit, second edition of the slides. */
static double by_kulla(double x, double mu) {
    const double rough = -0.20277 + x * (2.772 + x * (-2.6175 + 0.73343 * x));
    const double angle =
        3.09507 + mu * (-9.11369 + mu * (15.8884 + mu * (-13.70343 + 4.51786 * mu)));
    return 1 - 1.4594 * x * mu * rough * angle;
}

/* Sforza & Pellacini 2022, conductors; made for the separable G2. */
static double by_sforza(double alpha, double u) {
    static const double n[10] = {1.0247217, -10.984229, 10.918318, 46.93353,  -54.779343,
                                 21.742077, -30.368898, 31.919222, -8.013965, -6.2407165};
    static const double d[10] = {1.0,       -10.218104, 10.955399, 44.08196,   -55.33452,
                                 21.437538, -23.744568, 33.265057, -7.9268975, -5.930959};
    const double r = sqrt(alpha);
    const double m[10] = {1, r, u, r * r, r * u, u * u, r * r * r, r * r * u, r * u * u, u * u * u};
    double above = 0, below = 0;
    for (int k = 0; k < 10; k++) {
        above += n[k] * m[k];
        below += d[k] * m[k];
    }
    return above / below;
}

static const struct approximation {
    const char *name;
    lobe_g2 g2;
    double (*e)(double alpha, double mu);
} approximations[] = {
    {"table", LOBE_G2_CORRELATED, by_table_correlated},
    {"fit", LOBE_G2_CORRELATED, by_fit_correlated},
    {"MaterialX", LOBE_G2_CORRELATED, by_materialx},
    {"Kulla, slides", LOBE_G2_CORRELATED, by_kulla},
    {"table", LOBE_G2_SEPARABLE, by_table_separable},
    {"fit", LOBE_G2_SEPARABLE, by_fit_separable},
    {"Sforza, Pellacini", LOBE_G2_SEPARABLE, by_sforza},
};

/* `least`: of the perceptual roughness and of the cosine. */
static void measure(const struct approximation *a, double least_r, double least_mu) {
    enum { STEPS = 48 };
    double mean = 0, worst = 0, furnace = 0;
    for (int i = 0; i < STEPS; i++)
        for (int j = 0; j < STEPS; j++) {
            const double r = least_r * pow(1 / least_r, i / (STEPS - 1.0)), alpha = r * r;
            const double mu = least_mu * pow(1 / least_mu, j / (STEPS - 1.0));
            const double e =
                lobe_albedo(surface(a->g2, alpha, alpha), one, toward(mu, 0), LOBE_EFFORT_MEDIUM);
            const double error = fabs(a->e(alpha, mu) - e);
            mean += error / (STEPS * STEPS);
            worst = fmax(worst, error);
            furnace = fmax(furnace, fabs(e / a->e(alpha, mu) - 1));
        }
    printf("  %-18s %-11s mean %.1e  largest %.1e  E/approximation - 1 %.2g %%\n", a->name,
           a->g2 == LOBE_G2_CORRELATED ? "correlated" : "separable", mean, worst, 100 * furnace);
}

/* ---- Unequal roughnesses --------------------------------------------------------------------- */

static void measure_ratio(double ratio) {
    double by_table = 0, by_toward = 0, by_mean = 0;
    for (int i = 0; i <= 12; i++)
        for (int j = 0; j <= 12; j++)
            for (int k = 0; k <= 6; k++) {
                const double mean = pow(10, -3 + i / 4.0), mu = pow(10, -3 + j / 4.0);
                const double ax = 2 * mean / (1 + 1 / ratio), ay = ax / ratio;
                const double azimuth = acos(0.0) * k / 6, c = cos(azimuth), s = sin(azimuth);
                const double e = lobe_albedo(surface(LOBE_G2_CORRELATED, ax, ay), one,
                                             toward(mu, azimuth), LOBE_EFFORT_MEDIUM);
                const double near = sqrt(ax * ax * c * c + ay * ay * s * s), middle = sqrt(ax * ay);
                const lobe_g2 g2 = LOBE_G2_CORRELATED;
                by_table = fmax(by_table, fabs(e / table(surface(g2, ax, ay), mu, azimuth) - 1));
                by_toward = fmax(by_toward, fabs(e / table(surface(g2, near, near), mu, 0) - 1));
                by_mean = fmax(by_mean, fabs(e / table(surface(g2, middle, middle), mu, 0) - 1));
            }
    printf(
        "  %4.1f:1  table %.2g %%  roughness toward the direction %.0f %%  sqrt(ax ay) %.0f %%\n",
        ratio, 100 * by_table, 100 * by_toward, 100 * by_mean);
}

/* ---- Colour ---------------------------------------------------------------------------------- */

/* n, k near 650, 550 and 450 nm, rounded. */
enum { METALS = 6, BANDS = 3, LAWS = METALS * BANDS, WALKS = 1000000 };
static const char *const metals[METALS] = {"gold",   "copper", "aluminium",
                                           "silver", "iron",   "titanium"};
static const double indices[LAWS][2] = {
    {0.17, 3.40}, {0.42, 2.35}, {1.37, 1.77}, {0.22, 3.60}, {1.01, 2.58}, {1.17, 2.36},
    {1.50, 7.80}, {0.96, 6.69}, {0.62, 5.47}, {0.15, 4.10}, {0.12, 3.45}, {0.15, 2.48},
    {2.90, 3.10}, {2.93, 2.99}, {2.60, 2.76}, {2.76, 3.82}, {2.54, 3.43}, {2.27, 3.04}};

/* By both compensations, averaged over directions by the cosine: by the midpoint rule in t, mu = t^4. */
static void compensated(lobe_microsurface s, lobe_reflectance f, double *kulla_conty,
                        double *turquin) {
    enum { STEPS = 40 };
    const double lacks = 1 - lobe_albedo_average(s, one, LOBE_EFFORT_MEDIUM);
    const double f_ms = lobe_multiscatter_fms_f64(lobe_reflectance_average(f), lacks);
    *kulla_conty = f_ms * lacks;
    *turquin = 0;
    for (int i = 0; i < STEPS; i++) {
        const double t = (i + 0.5) / STEPS, t3 = t * t * t, weight = 8 * t3 * t3 * t / STEPS;
        const lobe_vec3_f64 wi = toward(t3 * t, 0);
        const double e = lobe_albedo(s, one, wi, LOBE_EFFORT_MEDIUM);
        const double first = lobe_albedo(s, f, wi, LOBE_EFFORT_MEDIUM);
        *kulla_conty += weight * first;
        *turquin +=
            weight * first * lobe_multiscatter_turquin_f64(lobe_reflectance_at(f, 1), 1 - e);
    }
}

static void measure_colour(double alpha) {
    const lobe_microsurface s = surface(LOBE_G2_CORRELATED, alpha, alpha);
    lobe_reflectance laws[LAWS];
    double sum[LAWS] = {0}, weights[LAWS];
    for (int k = 0; k < LAWS; k++)
        laws[k] = (lobe_reflectance){LOBE_REFLECTANCE_CONDUCTOR, indices[k][0], indices[k][1]};
    for (int i = 0; i < WALKS; i++) {
        const double mu = sqrt((i + 0.5) / WALKS);
        lobe_walk_sample(s, laws, LAWS, toward(mu, 0), 1, (uint64_t)i, 10000, weights);
        for (int k = 0; k < LAWS; k++) sum[k] += weights[k];
    }
    for (int metal = 0; metal < METALS; metal++) {
        printf("  alpha %.1f %-9s walk", alpha, metals[metal]);
        double a[BANDS], b[BANDS];
        for (int k = 0; k < BANDS; k++) {
            const double truth = sum[metal * BANDS + k] / WALKS;
            compensated(s, laws[metal * BANDS + k], &a[k], &b[k]);
            printf(" %.4f", truth);
            a[k] = 100 * (a[k] / truth - 1);
            b[k] = 100 * (b[k] / truth - 1);
        }
        printf("  Kulla-Conty %+.2f %+.2f %+.2f %%  Turquin %+.2f %+.2f %+.2f %%\n", a[0], a[1],
               a[2], b[0], b[1], b[2]);
    }
}

int main(void) {
    enum { COUNT = sizeof approximations / sizeof approximations[0] };
    printf("E, perceptual roughness from 0.04, cosine from 1/32\n");
    for (int k = 0; k < COUNT; k++) measure(&approximations[k], 0.04, 1.0 / 32);
    printf("E, alpha and cosine from 0.001\n");
    for (int k = 0; k < COUNT; k++) measure(&approximations[k], sqrt(1e-3), 1e-3);
    printf("unequal roughnesses, largest error of E\n");
    const double ratios[] = {1.1, 1.5, 2, 3, 5, 10};
    for (int k = 0; k < 6; k++) measure_ratio(ratios[k]);
    printf("reflected share of even light, errors by band (650, 550, 450 nm)\n");
    const double alphas[] = {0.1, 0.3, 0.5, 0.7, 1.0};
    for (int k = 0; k < 5; k++) measure_colour(alphas[k]);
    return 0;
}
