/* ssr/passes/ray.h: a traced ray as a GPU keeps it: two buffers of 16 bytes a pixel, so that a frame of
 * 3840 x 2160 fits the 128 MiB that OpenGL promises of a buffer. */
#ifndef LOBE_SSR_RAY_H
#define LOBE_SSR_RAY_H

#include "kernel/vec.h"

#include "march.h"

K_STRUCT(ssr_drawn) {
    v3 direction; /* world */
    real pdf;
};

K_STRUCT(ssr_met) {
    real weight;
    real reach;   /* length of the ray in the world; 0: it met nothing */
    kint pixel;   /* x + 65536 y; -1: none */
    kint outcome; /* state + 8 steps */
};

K_FN ssr_drawn ssr_nothing_drawn(void) {
    ssr_drawn d;
    d.direction = v3_of(R(0.0), R(0.0), R(0.0));
    d.pdf = R(0.0);
    return d;
}

K_FN ssr_met ssr_met_of(real weight, kint state) {
    ssr_met m;
    m.weight = weight;
    m.reach = R(0.0);
    m.pixel = K_INT(-1);
    m.outcome = state;
    return m;
}

K_FN ssr_met ssr_met_at(ssr_met met, kint x, kint y, real reach) {
    ssr_met m = met;
    m.reach = reach;
    m.pixel = x + y * K_INT(65536);
    return m;
}

/* `steps` up to 2^28 - 1 */
K_FN kint ssr_outcome(kint state, kint steps) {
    return state + steps * K_INT(8);
}

K_FN kint ssr_met_state(ssr_met m) {
    return m.outcome & K_INT(7);
}

K_FN kint ssr_met_steps(ssr_met m) {
    return m.outcome >> 3;
}

K_FN bool ssr_met_something(ssr_met m) {
    return m.pixel >= K_INT(0);
}

K_FN kint ssr_met_x(ssr_met m) {
    return ssr_pick(m.pixel < K_INT(0), K_INT(-1), m.pixel & K_INT(65535));
}

K_FN kint ssr_met_y(ssr_met m) {
    return ssr_pick(m.pixel < K_INT(0), K_INT(-1), m.pixel >> 16);
}

#endif
