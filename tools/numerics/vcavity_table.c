/* tools/numerics/vcavity_table.c: what `vcavity` and `vcavity-valid` reject and their relative variance in
 * a white furnace: the tables of docs/departures.md.
 *
 *     cc -O2 -ffp-contract=off -I. tools/numerics/vcavity_table.c -lm -o vcavity_table
 *     ./vcavity_table
 *
 * A grid in (u1, u2), an additive sequence in u3; azimuth 45 degrees. */
#include "kernel/bind/c_f64.h"

#include "kernel/beckmann_vcavity.h"
#include "kernel/beckmann_vcavity_valid.h"
#include "kernel/ggx_vcavity.h"
#include "kernel/ggx_vcavity_valid.h"

#include <math.h>
#include <stdio.h>

typedef struct moments {
    double rejected, mean, square;
} moments;

typedef moments (*furnace)(v3 wi, double ax, double ay);

#define FURNACE(name, base_of)                                                                     \
    static moments name##_furnace(v3 wi, double ax, double ay) {                                   \
        enum { SIDE = 1024 };                                                                      \
        name s = name##_prepare(base_of(wi, ax, ay, facet_options_of(false, false)));              \
        moments m = {0, 0, 0};                                                                     \
        for (int k = 0; k < SIDE * SIDE; ++k) {                                                    \
            double u3 = k * 0.6180339887498949;                                                    \
            facet_draw d =                                                                         \
                name##_draw(s, (k % SIDE + 0.5) / SIDE, (k / SIDE + 0.5) / SIDE, u3 - floor(u3));  \
            m.rejected += (d.pdf == 0) / (double)(SIDE * SIDE);                                    \
            m.mean += d.weight / (SIDE * SIDE);                                                    \
            m.square += d.weight * d.weight / (SIDE * SIDE);                                       \
        }                                                                                          \
        return m;                                                                                  \
    }
FURNACE(ggx_vcavity, ggx_vcavity_base_of)
FURNACE(ggx_vcavity_valid, ggx_vcavity_base_of)
FURNACE(beckmann_vcavity, beckmann_vcavity_base_of)
FURNACE(beckmann_vcavity_valid, beckmann_vcavity_base_of)

static double variance(moments m) {
    return m.square / (m.mean * m.mean) - 1;
}

static void table(const char *title, furnace published, furnace valid) {
    const double alpha[][2] = {{0.1, 0.1}, {0.3, 0.3}, {0.5, 0.5}, {1, 1}, {0.1, 1}};
    const double theta[] = {5, 40, 60, 75, 87, 120, 150};
    printf("%s\n", title);
    for (int a = 0; a < 5; ++a) {
        for (int t = 0; t < 7; ++t) {
            double z = cos(theta[t] * (K_PI / 180)), r = sqrt((1 - z * z) / 2);
            moments p = published(v3_of(r, r, z), alpha[a][0], alpha[a][1]);
            moments v = valid(v3_of(r, r, z), alpha[a][0], alpha[a][1]);
            printf("| %g, %g | %g | %.4f | %.3f | %.3f | %.4f | %.4f |\n", alpha[a][0], alpha[a][1],
                   theta[t], p.mean, p.rejected, v.rejected, variance(p), variance(v));
        }
    }
}

int main(void) {
    table("GGX", ggx_vcavity_furnace, ggx_vcavity_valid_furnace);
    table("Beckmann", beckmann_vcavity_furnace, beckmann_vcavity_valid_furnace);
    return 0;
}
