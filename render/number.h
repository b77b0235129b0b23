/* Single numbers, in float. */
#ifndef LOBE_RENDER_NUMBER_H
#define LOBE_RENDER_NUMBER_H

#include <math.h>

#define LOBE_PI 3.14159265358979323846f

/* The larger and the smaller one without a call; of a NaN and b it is b. */
static inline float maxf(float a, float b) {
    return a > b ? a : b;
}

static inline float minf(float a, float b) {
    return a < b ? a : b;
}

static inline float clampf(float x, float low, float high) {
    return minf(maxf(x, low), high);
}

/* From a to b. */
static inline float mixf(float a, float b, float share) {
    return a + share * (b - a);
}

#endif
