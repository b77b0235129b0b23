/* tools/numerics/gauss.h: Gauss's rule on (0, 1), for the makers of tables.
 *
 * Before including: a binding of the kernel language, in double. */
#ifndef TOOLS_GAUSS_H
#define TOOLS_GAUSS_H

#include "kernel/trig.h"

enum { GAUSS_MAX = 64 };

typedef struct gauss {
    int count;
    double x[GAUSS_MAX], weight[GAUSS_MAX];
} gauss;

/* By Newton's method from the usual first guess; `count` <= GAUSS_MAX. */
static gauss gauss_of(int count) {
    gauss g;
    g.count = count;
    for (int i = 0; i < count; ++i) {
        double x = k_sincos_2pi(0.5 * (i + 0.75) / (count + 0.5)).c, slope = 1;
        for (int step = 0; step < 50; ++step) {
            double before = 1, p = x;
            for (int k = 2; k <= count; ++k) {
                const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = count * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        g.x[i] = 0.5 * (1 - x);
        g.weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
    return g;
}

#endif
