#include "inputs.h"

#include <lobe/random.h>

#include <math.h>

static lobe_vec3_f64 direction(double u1, double u2) {
    double z = 0.05 + 0.95 * u1, s = sqrt(1 - z * z), phi = 6.283185307179586 * u2;
    return (lobe_vec3_f64){s * cos(phi), s * sin(phi), z};
}

void inputs_fill(inputs *in) {
    for (int i = 0; i < INPUTS; ++i) {
        double u[12];
        for (int block = 0; block < 3; ++block) {
            lobe_random4 r = lobe_random(1, (uint64_t)block, (uint64_t)i);
            for (int k = 0; k < 4; ++k) u[4 * block + k] = lobe_random_unit_f32(r.word[k]);
        }
        in->wi[i] = direction(u[0], u[1]);
        in->wo[i] = direction(u[2], u[3]);
        in->alpha_x[i] = 0.05 + 0.95 * u[4];
        in->alpha_y[i] = 0.05 + 0.95 * u[5];
        in->u1[i] = u[6];
        in->u2[i] = u[7];
        in->u3[i] = u[8];
    }
}
