/* kernel/trig.h: sine and cosine of 2 pi u. The angle is taken in turns: the reduction to an eighth
 * of a turn is exact, and no pi is lost. Polynomials: tools/numerics/coefficients.py. */
#ifndef K_TRIG_H
#define K_TRIG_H

#include "scalar.h"

K_STRUCT(k_sincos) {
    real s;
    real c;
};

/* sin(2 pi r) for |r| <= 1/8, x = r^2 */
K_FN real k_sin_eighth(real r, real x) {
#if K_IS_F64
    real p = R(-15.093804209987113512) + x * R(3.7808689593022955184);
    p = R(-76.705859704274550647) + x * (R(42.058685020160894047) + x * p);
    p = R(-41.341702240399636207) + x * (R(81.605249275948035209) + x * p);
    return r * (R(6.2831853071795864572) + x * p);
#else
    real p = R(81.592542871301543294) + x * R(-75.401612702747458455);
    p = R(-41.341662570547954912) + x * p;
    return r * (R(6.2831852878129467414) + x * p);
#endif
}

/* cos(2 pi r) for |r| <= 1/8, x = r^2 */
K_FN real k_cos_eighth(real x) {
#if K_IS_F64
    real p = R(7.9030916877516976361) + x * R(-1.6968494702918826806);
    p = R(60.24464132886729332) + x * (R(-26.426250908622135959) + x * p);
    p = R(64.939394022667957529) + x * (R(-85.456817206522712487) + x * p);
    return R(1.0) + x * (R(-19.739208802178716989) + x * p);
#else
    real p = R(-85.442844673081659515) + x * R(59.220168958296096218);
    p = R(64.939316135709049629) + x * p;
    return R(1.0) + x * (R(-19.739208650130595513) + x * p);
#endif
}

/* x with its sign turned where the second last digit of n is 1. */
K_FN real k_turn_sign(real x, kint n) {
    kint sign = k_shift_up(n & K_INT(2), K_SIGN_BIT - 1);
    return k_from_bits(k_bits(x) ^ sign);
}

/* u in [-4, 4] */
K_FN k_sincos k_sincos_2pi(real u) {
    real quarter = k_round(R(4.0) * u);
    kint n = k_to_int(quarter);
    real r = u - R(0.25) * quarter;
    real x = r * r;
    real s = k_sin_eighth(r, x);
    real c = k_cos_eighth(x);
    bool swaps = (n & K_INT(1)) != K_INT(0);
    k_sincos result;
    result.s = k_turn_sign(k_select(swaps, c, s), n);
    result.c = k_turn_sign(k_select(swaps, s, c), n + K_INT(1));
    return result;
}

/* Worst errors, every float in [1e-6, 1] (tools/numerics/worst_error.c): sine 8.9e-8 at
 * u = 0x1.e21b16p-4, cosine 8.9e-8 at u = 0x1.bec3cap-1, absolute. Double: below 1.5 ulp of 1 on a
 * million points. */

#endif
