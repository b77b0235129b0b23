/* kernel/kepler.h: the root e of e - sin e = t for t in [0, pi] (Kepler's equation of a parabola-like
 * orbit), and the cube root that starts it. It inverts the GGX slope distribution exactly
 * (kernel/ggx_slope.h). Series: tools/numerics/coefficients.py. */
#ifndef K_KEPLER_H
#define K_KEPLER_H

#include "scalar.h"
#include "trig.h"

/* Cube root of a normal x > 0, relative error below 5e-5: enough for a start. A third of the bits is about
 * the bits of the root; in double the upper half of them will do, and divides as a real number. */
K_FN real k_cbrt_start(real x) {
#if K_IS_F64
    kint third = k_to_int(k_from_int(k_shift_down(k_bits(x), 32)) * R(0.33333333333333333333));
    real y = k_from_bits((third << 32) + K_INT_PAIR(0x2a9f7893, 0x00000000));
#else
    real y = k_from_bits(k_bits(x) / K_INT(3) + K_INT(0x2a5119f2));
#endif
    real y3 = y * y * y;
    return y * ((y3 + R(2.0) * x) / (R(2.0) * y3 + x));
}

/* (e - sin e)/e^3, y = e^2, on [0, pi^2]: no cancellation */
K_FN real k_sine_defect(real y) {
#if K_IS_F64
    real p = R(-1.9495555154187330681e-20) + y * R(3.5331586127115938137e-23);
    p = R(-2.8114489198177559486e-15) + y * (R(8.2196175773778214569e-18) + y * p);
    p = R(-1.6059043821950729789e-10) + y * (R(7.6471632926893419283e-13) + y * p);
    p = R(-2.7557319223982018854e-6) + y * (R(2.505210838512761095e-8) + y * p);
    p = R(-0.0083333333333333332729) + y * (R(0.00019841269841269816788) + y * p);
    return R(0.16666666666666666666) + y * p;
#else
    real p = R(-1.5937507927936940457e-10) + y * R(6.7332606501013792437e-13);
    p = R(-2.7557040949006590331e-6) + y * (R(2.5044009139326849541e-8) + y * p);
    p = R(-0.0083333333052268711202) + y * (R(0.00019841265277814575265) + y * p);
    return R(0.166666666663836907) + y * p;
#endif
}

K_FN real k_kepler(real t) {
    /* below the floor the root is far beyond what a slope needs */
    real root = k_cbrt_start(k_max(R(6.0) * t, K_EPS * K_EPS));
    real y = root * root;
    real p = R(-0.000041453861410815207855) + y * R(0.000012345132219344923005);
    p = R(0.016448275855009815108) + y * (R(0.00094724821443943641212) + y * p);
    real e = root * (R(1.0000312678955868056) + y * p);
    /* Newton: relative error 7e-5 -> 5e-9 -> 1e-16 */
    for (int step = 0; step < 1 + K_IS_F64; ++step) {
        k_sincos half_e = k_sincos_2pi(e * (R(0.25) * K_INV_PI));
        real slope = R(2.0) * half_e.s * half_e.s;
        e = e - (e * e * e * k_sine_defect(e * e) - t) / slope;
    }
    return e;
}

/* Worst error, every float in [1e-6, pi] (tools/numerics/worst_error.c): 1.6 ulp at
 * t = 0x1.0aea4ap+0. Double: residual below 40 ulp of t on a hundred thousand points. */

#endif
