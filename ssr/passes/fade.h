/* ssr/passes/fade.h: how much of a reflection is taken: it ends softly at the edge of the screen and
 * toward rough surfaces. */
#ifndef LOBE_SSR_FADE_H
#define LOBE_SSR_FADE_H

#include "kernel/scalar.h"

K_FN real ssr_smooth(real t) {
    return t * t * (R(3.0) - R(2.0) * t);
}

/* `at` in [0, 1] across the screen; `length`: the share of half the screen on which it fades; 0: none. */
K_FN real ssr_edge_fade(real at, real length) {
    real to_edge = R(1.0) - k_abs(R(2.0) * at - R(1.0));
    real t = k_select(length > R(0.0), to_edge / k_max(length, K_TINY), R(1.0));
    return k_select(to_edge >= R(0.0), ssr_smooth(k_saturate(t)), R(0.0));
}

/* Whole up to perceptual roughness `start`, nothing beyond `end`. */
K_FN real ssr_roughness_fade(real roughness, real start, real end) {
    real length = end - start;
    real t = k_select(length > R(0.0), (end - roughness) / k_max(length, K_TINY), R(1.0));
    return k_select(roughness <= end, ssr_smooth(k_saturate(t)), R(0.0));
}

#endif
