/* tools/numerics/dielectric_furnace.c: how far compensated rough dielectrics are from scattering all of even light,
 * |R + T - 1|, at random places, through the library; the tables of docs/departures.md.
 *
 *     cc -O2 -fopenmp -ffp-contract=off -I. -Iinclude tools/numerics/dielectric_furnace.c build/liblobe.a -lm \
 *         -o dielectric_furnace && ./dielectric_furnace [PLACES]
 *
 * What is scattered once is integrated by finer rules than the tables are made with; with `rules` for PLACES it
 * says what both rules, and the library's own quadrature, differ by. */
#include "dielectric_sum.h"

#include <lobe/dielectric.h>
#include <lobe/random.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct place {
    double cosine, wide, narrow, azimuth, eta;
    int separable;
} place;

typedef struct worst {
    double error, squares;
    place at;
    int above, count;
} worst;

/* Roughness uniform in its root, the index in sqrt(n - 1) or its logarithm, the cosine uniform or in its logarithm. */
static place place_of(uint64_t k, double ratio) {
    const lobe_random4 r = lobe_random(4, 0, k), q = lobe_random(4, 1, k);
    const double u = lobe_random_unit_f32(r.word[0]), s = lobe_random_unit_f32(r.word[2]);
    const double root = lobe_random_unit_f32(r.word[1]);
    const double n = 1 + (k % 4 != 0 ? 2 * s * s : 2 * pow(10, -6 * s));
    place p;
    p.wide = fmax(root * root, 1e-4);
    p.narrow = fmax(p.wide / ratio, 1e-4);
    p.cosine = k % 3 != 0 ? fmax(u, 1e-3) : pow(10, -3 * u);
    p.azimuth = 2 * SUM_PI * lobe_random_unit_f32(q.word[0]);
    p.eta = r.word[3] & 1 ? 1 / n : n;
    p.separable = (int)(k & 1);
    return p;
}

static lobe_vec3_f64 toward(place p) {
    const double sine = sqrt((1 - p.cosine) * (1 + p.cosine));
    return (lobe_vec3_f64){sine * cos(p.azimuth), sine * sin(p.azimuth), p.cosine};
}

static double once(dielectric_sum *rules, place p) {
    const lobe_vec3_f64 w = toward(p);
    sum_toward(rules, v3_of(w.x, w.y, w.z), p.wide, p.narrow, p.eta);
    return sum_of(rules).of[p.separable];
}

static lobe_dielectric_f64 model_of(place p, int compensate) {
    lobe_dielectric_options options = lobe_dielectric_default_options();
    options.g2 = p.separable ? LOBE_G2_SEPARABLE : LOBE_G2_CORRELATED;
    options.transport = LOBE_TRANSPORT_IMPORTANCE;
    options.compensate = compensate;
    lobe_vec3_f64 wi = toward(p);
    if (p.eta < 1) wi.z = -wi.z;
    return lobe_dielectric_prepare_f64(options, wi, p.wide, p.narrow,
                                       p.eta < 1 ? 1 / p.eta : p.eta);
}

static void keep(worst *w, double error, place p) {
    w->count += 1;
    w->above += error > 0.01;
    w->squares += error * error;
    if (!(error > w->error)) return;
    w->error = error;
    w->at = p;
}

static void print(const char *what, const worst *w) {
    printf("%-26s worst %.4f at cosine %.4g alpha %.4g,%.4g azimuth %.3g eta %.6g separable %d; "
           "root mean square %.5f; "
           "%d of %d above 0.01\n",
           what, w->error, w->at.cosine, w->at.wide, w->at.narrow, w->at.azimuth, w->at.eta,
           w->at.separable, sqrt(w->squares / (w->count > 0 ? w->count : 1)), w->above, w->count);
}

static void measure(double ratio, long places) {
    static const char *const NAMES[] = {"n >= 1.1", "n < 1.1, cosine >= 0.1",
                                        "n < 1.1, cosine < 0.1"};
    worst w[3] = {{0}};
#pragma omp parallel for schedule(dynamic, 16)
    for (long k = 0; k < places; ++k) {
        dielectric_sum rules = sum_rules(20, 14, 32);
        const place p = place_of((uint64_t)k, ratio);
        const double error = fabs(once(&rules, p) * model_of(p, 1).energy_factor - 1);
        const int kind = fmax(p.eta, 1 / p.eta) >= 1.1 ? 0 : p.cosine >= 0.1 ? 1 : 2;
#pragma omp critical
        keep(&w[kind], error, p);
    }
    for (int k = 0; k < 3; ++k) {
        printf("%4g : 1, ", ratio);
        print(NAMES[k], &w[k]);
    }
}

/* The same integral by the rules of the makers, by those above, and by the library's stratified normals. */
static void compare_rules(void) {
    worst made = {0}, library = {0};
    for (uint64_t k = 0; k < 300; ++k) {
        dielectric_sum coarse = sum_rules(14, 10, 20), fine = sum_rules(20, 14, 32);
        const place p = place_of(k, k % 2 ? 3 : 1);
        const double best = once(&fine, p);
        keep(&made, fabs(once(&coarse, p) / best - 1), p);
        const lobe_dielectric_f64 model = model_of(p, 0);
        const lobe_dielectric_albedo a = lobe_dielectric_integrate(&model, 262144);
        if (p.separable) keep(&library, fabs(a.reflected + a.transmitted - best), p);
    }
    print("rules of the makers", &made);
    print("the library, separable", &library);
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "rules") == 0) return compare_rules(), 0;
    const long places = argc > 1 ? atol(argv[1]) : 4000;
    const double ratios[] = {1, 1.2, 2, 4, 10};
    for (int k = 0; k < 5; ++k) measure(ratios[k], places);
    return 0;
}
