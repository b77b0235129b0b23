/* tools/numerics/albedo_error.c: the numbers of docs/multiple-scattering.md.
 *
 *     cc -O2 -Iinclude tools/numerics/albedo_error.c build/liblobe.a -lm -o albedo_error
 *     ./albedo_error [fits|furnace|ratios|colour]               # two minutes for all
 *
 * Fits and tables against the quadrature, public fits beside ours; the white furnace of both compensations
 * with each; rules for unequal roughnesses; the colour of both compensations against random walks. */
#include <lobe/lobe.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static const lobe_reflectance one = {LOBE_REFLECTANCE_ONE, 0, 0};

static const char *const g2_names[] = {"correlated", "separable"};

static lobe_microsurface with(lobe_microsurface s, double alpha_x, double alpha_y) {
    s.alpha_x = alpha_x;
    s.alpha_y = alpha_y;
    return s;
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

static double quadrature(lobe_microsurface s, double mu, double azimuth) {
    const lobe_effort effort =
        s.masking == LOBE_MASKING_SMITH ? LOBE_EFFORT_MEDIUM : LOBE_EFFORT_FINE;
    return lobe_albedo(s, one, toward(mu, azimuth), effort);
}

/* ---- Approximations for equal roughnesses ---------------------------------------------------- */

static double by_table(lobe_microsurface s, double mu) {
    return table(s, mu, 0);
}

static double average_by_table(lobe_microsurface s) {
    const float alpha = (float)s.alpha_x;
    return 1 -
           (double)lobe_albedo_prepare_f32(s.ndf, s.masking, s.g2, alpha, alpha).missing_average;
}

static double by_fit(lobe_microsurface s, double mu) {
    return 1 - lobe_albedo_fit_missing_f64(s.ndf, s.g2, s.alpha_x, mu);
}

static double average_by_fit(lobe_microsurface s) {
    return 1 - lobe_albedo_fit_missing_average_f64(s.ndf, s.g2, s.alpha_x);
}

static double polynomial(const double c[9], double x, double y) {
    const double x2 = x * x, y2 = y * y;
    return c[0] + c[1] * x + c[2] * y + c[3] * x * y + c[4] * x2 + c[5] * y2 + c[6] * x2 * y +
           c[7] * x * y2 + c[8] * x2 * y2;
}

/* The rational fit of MaterialX for F0 = F90 = 1. */
static double by_materialx(lobe_microsurface s, double mu) {
    static const double a[9] = {0.10031,  -0.63301,  9.74995,  -2.02075, 29.38247,
                                -8.24713, -26.51510, 19.98406, -5.41717};
    static const double b[9] = {0.93450,  -2.32352, 2.22823, -3.74584, 1.42450,
                                -0.76829, 1.43366,  0.29060, 0.62933};
    static const double c[9] = {1.0,      -1.76427,  8.26501,  11.54840, 28.99991,
                                -7.50867, -36.16186, 15.85408, 33.41550};
    static const double d[9] = {1.0,      0.22797,  15.93688,  -55.82466, 13.07919,
                                41.25882, 54.86775, 300.10923, -284.73288};
    return polynomial(a, mu, s.alpha_x) / polynomial(c, mu, s.alpha_x) +
           polynomial(b, mu, s.alpha_x) / polynomial(d, mu, s.alpha_x);
}

/* Kulla's numerical fit, second edition of the slides. */
static double by_kulla(lobe_microsurface s, double mu) {
    const double x = s.alpha_x;
    const double rough = -0.20277 + x * (2.772 + x * (-2.6175 + 0.73343 * x));
    const double angle =
        3.09507 + mu * (-9.11369 + mu * (15.8884 + mu * (-13.70343 + 4.51786 * mu)));
    return 1 - 1.4594 * x * mu * rough * angle;
}

static double average_by_kulla(lobe_microsurface s) {
    const double x = s.alpha_x;
    return 1 + x * (-0.113 + x * (-1.8695 + x * (2.2268 - 0.83397 * x)));
}

/* Sforza & Pellacini 2022, conductors; made for the separable G2. */
static double by_sforza(lobe_microsurface s, double u) {
    static const double n[10] = {1.0247217, -10.984229, 10.918318, 46.93353,  -54.779343,
                                 21.742077, -30.368898, 31.919222, -8.013965, -6.2407165};
    static const double d[10] = {1.0,       -10.218104, 10.955399, 44.08196,   -55.33452,
                                 21.437538, -23.744568, 33.265057, -7.9268975, -5.930959};
    const double r = sqrt(s.alpha_x);
    const double m[10] = {1, r, u, r * r, r * u, u * u, r * r * r, r * r * u, r * u * u, u * u * u};
    double above = 0, below = 0;
    for (int k = 0; k < 10; k++) {
        above += n[k] * m[k];
        below += d[k] * m[k];
    }
    return above / below;
}

/* `average`: NULL where none was published: then that of its E. */
static const struct approximation {
    const char *name;
    lobe_microsurface s;
    double (*e)(lobe_microsurface s, double mu);
    double (*average)(lobe_microsurface s);
} approximations[] = {
#define SMITH(ndf, g2)                                                                             \
    { LOBE_NDF_##ndf, LOBE_MASKING_SMITH, LOBE_G2_##g2, 0, 0 }
#define VCAVITY(ndf, g2)                                                                           \
    { LOBE_NDF_##ndf, LOBE_MASKING_VCAVITY, LOBE_G2_##g2, 0, 0 }
    {"table", SMITH(GGX, CORRELATED), by_table, average_by_table},
    {"fit", SMITH(GGX, CORRELATED), by_fit, average_by_fit},
    {"MaterialX", SMITH(GGX, CORRELATED), by_materialx, NULL},
    {"Kulla, slides", SMITH(GGX, CORRELATED), by_kulla, average_by_kulla},
    {"table", SMITH(GGX, SEPARABLE), by_table, average_by_table},
    {"fit", SMITH(GGX, SEPARABLE), by_fit, average_by_fit},
    {"Sforza, Pellacini", SMITH(GGX, SEPARABLE), by_sforza, NULL},
    {"table", SMITH(BECKMANN, CORRELATED), by_table, average_by_table},
    {"fit", SMITH(BECKMANN, CORRELATED), by_fit, average_by_fit},
    {"table", SMITH(BECKMANN, SEPARABLE), by_table, average_by_table},
    {"fit", SMITH(BECKMANN, SEPARABLE), by_fit, average_by_fit},
    {"table", VCAVITY(GGX, CORRELATED), by_table, average_by_table},
    {"table", VCAVITY(GGX, SEPARABLE), by_table, average_by_table},
    {"table", VCAVITY(BECKMANN, CORRELATED), by_table, average_by_table},
    {"table", VCAVITY(BECKMANN, SEPARABLE), by_table, average_by_table},
};
enum { APPROXIMATIONS = sizeof approximations / sizeof approximations[0] };

static void print_name(const struct approximation *a) {
    printf("| %s | %s %s | %s |", a->name, lobe_ndf_name(a->s.ndf), lobe_masking_name(a->s.masking),
           g2_names[a->s.g2]);
}

/* `least`: of the perceptual roughness and of the cosine. */
static void measure(const struct approximation *a, double least_r, double least_mu) {
    enum { STEPS = 32 };
    double worst = 0, furnace = 0;
    for (int i = 0; i < STEPS; i++)
        for (int j = 0; j < STEPS; j++) {
            const double r = least_r * pow(1 / least_r, i / (STEPS - 1.0)), alpha = r * r;
            const double mu = least_mu * pow(1 / least_mu, j / (STEPS - 1.0));
            const lobe_microsurface s = with(a->s, alpha, alpha);
            const double e = quadrature(s, mu, 0);
            worst = fmax(worst, fabs(a->e(s, mu) - e));
            furnace = fmax(furnace, fabs(e / a->e(s, mu) - 1));
        }
    printf(" %.1e | %.2g %% |", worst, 100 * furnace);
}

/* ---- White furnace ---------------------------------------------------------------------------- */

static const double alphas[] = {0.001, 0.01, 0.03, 0.1, 0.3, 0.5, 0.7, 1};
enum { ALPHAS = sizeof alphas / sizeof alphas[0] };

/* 1/pi * integral of (1 - E) cosine of the approximation: even steps of t, mu = t^4. */
static double missing_of(const struct approximation *a, lobe_microsurface s) {
    enum { STEPS = 400 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double t = (i + 0.5) / STEPS, t3 = t * t * t;
        sum += 8 * t3 * t3 * t / STEPS * (1 - a->e(s, t3 * t));
    }
    return sum;
}

/* Kulla & Conty's sum less 1, and Turquin's, largest over the cosine from 0.001. */
static void measure_furnace(const struct approximation *a, double alpha) {
    enum { STEPS = 31 };
    const lobe_microsurface s = with(a->s, alpha, alpha);
    const double lacks = missing_of(a, s);
    const double share = a->average ? lacks / (1 - a->average(s)) : 1;
    double kulla_conty = 0, turquin = 0;
    for (int j = 0; j < STEPS; j++) {
        const double mu = pow(10, -3 + 3.0 * j / (STEPS - 1)), e = quadrature(s, mu, 0);
        kulla_conty = fmax(kulla_conty, fabs(e + (1 - a->e(s, mu)) * share - 1));
        turquin = fmax(turquin, fabs(e / a->e(s, mu) - 1));
    }
    printf(" %.2g / %.2g |", 100 * kulla_conty, 100 * turquin);
}

static void print_furnaces(void) {
    printf("white furnace: largest error of Kulla & Conty / of Turquin in percent, cosine from "
           "0.001\n");
    printf("| | | |");
    for (int k = 0; k < ALPHAS; k++) printf(" %g |", alphas[k]);
    printf("\n");
    for (int k = 0; k < APPROXIMATIONS; k++) {
        print_name(&approximations[k]);
        for (int j = 0; j < ALPHAS; j++) measure_furnace(&approximations[k], alphas[j]);
        printf("\n");
        fflush(stdout);
    }
}

/* ---- Unequal roughnesses --------------------------------------------------------------------- */

static void measure_ratio(lobe_microsurface kind, double ratio) {
    double by_table = 0, by_toward = 0, by_mean = 0;
    for (int i = 0; i <= 12; i++)
        for (int j = 0; j <= 12; j++)
            for (int k = 0; k <= 6; k++) {
                const double mean = pow(10, -3 + i / 4.0), mu = pow(10, -3 + j / 4.0);
                const double ax = 2 * mean / (1 + 1 / ratio), ay = ax / ratio;
                const double azimuth = acos(0.0) * k / 6, c = cos(azimuth), s = sin(azimuth);
                const double e =
                    lobe_albedo(with(kind, ax, ay), one, toward(mu, azimuth), LOBE_EFFORT_MEDIUM);
                const double near = sqrt(ax * ax * c * c + ay * ay * s * s), middle = sqrt(ax * ay);
                by_table = fmax(by_table, fabs(e / table(with(kind, ax, ay), mu, azimuth) - 1));
                by_toward = fmax(by_toward, fabs(e / table(with(kind, near, near), mu, 0) - 1));
                by_mean = fmax(by_mean, fabs(e / table(with(kind, middle, middle), mu, 0) - 1));
            }
    printf(" %.2g, %.0f, %.0f |", 100 * by_table, 100 * by_toward, 100 * by_mean);
    fflush(stdout);
}

static void print_ratios(void) {
    const double ratios[] = {1.1, 1.5, 2, 3, 5, 10};
    printf("unequal roughnesses, largest error of E in percent: table, roughness toward the "
           "direction, "
           "sqrt(ax ay)\n");
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ndf++)
        for (int masking = 0; masking < LOBE_MASKING_COUNT; masking++)
            for (int g2 = 0; g2 < 2; g2++) {
                const lobe_microsurface kind = {(lobe_ndf)ndf, (lobe_masking)masking, (lobe_g2)g2,
                                                0, 0};
                printf("| %s %s | %s |", lobe_ndf_name(kind.ndf), lobe_masking_name(kind.masking),
                       g2_names[g2]);
                for (int k = 0; k < 6; k++) measure_ratio(kind, ratios[k]);
                printf("\n");
            }
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

static void measure_colour(lobe_ndf ndf, double alpha) {
    const lobe_microsurface s = {ndf, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, alpha, alpha};
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
        printf("| %s | %.1f | %s |", lobe_ndf_name(ndf), alpha, metals[metal]);
        double a[BANDS], b[BANDS];
        for (int k = 0; k < BANDS; k++) {
            const double truth = sum[metal * BANDS + k] / WALKS;
            compensated(s, laws[metal * BANDS + k], &a[k], &b[k]);
            printf(" %.4f", truth);
            a[k] = 100 * (a[k] / truth - 1);
            b[k] = 100 * (b[k] / truth - 1);
        }
        printf(" | %+.2f %+.2f %+.2f | %+.2f %+.2f %+.2f |\n", a[0], a[1], a[2], b[0], b[1], b[2]);
        fflush(stdout);
    }
}

static void print_fits(void) {
    printf("E: largest error and E/approximation - 1, perceptual roughness from 0.04 and cosine "
           "from 1/32; "
           "alpha and cosine from 0.001\n");
    for (int k = 0; k < APPROXIMATIONS; k++) {
        print_name(&approximations[k]);
        measure(&approximations[k], 0.04, 1.0 / 32);
        measure(&approximations[k], sqrt(1e-3), 1e-3);
        printf("\n");
        fflush(stdout);
    }
}

static void print_colours(void) {
    const double roughnesses[] = {0.1, 0.3, 0.5, 0.7, 1.0};
    printf("reflected share of even light, errors by band (650, 550, 450 nm)\n");
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ndf++)
        for (int k = 0; k < 5; k++) measure_colour((lobe_ndf)ndf, roughnesses[k]);
}

int main(int argc, char **argv) {
    const char *part = argc > 1 ? argv[1] : "";
    if (!*part || !strcmp(part, "fits")) print_fits();
    if (!*part || !strcmp(part, "furnace")) print_furnaces();
    if (!*part || !strcmp(part, "ratios")) print_ratios();
    if (!*part || !strcmp(part, "colour")) print_colours();
    return 0;
}
