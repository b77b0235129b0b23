/* kernel/ggx_horizon_shift.h: a continuous bijection of the circle whose density leans to one side:
 * the direction in which a point of the unit circle is seen from the point -d inside it. With the
 * point e0 even on the circle, f = e0 + d and e = f/|f|,
 *     density of e (in dphi/2pi) = |f|^2/(1 + d.e0) = 1 + t/q,  t = d.e,  q^2 = 1 - |d|^2 + t^2:
 * 1 + |d| along d, 1 - |d| at the other end. A draw takes the form in e as its density does: where |d| is
 * near 1 the other one is made of differences. */
#ifndef K_GGX_HORIZON_SHIFT_H
#define K_GGX_HORIZON_SHIFT_H

#include "scalar.h"

K_STRUCT(ggx_horizon_shift) {
    real d1;
    real d2;
    real room; /* 1 - |d|^2 > 0 */
};

/* 1 + t/q in the direction of f, of any length; for t < 0 as (q^2 - t^2)/(q (q - t)) */
K_FN real ggx_horizon_shift_density(ggx_horizon_shift d, real f1, real f2) {
    real t = d.d1 * f1 + d.d2 * f2;
    real room = d.room * (f1 * f1 + f2 * f2);
    real q = k_sqrt(room + t * t);
    bool falls = t < R(0.0);
    real top = k_select(falls, room, q + t);
    real bottom = k_select(falls, q * (q - t), q);
    return top / bottom;
}

#endif
