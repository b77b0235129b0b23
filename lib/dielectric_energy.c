#include "dielectric_energy.h"

#include <stdint.h>

enum {
    COSINES = LOBE_ENERGY_COSINES,
    ALPHAS = LOBE_ENERGY_ALPHAS,
    INDICES = LOBE_ENERGY_INDICES,
    ROWS = 2 * INDICES - 1 /* from the inside, equal indices, from the outside */
};

/* 65535 sqrt(E), the cosine running fastest, then roughness, index, shadowing. */
static const uint16_t TABLE[2 * ROWS * ALPHAS * COSINES] = {
#include "dielectric_energy.inc"
};

static float least(float a, float b) {
    return a < b ? a : b;
}

static float relative(float x, float alpha) {
    return x > 0 ? least(x * (1 + alpha) / (x + alpha), 1) : 0;
}

static float absolute(float y, float alpha) {
    return y * alpha / (1 + alpha - y);
}

/* Between two entries of an axis. */
typedef struct place {
    int low;
    float share; /* of the upper one */
} place;

static place place_on(float position, int entries) {
    int low = (int)least(position, (float)(entries - 2));
    return (place){low, position - (float)low};
}

/* Near equal indices E is linear in n - 1, far from them in the axis. */
static place place_of_index(float eta, float alpha) {
    float n = eta < 1 ? 1 / eta : eta;
    float s = __builtin_sqrtf(least((n - 1) / 2, 1));
    place p = place_on(relative(s, alpha) * (INDICES - 1), INDICES);
    if (p.low < INDICES / 2) {
        float low = absolute((float)p.low / (INDICES - 1), alpha);
        float high = absolute((float)(p.low + 1) / (INDICES - 1), alpha);
        p.share = (s * s - low * low) / (high * high - low * low);
    }
    return p;
}

float lobe_dielectric_energy(float cosine, float alpha, float eta, int separable) {
    float a = least(alpha > 1e-4f ? alpha : 1e-4f, 1);
    place i = place_of_index(eta, a);
    place j = place_on(__builtin_sqrtf(a) * (ALPHAS - 1), ALPHAS);
    place k = place_on(relative(cosine, a) * (COSINES - 1), COSINES);
    float sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        int di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2;
        int row = INDICES - 1 + (eta < 1 ? -(i.low + di) : i.low + di);
        int line = ((separable != 0) * ROWS + row) * ALPHAS + j.low + dj;
        float root = (float)TABLE[line * COSINES + k.low + dk] / 65535;
        sum += (di ? i.share : 1 - i.share) * (dj ? j.share : 1 - j.share) *
               (dk ? k.share : 1 - k.share) * root * root;
    }
    return sum;
}
