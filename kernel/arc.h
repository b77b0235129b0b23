/* kernel/arc.h: the inverses of tangent and hyperbolic sine, branch-free. Polynomial:
 * tools/numerics/coefficients.py. */
#ifndef K_ARC_H
#define K_ARC_H

#include "log.h"

/* (atan(t)/t - 1)/t^2, x = t^2, |t| <= tan(pi/8) */
K_FN real k_atan_tail(real x) {
#if K_IS_F64
    real p = R(0.037965257453865936236) + x * R(-0.017805397205419445228);
    p = R(0.058468782973308725201) + x * (R(-0.050351024566015518428) + x * p);
    p = R(0.076920453309022249521) + x * (R(-0.066629518136291900881) + x * p);
    p = R(0.11111110744919658237) + x * (R(-0.090908968090640270761) + x * p);
    p = R(0.19999999999940891462) + x * (R(-0.14285714279250244942) + x * p);
    return R(-0.33333333333333121163) + x * p;
#else
    real p = R(0.10569828806414448072) + x * R(-0.060263052276584590988);
    p = R(0.19998183041083205602) + x * (R(-0.14239532669648974578) + x * p);
    return R(-0.33333306893048512837) + x * p;
#endif
}

/* The angle of (x, y) for x >= 0, in [-pi/2, pi/2]. One division: y/x beyond tan(pi/8) is turned back by
 * an eighth of a turn, beyond tan(3 pi/8) by a quarter. */
K_FN real k_angle(real y, real x) {
    real rise = k_abs(y);
    bool steep = rise > R(2.41421356237309505) * x;
    bool middle = rise > R(0.414213562373095049) * x;
    real top = k_select(steep, -x, k_select(middle, rise - x, rise));
    real bottom = k_select(steep, rise, k_select(middle, rise + x, x));
    real turned = k_select(steep, R(0.5) * K_PI, k_select(middle, R(0.25) * K_PI, R(0.0)));
    real t = top / k_max(bottom, K_TINY);
    real x2 = t * t;
    return k_sign(y) * (turned + (t + t * (x2 * k_atan_tail(x2))));
}

/* log(1 + f), f >= 0: what rounding takes from 1 + f is given back */
K_FN real k_log1p(real f) {
    real u = R(1.0) + f;
    return k_log(u) + (f - (u - R(1.0))) / u;
}

/* |x| up to the root of the largest number */
K_FN real k_asinh(real x) {
    real size = k_abs(x);
    real x2 = size * size;
    return k_sign(x) * k_log1p(size + x2 / (R(1.0) + k_sqrt(R(1.0) + x2)));
}

/* Worst errors, every float in [1e-6, 1e6] (tools/numerics/worst_error.c): angle 2.6 ulp at
 * 0x1.ca0056p-2 to 1, asinh 2.1 ulp at 0x1.011782p-2. Double: below 2.5 and 4 ulp on the points of
 * tests/kernel/elementary_template.h. */

#endif
