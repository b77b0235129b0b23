/* kernel/crescent.h: points of a crescent of the unit disk, evenly, lifted to the hemisphere above it.
 * Chords along y shrink towards +y, to the share `squeeze` of their length (Heitz 2018):
 * y >= (1 - 2 squeeze) sqrt(1 - x^2). On the hemisphere that is the lune between the rim and a great
 * circle through (+-1, 0). */
#ifndef K_CRESCENT_H
#define K_CRESCENT_H

#include "trig.h"
#include "vec.h"

/* rest = 1 - squeeze, each in [0, 1]; z is the height. */
K_FN v3 crescent_point(real squeeze, real rest, real u1, real u2) {
    real radius = k_sqrt(u1);
    k_sincos phi = k_sincos_2pi(u2);
    real x = radius * phi.c;
    real t = radius * phi.s;
    real half_width = k_sqrt(R(1.0) - x * x);
    /* the two gaps half_width -+ t: the smaller one by their product 1 - u1, so that the height
     * above the disk is a product of positive numbers, exact at the rim */
    real wide = half_width + k_abs(t);
    real narrow = (R(1.0) - u1) / wide;
    real above = k_select(t < R(0.0), wide, narrow);
    real below = k_select(t < R(0.0), narrow, wide);
    real y = rest * half_width + squeeze * t;
    real height = k_sqrt(squeeze * above * (R(2.0) * rest * half_width + squeeze * below));
    return v3_of(x, y, height);
}

#endif
