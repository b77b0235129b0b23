#include "inputs.h"

#include <lobe/random.h>

#include <math.h>

static void direction(double u1, double u2, double d[3]) {
    double z = 0.05 + 0.95 * u1, s = sqrt(1 - z * z), phi = 6.283185307179586 * u2;
    d[0] = s * cos(phi);
    d[1] = s * sin(phi);
    d[2] = z;
}

static void fill_row(inputs *in, int i, const double wi[3], const double wo[3],
                     const double alpha[2], const double u[3]) {
    for (int k = 0; k < 3; ++k) {
        in->f64.wi[k][i] = in->f32.wi[k][i] = (float)wi[k];
        in->f64.wo[k][i] = in->f32.wo[k][i] = (float)wo[k];
        in->f64.u[k][i] = in->f32.u[k][i] = (float)u[k];
    }
    for (int k = 0; k < 2; ++k) in->f64.alpha[k][i] = in->f32.alpha[k][i] = (float)alpha[k];
}

void inputs_fill(inputs *in) {
    for (int i = 0; i < INPUTS; ++i) {
        double u[12], wi[3], wo[3];
        for (int block = 0; block < 3; ++block) {
            lobe_random4 r = lobe_random(1, (uint64_t)block, (uint64_t)i);
            for (int k = 0; k < 4; ++k) u[4 * block + k] = lobe_random_unit_f32(r.word[k]);
        }
        direction(u[0], u[1], wi);
        direction(u[2], u[3], wo);
        const double alpha[2] = {0.05 + 0.95 * u[4], 0.05 + 0.95 * u[5]};
        fill_row(in, i, wi, wo, alpha, u + 6);
    }
}
