/* bench/inputs.h: what the draws are made of: arrays that stay in the first-level cache. */
#ifndef LOBE_BENCH_INPUTS_H
#define LOBE_BENCH_INPUTS_H

#include <lobe/types.h>

enum { INPUTS = 512 };

/* Element 0 stands for all where the model is prepared once. */
typedef struct inputs {
    lobe_vec3_f64 wi[INPUTS], wo[INPUTS];
    double alpha_x[INPUTS], alpha_y[INPUTS];
    double u1[INPUTS], u2[INPUTS], u3[INPUTS];
} inputs;

void inputs_fill(inputs *in);

#endif
