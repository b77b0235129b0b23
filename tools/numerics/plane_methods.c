/* tools/numerics/plane_methods.c: what is accepted and what variance is left above a shading and a
 * geometric plane, method by method: the tables of docs/horizon-planes.md.
 *
 *     cc -O2 -ffp-contract=off -I. -Iinclude tools/numerics/plane_methods.c build/liblobe.a -lm \
 *         -o plane_methods && ./plane_methods
 *
 * With -DGGX_HORIZON_PLANE_NODES=16 the table has 16 nodes. Variance: relative, of f cos/p in a white furnace
 * with the height-correlated G2; over the 110 cases of plane_cases.h and over random ones. */
#include "kernel/bind/c_f64.h"

#include "kernel/ggx_bounded.h"
#include "kernel/ggx_caps.h"
#include "kernel/ggx_horizon.h"
#include "kernel/ggx_horizon_mirror.h"
#include "lobe/random.h"
#include "plane_cases.h"

#include <stdio.h>

enum { SIDE = 200, RANDOM_CASES = 200 };

/* About what G is where most draws land: the level of what ignores shadowing. */
static const double TYPICAL_SHADOWING = 0.8;

/* Sums over the draws of one point. */
typedef struct moments {
    double accepted, mean, square, cover, cover_square;
} moments;

static void add(moments *sum, ggx_base g, facet_draw d) {
    double weight = (double)d.weight, delta = (double)g.floor_share;
    sum->accepted += d.pdf > 0;
    sum->mean += weight;
    sum->square += weight * weight;
    /* a draw from the same ellipse that follows (1 - delta) G + delta G0 without any error */
    double shadow = d.wo.z > 0 ? (double)ggx_shadowing(g, d.wo) : 0;
    double follow = (1 - delta) * shadow + delta * TYPICAL_SHADOWING;
    sum->cover += follow;
    sum->cover_square += follow > 0 ? weight * weight / follow : 0;
}

typedef struct totals {
    double accepted, least, variance, largest, ideal;
    int cases;
} totals;

static void tally(totals *t, moments sum) {
    double n = (double)SIDE * SIDE, accepted = sum.accepted / n;
    double variance = sum.square * n / (sum.mean * sum.mean) - 1;
    t->accepted += accepted;
    t->least = t->cases == 0 ? accepted : fmin(t->least, accepted);
    t->variance += variance;
    t->largest = fmax(t->largest, variance);
    t->ideal += sum.cover_square * sum.cover / (sum.mean * sum.mean) - 1;
    ++t->cases;
}

static ggx_base random_case(int index, double floor_share, int from_behind) {
    lobe_random4 r = lobe_random(5, (uint64_t)from_behind, (uint64_t)index),
                 q = lobe_random(6, (uint64_t)from_behind, (uint64_t)index);
    double u[8];
    for (int k = 0; k < 8; ++k)
        u[k] = (double)lobe_random_unit_f32(k < 4 ? r.word[k] : q.word[k - 4]);
    double theta = from_behind ? 90 + 30 * u[0] : 89 * u[0], turn = 360 * u[1];
    double ax = 0.05 * pow(20, u[2]), ay = u[3] < 0.25 ? ax : 0.05 * pow(20, u[4]);
    v3 wi = plane_direction(theta, turn);
    /* from behind the plane must lean toward wi */
    double tilt = from_behind ? theta - 90 + (150 - theta) * u[5] : 45 * u[5];
    v3 plane = plane_direction(tilt, from_behind ? turn + 60 * (u[6] - 0.5) : 360 * u[6]);
    return plane_base(wi, plane, ax, ay, floor_share);
}

/* The set of cases: 0 the 110, 1 random ones, 2 random ones from behind. */
static int case_count(int set) {
    return set == 0 ? PLANE_CASES : RANDOM_CASES;
}

static ggx_base case_of(int set, int index, double floor_share) {
    return set == 0 ? plane_case(index, floor_share) : random_case(index, floor_share, set == 2);
}

#define MEASURE(method, set, floor_share, t)                                                       \
    for (int c = 0; c < case_count(set); ++c) {                                                    \
        ggx_base g = case_of(set, c, floor_share);                                                 \
        if (!k_is(g.valid) || v3_dot(g.wi, g.plane) < 0.02) continue;                              \
        ggx_##method s = ggx_##method##_prepare(g);                                                \
        moments sum = {0};                                                                         \
        for (int k = 0; k < SIDE * SIDE; ++k) {                                                    \
            double u1 = (k % SIDE + 0.5) / SIDE, u2 = (k / SIDE + 0.5) / SIDE;                     \
            double u3 = fmod(0.5 + 0.61803398874989485 * k, 1);                                    \
            add(&sum, g, ggx_##method##_draw(s, u1, u2, u3));                                      \
        }                                                                                          \
        tally(&t, sum);                                                                            \
    }

static void print(const char *name, double floor_share, totals t, int ideal) {
    printf("%-32s floor %-4g %3d cases: accepted %.4f, least %.4f; variance %.4f, largest %.3f",
           name, floor_share, t.cases, t.accepted / t.cases, t.least, t.variance / t.cases,
           t.largest);
    if (ideal) printf("; following perfectly %.4f", t.ideal / t.cases);
    printf("\n");
}

#define ROW(method, set, floor_share, ideal)                                                       \
    do {                                                                                           \
        totals t = {0};                                                                            \
        MEASURE(method, set, floor_share, t)                                                       \
        print(#method, floor_share, t, ideal);                                                     \
    } while (0)

int main(void) {
    static const char *const sets[] = {"the 110 cases", "random, above", "random, from behind"};
    for (int set = 0; set < 3; ++set) {
        printf("%s\n", sets[set]);
        ROW(caps, set, 1, 0);
        ROW(bounded, set, 1, 0);
        ROW(horizon_mirror, set, 1, 0);
        ROW(horizon, set, 0.25, 0);
        ROW(horizon_plane_ellipse, set, 1, 0);
        ROW(horizon_plane_ellipse, set, 0.25, 1);
        ROW(horizon_plane_ellipse, set, 0.1, 1);
        ROW(horizon_plane_table, set, 1, 0);
        ROW(horizon_plane_table, set, 0.25, 0);
        ROW(horizon_plane_table, set, 0.1, 0);
        ROW(horizon_plane_table, set, 0, 0);
    }
    return 0;
}
