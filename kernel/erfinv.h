/* kernel/erfinv.h: the inverse error function, branch-free, of x and of 1 - x. With
 * w = -log(1 - x^2), z = erfinv(x) is x times a smooth function of w (Giles 2010), and of 1/sqrt(w) where w is
 * large. Polynomials: tools/numerics/coefficients.py. */
#ifndef K_ERFINV_H
#define K_ERFINV_H

#include "log.h"
#include "rounding.h"

/* z/x - sqrt(pi)/2 on w in [0, 6.25] */
K_FN real k_erfinv_near(real w) {
#if K_IS_F64
    real p = R(-2.3403911678776315181e-19) + w * R(3.2407044593799019112e-21);
    p = R(-1.5354484408164974349e-16) + w * (R(7.7334102006198156942e-18) + w * p);
    p = R(-1.799189645705037613e-14) + w * (R(2.0150416767775775697e-15) + w * p);
    p = R(-3.8223112358206317291e-13) + w * (R(1.0694305151961183489e-13) + w * p);
    p = R(-1.5731124591700393871e-13) + w * (R(5.7956280764925036575e-13) + w * p);
    p = R(9.3909760971141359329e-12) + w * (R(7.1024952563019810095e-12) + w * p);
    p = R(8.8794348026330921418e-10) + w * (R(-5.9437393188286840084e-10) + w * p);
    p = R(-3.7099518059442291237e-8) + w * (R(2.2606302175515737355e-8) + w * p);
    p = R(2.0200738789339956884e-6) + w * (R(-1.0127058638642554588e-6) + w * p);
    p = R(-0.00012804328555638403114) + w * (R(0.000046611406986069110729) + w * p);
    p = R(0.011549342038385889731) + w * (R(-0.0023351016429896274786) + w * p);
    p = R(0.23201366653465070272) + w * p;
#else
    real p = R(-2.643164798143971e-08) + w * R(6.98368085583212e-10);
    p = R(-3.1103913897823077e-06) + w * (R(4.10837202480252e-07) + w * p);
    p = R(3.5306409699842334e-05) + w * (R(8.092117241176311e-06) + w * p);
    p = R(-0.002344507956877351) + w * (R(-0.00011470227764220908) + w * p);
    p = R(0.23201313614845276) + w * (R(0.011552841402590275) + w * p);
#endif
    return w * p;
}

/* z/(x sqrt(w)) - 1 beyond, v = 1/sqrt(w) */
K_FN real k_erfinv_far(real v) {
#if K_IS_F64
    bool far = v < R(0.2357022603955158);
    real t = k_select(far, R(14.5) * v - R(2.43), R(12.0) * v - R(3.82));
    real p = k_select(far, R(3.9364198905846075101e-11), R(1.0400960922930625957e-10)) +
             t * k_select(far, R(-8.336502169904539897e-12), R(7.9560910342451277142e-11));
    p = k_select(far, R(-1.7587079744832836245e-10), R(5.4733823042563256735e-10)) +
        t * (k_select(far, R(1.2760693848436290896e-10), R(-1.1602042981737910807e-9)) + t * p);
    p = k_select(far, R(-2.2771740695809227724e-10), R(-1.5730926965006246415e-8)) +
        t * (k_select(far, R(-6.5603686364593650406e-10), R(7.230980520551230928e-9)) + t * p);
    p = k_select(far, R(1.7118575966735441652e-9), R(1.3082225780695884022e-7)) +
        t * (k_select(far, R(1.4619561562219795759e-9), R(-1.8374141365246510822e-8)) + t * p);
    p = k_select(far, R(-3.8710603769691693244e-9), R(-7.2778299923129677533e-7)) +
        t * (k_select(far, R(3.7078955028796905632e-9), R(-7.5387771971956219149e-8)) + t * p);
    p = k_select(far, R(-6.8664855358466657231e-8), R(3.6225720310732412805e-6)) +
        t * (k_select(far, R(1.9992720598067161984e-8), R(1.1621147728116475128e-6)) + t * p);
    p = k_select(far, R(-1.0931182864164538862e-6), R(-0.000022576528772411176223)) +
        t * (k_select(far, R(2.6791925177162187425e-7), R(-7.9429385216001134702e-6)) + t * p);
    p = k_select(far, R(-0.000036789757168391871857), R(0.00015440640866034455902)) +
        t * (k_select(far, R(5.1511783317980753365e-6), R(0.000034158030331821398196)) + t * p);
    p = k_select(far, R(-0.00047339102852306826611), R(0.0014625004256894916432)) +
        t * (k_select(far, R(0.00030852445465078859023), R(0.00051279555060941163008)) + t * p);
    p = k_select(far, R(-0.023529704243748619285), R(-0.053039790707561198206)) +
        t * (k_select(far, R(-0.013648484425754359587), R(-0.014917517141921292923)) + t * p);
    return p;
#else
    real t = R(8.0) * v - R(2.24);
    real p = R(1.6289146515191533e-05) + t * R(1.7474523701821454e-05);
    p = R(-0.00010279413982061669) + t * (R(-7.468242984032258e-05) + t * p);
    p = R(0.00037984648952260613) + t * (R(0.00010165874846279621) + t * p);
    p = R(0.0011133975349366665) + t * (R(0.00019633669580798596) + t * p);
    p = R(-0.023981761187314987) + t * (R(0.002039799466729164) + t * p);
    return R(-0.04591214284300804) + t * p;
#endif
}

/* x times z/x, w = -log(1 - x^2) in two numbers. The slope of z/x is near 1/4 on all of [0, 6.25]. */
K_FN real k_erfinv_of(real x, k_log_parts log_of) {
#if K_IS_F64
    real most = R(100.0);
#else
    real most = R(40.0);
#endif
    real w = k_min(k_max(-log_of.high, R(0.0)), most);
    real s = k_sqrt(k_max(w, R(6.25)));
    bool near = w < R(6.25);
    real start = k_select(near, R(0.88622692545275803425), s);
    real rest = k_select(near, k_erfinv_near(k_min(w, R(6.25))), s * k_erfinv_far(R(1.0) / s));
    real shift = k_select(near, R(-0.24), R(-0.5) / s) * log_of.low;
    real ratio = start + rest;
    real lost = k_sum_lost(start, rest, ratio) + shift;
    real z = x * ratio;
    return z + (k_product_lost(x, ratio, z) + x * lost);
}

/* x in (-1, 1): z with erf(z) = x. The ends give what their neighbours give. */
K_FN real k_erfinv(real x) {
    return k_erfinv_of(x, k_log_split((R(1.0) - x) * (R(1.0) + x)));
}

/* y in (0, 2): z with erfc(z) = y, down to y = 4e-18 (4e-44 in double): smaller y give the z of those. */
K_FN real k_erfcinv(real y) {
    return k_erfinv_of(R(1.0) - y, k_log_split(y * (R(2.0) - y)));
}

/* Worst errors, every float (tools/numerics/worst_error.c): erfinv 1.39 ulp at 0x1.200e5ap-7, erfcinv 2.09 ulp at
 * 0x1.f8b8ccp-26. Double: below 2.2 ulp on the points of tests/kernel/special_vectors.h. */

#endif
