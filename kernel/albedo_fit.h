/* kernel/albedo_fit.h: what is missing of the albedo of GGX for F = 1, in closed form, alpha from 1e-4
 * to 1.
 *
 * With t = sqrt(mu), r = sqrt(alpha), s = t + r, x = t/s:
 *   1 - E = (1 - x)^4 sum_k s^k N_k(x)/sum_k s^k D_k(x)
 * in terms that depend on t/r alone near (0, 0), where a scaled surface is seen at a scaled angle.
 * 1 - E_avg is a rational function of r. Coefficients: tools/numerics/albedo_fit.py.
 *
 * Largest errors for mu from 1e-6 to 1 (the same script): correlated 9.4e-4, 0.28 % of E; separable
 * 5.1e-4, 0.16 %; 1 - E_avg 2.5e-4 and 2.4e-6, for alpha from 1e-3 0.2 % of it. In float, correlated, at most
 * 9.0e-4 in all; separable 1.2e-3 (rounding 8.2e-4 at alpha 0.89, mu 1). */
#ifndef K_ALBEDO_FIT_H
#define K_ALBEDO_FIT_H

#include "scalar.h"

K_FN real albedo_correlated_above0(real x) {
    real p = R(1.10473296);
    p = R(0.238167576) + x * (R(3.4442327) + x * p);
    p = R(-3.379156e-05) + x * p;
    return x * p;
}

K_FN real albedo_correlated_above1(real x) {
    real p = R(14.7307229);
    p = R(4.96296472) + x * (R(-21.7025298) + x * p);
    p = R(0.000282313025) + x * (R(-0.671976853) + x * p);
    return x * p;
}

K_FN real albedo_correlated_above2(real x) {
    real p = R(59.9826776);
    p = R(126.061024) + x * (R(-157.443282) + x * p);
    p = R(1.18611605) + x * (R(-32.3775373) + x * p);
    p = R(-0.000309574868) + x * p;
    return x * p;
}

K_FN real albedo_correlated_above3(real x) {
    real p = R(173.127331);
    p = R(635.741386) + x * (R(-532.042832) + x * p);
    p = R(60.6036893) + x * (R(-332.812885) + x * p);
    p = R(0.000673284855) + x * (R(1.72289319) + x * p);
    return x * p;
}

K_FN real albedo_correlated_below0(real x) {
    real p = R(147.913909);
    p = R(257.814944) + x * (R(-310.602171) + x * p);
    p = R(12.8042088) + x * (R(-98.0569809) + x * p);
    p = R(1.0) + x * p;
    return p;
}

K_FN real albedo_correlated_below1(real x) {
    real p = R(-39.9036374);
    p = R(95.0904635) + x * (R(-4.46902581) + x * p);
    p = R(29.6416389) + x * (R(-89.66068) + x * p);
    p = R(-1.43766306) + x * (R(-0.383952838) + x * p);
    return p;
}

K_FN real albedo_correlated_below2(real x) {
    real p = R(-51.0357659);
    p = R(-417.824493) + x * (R(258.703921) + x * p);
    p = R(-120.074379) + x * (R(315.529761) + x * p);
    p = R(-3.07305049) + x * (R(22.616243) + x * p);
    p = R(0.652801915) + x * p;
    return p;
}

K_FN real albedo_correlated_average_above(real x) {
    real p = R(-81.2408794);
    p = R(-258.199752) + x * (R(252.765991) + x * p);
    p = R(9.84941481) + x * (R(93.1803434) + x * p);
    p = R(0.0128424669) + x * p;
    return x * x * x * p;
}

K_FN real albedo_correlated_average_below(real x) {
    real p = R(55.4932573);
    p = R(0.0424803363) + x * (R(-52.5873579) + x * p);
    p = R(1.0) + x * (R(23.7648427) + x * p);
    return p;
}

K_FN real albedo_separable_above0(real x) {
    real p = R(-0.0533632522);
    p = R(-0.199734257) + x * (R(0.231802903) + x * p);
    p = R(0.0643748451) + x * p;
    return p;
}

K_FN real albedo_separable_above1(real x) {
    real p = R(-0.426288529);
    p = R(-0.898482556) + x * (R(0.994214498) + x * p);
    p = R(-0.0780006275) + x * (R(0.38402006) + x * p);
    return p;
}

K_FN real albedo_separable_above2(real x) {
    real p = R(-1.71329336);
    p = R(-4.378891) + x * (R(4.42984539) + x * p);
    p = R(-0.440842895) + x * (R(2.03176173) + x * p);
    p = R(0.0411983109) + x * p;
    return p;
}

K_FN real albedo_separable_above3(real x) {
    real p = R(0.260221314);
    p = R(-1.79681165) + x * (R(0.930017048) + x * p);
    p = R(2.06511217) + x * (R(-0.362336753) + x * p);
    p = R(0.238093199) + x * (R(-1.25474182) + x * p);
    return p;
}

K_FN real albedo_separable_below0(real x) {
    real p = R(-5.5805025);
    p = R(-28.8598979) + x * (R(20.4022692) + x * p);
    p = R(-7.05966889) + x * (R(20.1794843) + x * p);
    p = R(1.0) + x * p;
    return p;
}

K_FN real albedo_separable_below1(real x) {
    real p = R(-9.42218005);
    p = R(-63.6159606) + x * (R(37.4486099) + x * p);
    p = R(-31.2285031) + x * (R(58.841754) + x * p);
    p = R(-1.11532703) + x * (R(9.0274874) + x * p);
    return p;
}

K_FN real albedo_separable_below2(real x) {
    real p = R(1.5998841);
    p = R(-37.5370333) + x * (R(6.72800494) + x * p);
    p = R(-56.6786958) + x * (R(64.7016354) + x * p);
    p = R(-7.25406084) + x * (R(27.6857485) + x * p);
    p = R(0.803780821) + x * p;
    return p;
}

K_FN real albedo_separable_average_above(real x) {
    real p = R(-28.3846101);
    p = R(-195.126896) + x * (R(123.807839) + x * p);
    p = R(10.0672754) + x * (R(122.364245) + x * p);
    p = R(0.0120644984) + x * p;
    return x * x * x * p;
}

K_FN real albedo_separable_average_below(real x) {
    real p = R(45.5517997);
    p = R(31.1919502) + x * (R(-52.6186335) + x * p);
    p = R(1.0) + x * (R(27.3962504) + x * p);
    return p;
}

K_FN real albedo_fit_root(real alpha) {
    return k_sqrt(k_min(k_max(alpha, R(1e-4)), R(1.0)));
}

K_FN real albedo_correlated_missing(real s, real x) {
    real above = albedo_correlated_above2(x) + s * albedo_correlated_above3(x);
    above = albedo_correlated_above0(x) + s * (albedo_correlated_above1(x) + s * above);
    real below = albedo_correlated_below1(x) + s * albedo_correlated_below2(x);
    return above / (albedo_correlated_below0(x) + s * below);
}

K_FN real albedo_separable_missing(real s, real x) {
    real above = albedo_separable_above2(x) + s * albedo_separable_above3(x);
    above = albedo_separable_above0(x) + s * (albedo_separable_above1(x) + s * above);
    real below = albedo_separable_below1(x) + s * albedo_separable_below2(x);
    return above / (albedo_separable_below0(x) + s * below);
}

/* 1 - E */
K_FN real albedo_fit_missing(real alpha, real mu, bool separable) {
    real r = albedo_fit_root(alpha);
    real s = k_sqrt(k_saturate(mu)) + r;
    real rest = r / s;
    real x = R(1.0) - rest;
    real missing =
        k_select(separable, albedo_separable_missing(s, x), albedo_correlated_missing(s, x));
    return k_saturate(k_square(k_square(rest)) * missing);
}

/* 1 - E_avg */
K_FN real albedo_fit_missing_average(real alpha, bool separable) {
    real r = albedo_fit_root(alpha);
    real correlated_e = albedo_correlated_average_above(r) / albedo_correlated_average_below(r);
    real separable_e = albedo_separable_average_above(r) / albedo_separable_average_below(r);
    return k_select(separable, separable_e, correlated_e);
}

#endif
