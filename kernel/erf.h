/* kernel/erf.h: the error function and its relatives, branch-free. One rational variable,
 * t = (x - 3)/(x + 3), brings [0, inf) to [-1, 1); there (1 + 2x) exp(x^2) erfc(x) is nearly constant
 * (Shepherd & Laframboise 1981), and so is
 * (1 + 7/4 x + 2 x^2)(1 - sqrt(pi) x exp(x^2) erfc(x)).
 * Polynomials: tools/numerics/coefficients.py. */
#ifndef K_ERF_H
#define K_ERF_H

#include "exp.h"

#define K_TWO_OVER_SQRT_PI R(1.12837916709551257390)
#define K_INV_SQRT_PI R(0.56418958354775628695)

/* 1 + t of x in [0, K_HUGE] */
K_FN real k_half_line(real x) {
    return R(2.0) * (x / (x + R(3.0)));
}

/* erf(x)/x - 1 on [0, 1], y = x^2 */
K_FN real k_erf_ratio(real y) {
#if K_IS_F64
    real p = R(1.3720064546777685604e-8) + y * R(-7.7958988270021422416e-10);
    p = R(1.644742470331736241e-6) + y * (R(-1.6208483801871705902e-7) + y * p);
    p = R(0.00012055294904839707917) + y * (R(-0.000014924736907419660338) + y * p);
    p = R(0.0052239776071164227321) + y * (R(-0.00085483259753896920806) + y * p);
    p = R(0.11283791670945006266) + y * (R(-0.02686617064323777036) + y * p);
    p = R(0.12837916709551256654) + y * (R(-0.37612638903183540438) + y * p);
    return p;
#else
    real p = R(-0.0008016867213882506) + y * R(7.87587123340927e-05);
    p = R(-0.02685420960187912) + y * (R(0.005189086776226759) + y * p);
    p = R(-0.3761262595653534) + y * (R(0.11283593624830246) + y * p);
    return R(0.12837916612625122) + y * p;
#endif
}

/* b of (1 + 2x) exp(x^2) erfc(x) = 1 + (1 + t)(1/sqrt(pi) - 1/2 + (1 - t) b): both ends exact */
K_FN real k_erfcx_bend(real t) {
#if K_IS_F64
    real p = R(5.1111064753899935565e-11) + t * R(1.8017998133714263113e-10);
    p = R(-1.2569129730719111554e-9) + t * (R(-1.8323668036627080158e-9) + t * p);
    p = R(1.2947923265389577035e-8) + t * (R(9.7648745553420463102e-9) + t * p);
    p = R(-9.0319650912203725134e-8) + t * (R(-3.6969768797801269503e-8) + t * p);
    p = R(5.2775248159968286909e-7) + t * (R(1.0964565547605836173e-7) + t * p);
    p = R(-2.9456294381069900583e-6) + t * (R(-2.5060278297627952837e-7) + t * p);
    p = R(0.000017155383968038613598) + t * (R(4.8247814978087080121e-7) + t * p);
    p = R(-0.00010794410627266705441) + t * (R(-4.4674929240382046988e-6) + t * p);
    p = R(0.00067188819371690524173) + t * (R(0.00010069240517946131616) + t * p);
    p = R(-0.0018575036258344805607) + t * (R(-0.0017879979662627548712) + t * p);
    p = R(-0.070165530969568995344) + t * (R(0.021982516953243156353) + t * p);
    p = R(-0.19981068967233753582) + t * (R(0.14125618036852222545) + t * p);
    return R(0.18881847472197336599) + t * p;
#else
    real p = R(-3.807312168646604e-06) + t * R(1.0649624528014101e-05);
    p = R(0.00010015242150984704) + t * (R(-0.00010137369099538773) + t * p);
    p = R(-0.0017877581994980574) + t * (R(0.0006686507258564234) + t * p);
    p = R(0.021982472389936447) + t * (R(-0.0018567654769867659) + t * p);
    p = R(0.141256183385849) + t * (R(-0.07016560435295105) + t * p);
    p = R(0.18881846964359283) + t * (R(-0.1998106837272644) + t * p);
    return p;
#endif
}

/* b of (1 + 7/4 x + 2x^2)(1 - sqrt(pi) x exp(x^2) erfc(x)) = 1 + (1 - t^2) b */
K_FN real k_defect_bend(real t) {
#if K_IS_F64
    real p = R(1.9717260958250515966e-9) + t * R(3.3250374071461788863e-10);
    p = R(-1.9941070816174790514e-8) + t * (R(-1.317295437689674297e-9) + t * p);
    p = R(1.0212792160526480422e-7) + t * (R(-9.662574961496550279e-9) + t * p);
    p = R(-3.5415719019809794698e-7) + t * (R(1.3135169841712245685e-7) + t * p);
    p = R(8.8825600845471401278e-7) + t * (R(-8.6434992465057977957e-7) + t * p);
    p = R(-1.3060798797036785223e-6) + t * (R(4.4843599857913145086e-6) + t * p);
    p = R(-1.2798605974424146397e-6) + t * (R(-0.0000216149845437641118) + t * p);
    p = R(5.496221453193605174e-6) + t * (R(0.00010662979264287617929) + t * p);
    p = R(0.00025309523403796548314) + t * (R(-0.00056275142047443066439) + t * p);
    p = R(-0.0051078359161810991525) + t * (R(0.0029746283092841634528) + t * p);
    p = R(0.054685508035519021734) + t * (R(-0.0094921158360563634148) + t * p);
    p = R(0.11613877219208768529) + t * (R(-0.11080861450068068858) + t * p);
    p = R(-0.12109454066093291319) + t * (R(-0.022676162620612995143) + t * p);
    return R(0.16851439978981312849) + t * p;
#else
    real p = R(-1.576705471961759e-06) + t * R(5.8275887568015605e-05);
    p = R(0.00026234416873194277) + t * (R(-0.000509955279994756) + t * p);
    p = R(-0.005113404709845781) + t * (R(0.0029449432622641325) + t * p);
    p = R(0.054687127470970154) + t * (R(-0.009483755566179752) + t * p);
    p = R(0.11613857001066208) + t * (R(-0.11080963909626007) + t * p);
    p = R(-0.12109453231096268) + t * (R(-0.022676128894090652) + t * p);
    return R(0.1685144007205963) + t * p;
#endif
}

/* (1 + 2a) exp(a^2) erfc(a) - 1 */
K_FN real k_erfcx_rise(real a) {
    real t1 = k_half_line(a);
    real b = k_erfcx_bend(t1 - R(1.0));
    return t1 * (R(0.06418958354775628695) + (R(2.0) - t1) * b);
}

/* The quotient of two sums of two numbers, (p + p_low)/(d + d_low), with what the division leaves. */
K_FN k_pair k_quotient_pair(real p, real p_low, real d, real d_low) {
    real v = p / d;
    real vd = v * d;
    real left = (p - vd) - k_product_lost(v, d, vd);
    return k_pair_of(v, ((left + p_low) - v * d_low) / d);
}

K_FN real k_quotient(real p, real p_low, real d, real d_low) {
    return k_quotient_pair(p, p_low, d, d_low).high;
}

/* exp(x^2) erfc(x) for x >= 0; K_HUGE and beyond count as K_HUGE */
K_FN real k_erfcx_positive(real x) {
    real a = k_min(k_max(x, R(0.0)), K_HUGE);
    real rest = k_erfcx_rise(a);
    real p = R(1.0) + rest;
    real d = R(1.0) + R(2.0) * a;
    return k_quotient(p, (R(1.0) - p) + rest, d, k_sum_lost(R(1.0), R(2.0) * a, d));
}

/* erfc of |x|: 2^n (1 + tail)(1 + rise)/(1 + 2a); the product as a sum of two numbers */
K_FN k_pair k_erfc_abs_pair(real x) {
    real a = k_min(k_abs(x), R(30.0));
    k_exp_parts e = k_exp_split_square(a, R(-1.0));
    real rise = k_erfcx_rise(a);
    real leading = R(1.0) + e.tail;
    real rest = rise + (rise * e.tail + ((R(1.0) - leading) + e.tail));
    real p = leading + rest;
    real d = R(1.0) + R(2.0) * a;
    real d_low = k_sum_lost(R(1.0), R(2.0) * a, d);
    k_pair q = k_quotient_pair(p, (leading - p) + rest, d, d_low);
    return k_pair_of(k_scale_by_power(q.high, e.n), k_scale_by_power(q.low, e.n));
}

K_FN real k_erfc_abs(real x) {
    return k_erfc_abs_pair(x).high;
}

K_FN real k_erfc(real x) {
    real y = k_erfc_abs(x);
    return k_select(x < R(0.0), R(2.0) - y, y);
}

K_FN real k_erf(real x) {
    real near = x + x * k_erf_ratio(k_min(x * x, R(1.0)));
    real far = R(1.0) - k_erfc_abs(x);
    return k_select(k_abs(x) < R(1.0), near, k_select(x < R(0.0), -far, far));
}

/* exp(x^2) erfc(x): 2 exp(x^2) - exp(x^2) erfc(|x|) for x < 0, infinite from about -9.4 (-26.6) down */
K_FN real k_erfcx(real x) {
    real y = k_erfcx_positive(k_abs(x));
    k_exp_parts e = k_exp_split_square(x, R(1.0));
    real leading = R(1.0) + e.tail;
    real lost = (R(1.0) - leading) + e.tail;
    real twice = k_scale_by_power(R(2.0) * leading, e.n);
    real below = (twice - y) + k_scale_by_power(R(2.0) * lost, e.n);
    return k_select(x < R(0.0), below, y);
}

/* 1 - sqrt(pi) x exp(x^2) erfc(x) for x >= 0, without that cancellation: about 1/(2 x^2) far out. It is
 * sqrt(pi) exp(x^2) times the integral of erfc from x on. */
K_FN k_pair k_erfcx_defect_pair(real x) {
    real a = k_min(k_max(x, R(0.0)), R(0.1) * k_sqrt(K_HUGE));
    real t1 = k_half_line(a);
    real rest = t1 * (R(2.0) - t1) * k_defect_bend(t1 - R(1.0));
    real p = R(1.0) + rest;
    real w = R(1.75) + R(2.0) * a;
    real aw = a * w;
    real d = R(1.0) + aw;
    real aw_low = k_product_lost(a, w, aw) + a * k_sum_lost(R(1.75), R(2.0) * a, w);
    return k_quotient_pair(p, (R(1.0) - p) + rest, d, k_sum_lost(R(1.0), aw, d) + aw_low);
}

K_FN real k_erfcx_defect(real x) {
    return k_erfcx_defect_pair(x).high;
}

/* Worst errors, every float on which the values are not 0, 1, 2 or a power of x (tools/numerics/worst_error.c):
 * erf 1.31 ulp at 0x1.fd1802p-1; erfc 1.61 ulp at 0x1.8ae4c8p+0, of negative numbers 1.0 ulp at -0x1.d58158p-2;
 * scaled erfc 1.45 ulp at 0x1.9f566ep-1 and 1.72 ulp at -0x1.072a6ep-1; its defect 1.03 ulp at 0x1.648e86p+2.
 * Double: below 1.3 ulp on the points of tests/kernel/special_vectors.h. */

#endif
