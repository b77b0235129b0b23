/* bench/inputs.h: what the draws are made of, and room for what comes out: arrays that stay in the
 * second-level cache. */
#ifndef LOBE_BENCH_INPUTS_H
#define LOBE_BENCH_INPUTS_H

enum { INPUTS = 1024 };

/* Row 0 stands for all where the model is prepared once. */
typedef struct inputs_f32 {
    float wi[3][INPUTS], alpha[2][INPUTS], u[3][INPUTS], wo[3][INPUTS];
    float out_wo[3][INPUTS], out_pdf[INPUTS], out_weight[INPUTS];
} inputs_f32;

typedef struct inputs_f64 {
    double wi[3][INPUTS], alpha[2][INPUTS], u[3][INPUTS], wo[3][INPUTS];
    double out_wo[3][INPUTS], out_pdf[INPUTS], out_weight[INPUTS];
} inputs_f64;

typedef struct inputs {
    inputs_f32 f32;
    inputs_f64 f64;
} inputs;

void inputs_fill(inputs *in);

#endif
