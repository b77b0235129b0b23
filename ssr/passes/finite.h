/* ssr/passes/finite.h: numbers of a frame, which may be anything. */
#ifndef LOBE_SSR_FINITE_H
#define LOBE_SSR_FINITE_H

#include "kernel/vec.h"

K_FN bool ssr_is_finite(real x) {
    return k_is_below(k_abs(x), K_HUGE * R(1e8));
}

/* x where it is usable light or a usable weight: positive and finite; 0 where it is anything else. */
K_FN real ssr_usable(real x) {
    return k_select(k_and(ssr_is_finite(x), x > R(0.0)), x, R(0.0));
}

#endif
