/* tools/numerics/dielectric_energy.c: the table of lib/dielectric_energy.c, and its error.
 *
 *     cc -O2 -ffp-contract=off -I. tools/numerics/dielectric_energy.c -lm -o dielectric_energy
 *     ./dielectric_energy >lib/dielectric_energy.inc              some ten seconds
 *     cc -O2 -ffp-contract=off -I. -Iinclude -DMEASURE tools/numerics/dielectric_energy.c \
 *         lib/dielectric_energy.c build/liblobe.a -lm -o dielectric_error && ./dielectric_error
 *
 * Each entry is the mean over a regular square of (u1, u2) of what the facets reflect and transmit
 * properly: the choice between the two, u3, is integrated exactly. */
#include "lib/dielectric_energy.h"
#include "dielectric_facets.h"

#include <math.h>
#include <stdio.h>

enum { SIDE = 40, FINE_SIDE = 120 };

/* The mean over a regular square. The isotropic surface is the same on both sides of the plane of incidence: half
 * of the azimuths. */
static double energy(ggx_dielectric s, int side) {
    double sum = 0;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < 2 * side; ++j)
            sum += facet_energy(&s, (i + 0.5) / (2 * side), (j + 0.5) / (2 * side));
    return sum / (2.0 * side * side);
}

#ifndef MEASURE

static double absolute(double y, double alpha) {
    return fmin(y * alpha / (1 + alpha - y), 1);
}

static double entry(int separable, int row, int column, int cell) {
    double r = (double)column / (LOBE_ENERGY_ALPHAS - 1);
    double alpha = fmax(r * r, LEAST_ALPHA);
    double step = (double)(row - (LOBE_ENERGY_INDICES - 1)) / (LOBE_ENERGY_INDICES - 1);
    double s = absolute(fabs(step), alpha);
    double n = 1 + 2 * fmax(s * s, 1e-10); /* equal indices are approached, not reached */
    double cosine = absolute((double)cell / (LOBE_ENERGY_COSINES - 1), alpha);
    return energy(model(0, cosine, alpha, alpha, step < 0 ? 1 / n : n, separable), SIDE);
}

int main(void) {
    printf("/* By tools/numerics/dielectric_energy.c. */\n");
    for (int separable = 0; separable < 2; ++separable)
        for (int row = 0; row < 2 * LOBE_ENERGY_INDICES - 1; ++row)
            for (int column = 0; column < LOBE_ENERGY_ALPHAS; ++column)
                for (int cell = 0; cell < LOBE_ENERGY_COSINES; ++cell) {
                    double e = entry(separable, row, column, cell);
                    printf("%.0f,%s", 65535 * sqrt(fmin(e, 1)), cell % 16 == 15 ? "\n" : "");
                }
    return 0;
}

#else

#include <lobe/random.h>

enum { PLACES = 20000 };

typedef struct worst {
    double error, at[4];
    int above;
} worst;

static void keep(worst *w, double error, const double at[4]) {
    w->above += error > 0.01;
    if (!(error > w->error)) return;
    w->error = error;
    for (int k = 0; k < 4; ++k) w->at[k] = at[k];
}

/* Roughness uniform in its root, cosine uniform or in its logarithm, the index in sqrt(n - 1). */
static void place(uint64_t k, double *cosine, double *alpha, double *eta) {
    lobe_random4 r = lobe_random(4, 0, k);
    double u = lobe_random_unit_f32(r.word[0]);
    double root = lobe_random_unit_f32(r.word[1]);
    double s = lobe_random_unit_f32(r.word[2]);
    *cosine = k % 3 != 0 ? fmax(u, 1e-3) : pow(10, -3 * u);
    *alpha = fmax(root * root, LEAST_ALPHA);
    double n = 1 + (k % 4 != 0 ? 2 * s * s : 2 * pow(10, -6 * s));
    *eta = r.word[3] & 1 ? 1 / n : n;
}

/* Far from equal indices, not grazing, and the rest. */
static void measure_isotropic(void) {
    static const char *const NAMES[3] = {"n >= 1.1", "n < 1.1, cosine >= 0.1",
                                         "n < 1.1, cosine < 0.1"};
    worst w[3] = {{0}};
    int count[3] = {0};
    for (uint64_t k = 0; k < PLACES; ++k) {
        double cosine, alpha, eta;
        place(k, &cosine, &alpha, &eta);
        int separable = (int)(k & 1);
        double e = energy(model(0, cosine, alpha, alpha, eta, separable), FINE_SIDE);
        double t = lobe_dielectric_energy((float)cosine, (float)alpha, (float)eta, separable);
        int kind = fmax(eta, 1 / eta) >= 1.1 ? 0 : cosine >= 0.1 ? 1 : 2;
        double at[4] = {cosine, alpha, eta, separable};
        keep(&w[kind], fabs(e / t - 1), at);
        count[kind] += 1;
    }
    for (int k = 0; k < 3; ++k)
        printf("%-24s worst %.4f at cosine %.4g alpha %.4g eta %.5g separable %g; %d of %d above "
               "0.01\n",
               NAMES[k], w[k].error, w[k].at[0], w[k].at[1], w[k].at[2], w[k].at[3], w[k].above,
               count[k]);
}

int main(void) {
    measure_isotropic();
    return 0;
}

#endif
