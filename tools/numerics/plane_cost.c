/* tools/numerics/plane_cost.c: calls a sampler's functions in float over the 110 cases of plane_cases.h, so
 * that their instructions can be counted:
 *
 *     cc -O3 -ffp-contract=off -fno-math-errno -I. -DMETHOD=ggx_horizon_plane_table \
 *         tools/numerics/plane_cost.c -lm -o plane_cost
 *     valgrind --tool=callgrind --callgrind-out-file=/dev/null ./plane_cost PREPARES DRAWS DENSITIES
 *
 * The numbers of each are per case: "Collected" of `20 0 0` less that of `0 0 0` is 2200 prepares. */
#include "kernel/bind/c_f32.h"

#include "kernel/ggx_bounded.h"
#include "kernel/ggx_horizon.h"
#include "kernel/ggx_horizon_mirror.h"
#include "plane_cases.h"

#include <stdio.h>
#include <stdlib.h>

#ifndef METHOD
#define METHOD ggx_horizon_plane_table
#endif

#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)

__attribute__((noinline)) static void prepare(METHOD *s, const ggx_base *g) {
    *s = JOIN(METHOD, _prepare)(*g);
}

__attribute__((noinline)) static void draw(facet_draw *d, const METHOD *s, real u1, real u2) {
    *d = JOIN(METHOD, _draw)(*s, u1, u2, R(0.37));
}

__attribute__((noinline)) static void density(real *pdf, const METHOD *s, const facet_pair *pair) {
    *pdf = JOIN(METHOD, _pdf)(*s, *pair);
}

int main(int argc, char **argv) {
    int prepares = argc > 1 ? atoi(argv[1]) : 1, draws = argc > 2 ? atoi(argv[2]) : 1;
    int densities = argc > 3 ? atoi(argv[3]) : 1;
    double sum = 0;
    for (int c = 0; c < PLANE_CASES; ++c) {
        ggx_base g = plane_case(c, 0.25);
        METHOD s = JOIN(METHOD, _prepare)(g);
        facet_draw d = JOIN(METHOD, _draw)(s, R(0.3), R(0.4), R(0.37));
        facet_pair pair = ggx_pair_of_wo(g, d.wo);
        real pdf = d.pdf;
        for (int k = 0; k < prepares; ++k) prepare(&s, &g);
        for (int k = 0; k < draws; ++k) draw(&d, &s, ((real)k + R(0.5)) / (real)draws, R(0.4));
        for (int k = 0; k < densities; ++k) density(&pdf, &s, &pair);
        sum += (double)pdf + (double)d.pdf;
    }
    printf("%g\n", sum);
    return 0;
}
