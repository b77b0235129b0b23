/* kernel/erf.h: the error function and its relatives, branch-free. One rational variable,
 * t = (x - 3)/(x + 3), brings [0, inf) to [-1, 1); there (1 + 2x) exp(x^2) erfc(x) is nearly constant
 * (Shepherd & Laframboise 1981), and (1 + 2x)^2 times what it leaves of its limit nearly so.
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

/* b of (1 + 2x)^2 (1 - sqrt(pi) x exp(x^2) erfc(x)) = 1 + (1 + t)(1/2 + (1 - t) b) */
K_FN real k_ierfcx_bend(real t) {
#if K_IS_F64
    real p = R(3.9161876785518960051e-9) + t * R(5.6193875645771364336e-10);
    p = R(-3.9176107998990988947e-8) + t * (R(-1.5593604685436922157e-9) + t * p);
    p = R(1.9696475038144569078e-7) + t * (R(-2.5021806583574228117e-8) + t * p);
    p = R(-6.5922226752197310916e-7) + t * (R(2.8291669723448253678e-7) + t * p);
    p = R(1.5105303782567442407e-6) + t * (R(-1.7770533243817954793e-6) + t * p);
    p = R(-1.288066115109636665e-6) + t * (R(8.9954747058151978292e-6) + t * p);
    p = R(-9.290045622667968385e-6) + t * (R(-0.000042648913449618328902) + t * p);
    p = R(0.000049050820913206981426) + t * (R(0.00020851794738658837059) + t * p);
    p = R(0.0002588522013863517542) + t * (R(-0.0011042530375339252077) + t * p);
    p = R(-0.0085316089151416096928) + t * (R(0.0059988884354608744094) + t * p);
    p = R(0.10270728770585937842) + t * (R(-0.022144942861202432819) + t * p);
    p = R(0.085623054076902445661) + t * (R(-0.17180919226265292053) + t * p);
    p = R(-0.68209354336822093623) + t * (R(0.24642741462924224864) + t * p);
    return R(0.86112187998766364108) + t * p;
#else
    real p = R(1.947256714629475e-05) + t * R(0.00011357980838511139);
    p = R(0.0002943837898783386) + t * (R(-0.0010007784003391862) + t * p);
    p = R(-0.008552382700145245) + t * (R(0.005940763745456934) + t * p);
    p = R(0.10271327197551727) + t * (R(-0.022128580138087273) + t * p);
    p = R(0.08562227338552475) + t * (R(-0.17181114852428436) + t * p);
    p = R(-0.6820935010910034) + t * (R(0.24642741680145264) + t * p);
    return R(0.8611218929290771) + t * p;
#endif
}

/* (1 + 2a) exp(a^2) erfc(a) - 1 */
K_FN real k_erfcx_rise(real a) {
    real t1 = k_half_line(a);
    real b = k_erfcx_bend(t1 - R(1.0));
    return t1 * (R(0.06418958354775628695) + (R(2.0) - t1) * b);
}

/* The quotient of two sums of two numbers, (p + p_low)/(1 + 2a): what 1 + 2a loses is carried too. */
K_FN real k_over_one_plus_twice(real p, real p_low, real a) {
    real d = R(1.0) + R(2.0) * a;
    real from_a = d - R(1.0);
    real d_low = (R(1.0) - (d - from_a)) + (R(2.0) * a - from_a);
    real v = p / d;
    return v + (p_low - v * d_low) / d;
}

/* exp(x^2) erfc(x) for x >= 0; K_HUGE and beyond count as K_HUGE */
K_FN real k_erfcx_positive(real x) {
    real a = k_min(k_max(x, R(0.0)), K_HUGE);
    real rest = k_erfcx_rise(a);
    real p = R(1.0) + rest;
    return k_over_one_plus_twice(p, (R(1.0) - p) + rest, a);
}

/* erfc of |x|: 2^n (1 + tail)(1 + rise)/(1 + 2a); the product as a sum of two numbers */
K_FN real k_erfc_abs(real x) {
    real a = k_min(k_abs(x), R(30.0));
    k_exp_parts e = k_exp_split_square(a, R(-1.0));
    real rise = k_erfcx_rise(a);
    real leading = R(1.0) + e.tail;
    real rest = rise + (rise * e.tail + ((R(1.0) - leading) + e.tail));
    real p = leading + rest;
    real p_low = (leading - p) + rest;
    return k_scale_by_power(k_over_one_plus_twice(p, p_low, a), e.n);
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
K_FN real k_erfcx_defect(real x) {
    real a = k_min(k_max(x, R(0.0)), R(0.1) * k_sqrt(K_HUGE));
    real t1 = k_half_line(a);
    real d = R(1.0) + R(2.0) * a;
    real b = k_ierfcx_bend(t1 - R(1.0));
    return (R(1.0) + t1 * (R(0.5) + (R(2.0) - t1) * b)) / (d * d);
}

#endif
