/* ssr/passes/accumulate.h: how much of the history a pixel keeps. */
#ifndef LOBE_SSR_ACCUMULATE_H
#define LOBE_SSR_ACCUMULATE_H

#include "kernel/scalar.h"

/* The share of the new frame: 1 - accumulation, and more the faster (pixels a frame) the surface and what
 * it reflects move. */
K_FN real ssr_new_share(real accumulation, real surface_speed, real reflected_speed,
                        real rejection) {
    real share = R(1.0) - k_saturate(accumulation);
    real moves = k_saturate((surface_speed + reflected_speed) * rejection);
    return share + (R(1.0) - share) * moves;
}

/* Whether what was at z in the last frame is the surface that is expected there. */
K_FN bool ssr_is_same_surface(real expected_z, real z) {
    return k_abs(expected_z - z) <= R(0.05) * expected_z;
}

K_FN real ssr_clamp(real x, real low, real high) {
    return k_min(k_max(x, low), high);
}

#endif
