/* tools/numerics/dielectric_turned.c: the table of lib/dielectric_turned.c, and its error.
 *
 *     cc -O2 -fopenmp -ffp-contract=off -I. tools/numerics/dielectric_turned.c -lm -o dielectric_turned
 *     ./dielectric_turned >lib/dielectric_turned.inc              some twenty seconds of processor time
 *     cc -O2 -fopenmp -ffp-contract=off -I. -Iinclude -DMEASURE tools/numerics/dielectric_turned.c build/liblobe.a \
 *         -lm -o turned_error && ./turned_error
 *
 * The mean over the visible normals: u1 by the midpoint rule, u2 by Gauss's in x, u2 = x^2 (3 - 2 x). */
#include "dielectric_facets.h"

#include "lib/dielectric_turned.h"

#include <stdio.h>

enum { NODES = 24, TURNS = 48 };

static double nodes[NODES], weights[NODES]; /* on (0, 1) */

static void make_nodes(void) {
    for (int i = 0; i < NODES; ++i) {
        double x = cos(acos(-1.0) * (i + 0.75) / (NODES + 0.5)), slope = 1;
        for (int step = 0; step < 50; ++step) {
            double before = 1, p = x;
            for (int k = 2; k <= NODES; ++k) {
                double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = NODES * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        nodes[i] = 0.5 * (1 - x);
        weights[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

/* A surface that is symmetric about the plane of incidence needs half of the turn. */
static double energy_of(ggx_dielectric s, int turns, int symmetric) {
    double sum = 0;
    for (int i = 0; i < turns; ++i)
        for (int j = 0; j < NODES; ++j) {
            double x = nodes[j], u1 = (i + 0.5) / turns;
            sum += weights[j] * 6 * x * (1 - x) *
                   facet_energy(&s, symmetric ? 0.5 * u1 : u1, x * x * (3 - 2 * x));
        }
    return sum / turns;
}

#ifndef MEASURE

/* E of unequal roughnesses over that of the round surface. */
static double ratio_of(double cosine, double wide, double narrow, double share, double eta,
                       int separable) {
    double single = lobe_turned_single(wide, narrow, share, (1 - cosine) * (1 + cosine));
    double azimuth = acos(sqrt(share));
    return energy_of(model(azimuth, cosine, wide, narrow, eta, separable), TURNS, 0) /
           energy_of(model(0, cosine, single, single, eta, separable), TURNS / 2, 1);
}

static double absolute(double y, double alpha) {
    return fmin(y * alpha / (1 + alpha - y), 1);
}

/* A node of the five axes. */
static double entry(int separable, int row, int column, int alpha, int ratio, int azimuth) {
    double root = (double)alpha / (LOBE_TURNED_ALPHAS - 1);
    double wide = fmax(root * root, LEAST_ALPHA);
    double part =
        LOBE_TURNED_LEAST_ROOT + (1 - LOBE_TURNED_LEAST_ROOT) * ratio / (LOBE_TURNED_RATIOS - 1);
    double narrow = fmax(wide * part * part, LEAST_ALPHA);
    double turn = (double)azimuth / (LOBE_TURNED_AZIMUTHS - 1);
    double toward = pow(sqrt(narrow) + (sqrt(wide) - sqrt(narrow)) * turn, 2);
    double difference = wide * wide - narrow * narrow;
    double share =
        difference > 0 ? fmin(fmax((toward * toward - narrow * narrow) / difference, 0), 1) : 0;
    double step = (double)(row - (LOBE_TURNED_INDICES - 1)) / (LOBE_TURNED_INDICES - 1);
    double s = absolute(fabs(step), toward);
    double n = 1 + 2 * fmax(s * s, 1e-10); /* equal indices are approached, not reached */
    double cosine = fmax(absolute((double)column / (LOBE_TURNED_COSINES - 1), toward), 1e-6);
    return ratio_of(cosine, wide, narrow, share, step < 0 ? 1 / n : n, separable);
}

static lobe_turned_table table;

static void fill(int separable, int row) {
    for (int c = 0; c < LOBE_TURNED_COSINES; ++c)
        for (int a = 0; a < LOBE_TURNED_ALPHAS; ++a)
            for (int r = 0; r < LOBE_TURNED_RATIOS - 1; ++r)
                for (int z = 0; z < LOBE_TURNED_AZIMUTHS; ++z)
                    table[separable][row][c][a][r][z] =
                        (int16_t)lrint((entry(separable, row, c, a, r, z) - 1) / LOBE_TURNED_STEP);
}

int main(void) {
    make_nodes();
#pragma omp parallel for collapse(2) schedule(dynamic)
    for (int separable = 0; separable < 2; ++separable)
        for (int row = 0; row < LOBE_TURNED_ROWS; ++row) fill(separable, row);
    printf("/* By tools/numerics/dielectric_turned.c. */\n");
    for (int separable = 0; separable < 2; ++separable) {
        printf("{");
        for (int row = 0; row < LOBE_TURNED_ROWS; ++row) {
            printf("{");
            for (int c = 0; c < LOBE_TURNED_COSINES; ++c) {
                printf("{");
                for (int a = 0; a < LOBE_TURNED_ALPHAS; ++a) {
                    printf("{");
                    for (int r = 0; r < LOBE_TURNED_RATIOS - 1; ++r) {
                        printf("{");
                        for (int z = 0; z < LOBE_TURNED_AZIMUTHS; ++z)
                            printf("%d,", table[separable][row][c][a][r][z]);
                        printf("},");
                    }
                    printf("},\n");
                }
                printf("},");
            }
            printf("},\n");
        }
        printf("},\n");
    }
    return 0;
}

#else

#include <lobe/dielectric.h>
#include <lobe/random.h>

enum { PLACES = 3000, FINE_TURNS = 96 };

typedef struct worst {
    double error, at[4], squares;
    int above, count;
} worst;

/* |R + T - 1| through the library; 0 where nothing was asked. */
static double error_at(double cosine, double alpha, double narrow, double eta, double azimuth,
                       int separable) {
    ggx_dielectric s = model(azimuth, cosine, alpha, narrow, eta, separable);
    lobe_vec3_f64 wi = {s.caps.cap.g.wi.x, s.caps.cap.g.wi.y, s.caps.cap.g.wi.z * s.side.turn};
    lobe_dielectric_options options = lobe_dielectric_default_options();
    options.g2 = separable ? LOBE_G2_SEPARABLE : LOBE_G2_CORRELATED;
    options.compensate = 1;
    lobe_dielectric_f64 d =
        lobe_dielectric_prepare_f64(options, wi, alpha, narrow, eta < 1 ? 1 / eta : eta);
    return fabs(energy_of(s, FINE_TURNS, 0) * d.energy_factor - 1);
}

/* Roughness uniform in its root, the index in sqrt(n - 1) or its logarithm, cosine uniform or in its logarithm. */
static void measure(double ratio) {
    static const char *const NAMES[] = {"n >= 1.1, cosine >= 0.02", "n >= 1.1, cosine < 0.02",
                                        "n < 1.1, cosine >= 0.1"};
    worst w[3] = {{0}};
    for (uint64_t k = 0; k < PLACES; ++k) {
        lobe_random4 r = lobe_random(4, 0, k), q = lobe_random(4, 1, k);
        double u = lobe_random_unit_f32(r.word[0]), s = lobe_random_unit_f32(r.word[2]);
        double root = lobe_random_unit_f32(r.word[1]), alpha = fmax(root * root, LEAST_ALPHA);
        double cosine = k % 3 != 0 ? fmax(u, 1e-3) : pow(10, -3 * u);
        double n = 1 + (k % 4 != 0 ? 2 * s * s : 2 * pow(10, -6 * s));
        double azimuth = 6.283185307179586 * lobe_random_unit_f32(q.word[0]);
        int kind = n >= 1.1 ? cosine < 0.02 : cosine >= 0.1 ? 2 : -1;
        if (kind < 0) continue;
        double eta = r.word[3] & 1 ? 1 / n : n;
        double error = error_at(cosine, alpha, alpha / ratio, eta, azimuth, (int)(k & 1));
        w[kind].count += 1;
        w[kind].above += error > 0.01;
        w[kind].squares += error * error;
        if (!(error > w[kind].error)) continue;
        w[kind].error = error;
        w[kind].at[0] = cosine;
        w[kind].at[1] = alpha;
        w[kind].at[2] = eta;
        w[kind].at[3] = azimuth;
    }
    for (int k = 0; k < 3; ++k)
        printf(
            "ratio %g, %s: worst %.4f at cosine %.4g alpha %.4g eta %.4g azimuth %.3g; root mean "
            "square %.4f; %d of %d above 0.01\n",
            ratio, NAMES[k], w[k].error, w[k].at[0], w[k].at[1], w[k].at[2], w[k].at[3],
            sqrt(w[k].squares / w[k].count), w[k].above, w[k].count);
}

int main(void) {
    make_nodes();
    const double ratios[] = {1.2, 2, 4, 10};
    for (int k = 0; k < 4; ++k) measure(ratios[k]);
    return 0;
}

#endif
