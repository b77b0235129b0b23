/* lib/dielectric_axes.h: the axes of the table of lib/dielectric_energy.c, for its reader and its maker.
 *
 * With s = sqrt((n - 1)/2), n the larger index over the smaller one, alpha the roughness and c the cosine:
 *   row      log(1 + s/(alpha e))/log(1 + 1/(alpha e)), e = 3/100
 *   column   log(1 + c/shift)/log(1 + 1/shift)
 *   alpha    sqrt(alpha)
 * Near the horizon E scales with c/alpha until refraction bends by as much as c, then with the index alone. That
 * happens at shift = alpha s^2/(s^2 + alpha^2), which goes to 0 with n - 1: the column has its nodes on both
 * scales whatever the index. What is kept is log(E/base), base the masking of i at the cosine c + shift: it has
 * little left of either.
 *
 * Before including: a binding of the kernel language. */
#ifndef LOBE_DIELECTRIC_AXES_H
#define LOBE_DIELECTRIC_AXES_H

#include "../kernel/albedo_table.h"
#include "../kernel/arc.h"
#include "../kernel/exp.h"

/* Cosines, roughnesses and indices: equal ones, and from there to 3 to one side. */
enum { LOBE_ENERGY_COSINES = 30, LOBE_ENERGY_ALPHAS = 16, LOBE_ENERGY_INDICES = 20 };

/* log(E/base) is kept as a multiple of this; from outside, then from inside. */
#define LOBE_ENERGY_STEP R(0x1p-11)
typedef int16_t lobe_energy_table[2][2][LOBE_ENERGY_INDICES][LOBE_ENERGY_ALPHAS]
                                 [LOBE_ENERGY_COSINES];

#define LOBE_ENERGY_LEAST_ALPHA R(1e-4)

static inline real energy_shift(real s, real alpha) {
    real s2 = s * s;
    return alpha * k_max(s2 / (s2 + alpha * alpha), R(3e-5));
}

static inline real energy_axis(real x, real scale) {
    return k_saturate(k_log1p(x / scale) / k_log1p(R(1.0) / scale));
}

static inline real energy_axis_inverse(real y, real scale) {
    return k_min(scale * (k_exp(y * k_log1p(R(1.0) / scale)) - R(1.0)), R(1.0));
}

static inline real energy_row_scale(real alpha) {
    return R(0.03) * alpha;
}

static inline real energy_base(real cosine, real shift, real alpha) {
    real x = cosine + shift;
    real plane2 = k_max(R(1.0) - x * x, R(0.0));
    return R(2.0) * x / (x + k_sqrt(x * x + alpha * alpha * plane2));
}

#endif
