/* kernel/albedo_fit_beckmann.h: what is missing of the albedo of Beckmann for F = 1, in closed form, alpha from
 * 1e-4 to 1.
 *
 * A facet of slope tan(e/2), e the elevation of i, reflects i to the horizon: q is that slope over alpha.
 *   1 - E = exp(-q^2/2) sum_k (2 alpha^2 - 1)^k P_k(2 q/(1 + q) - 1)
 * times q/(1 + q) for the correlated G2, of which E = 1 at the horizon. 1 - E_avg is alpha^2 times a polynomial
 * of 2 alpha - 1. Coefficients: tools/numerics/albedo_fit.py.
 *
 * Largest errors (the same script): correlated 7.7e-04, 0.17 % of E; separable 8.6e-04, 0.18 %; 1 - E_avg
 * 7e-05, 0.04 % of it. In float 8.2e-04 and 8.1e-04 for alpha and mu from 1e-3. */
#ifndef K_ALBEDO_FIT_BECKMANN_H
#define K_ALBEDO_FIT_BECKMANN_H

#include "exp.h"
#include "scalar.h"

K_FN real albedo_beckmann_correlated0(real x) {
    real p = R(-4.94718193);
    p = R(-17.8441281) + x * (R(-17.5679554) + x * p);
    p = R(15.2175448) + x * (R(2.13874744) + x * p);
    p = R(4.04032182) + x * (R(10.945823) + x * p);
    p = R(0.823250162) + x * (R(1.10828739) + x * p);
    return p;
}

K_FN real albedo_beckmann_correlated1(real x) {
    real p = R(-238.906334);
    p = R(-812.787065) + x * (R(-719.491183) + x * p);
    p = R(-76.702736) + x * (R(-411.53953) + x * p);
    p = R(6.51820673) + x * (R(7.49913627) + x * p);
    p = R(1.15660167) + x * (R(2.95825258) + x * p);
    return p;
}

K_FN real albedo_beckmann_correlated2(real x) {
    real p = R(-251.586029);
    p = R(-1016.24029) + x * (R(-798.379881) + x * p);
    p = R(-260.713555) + x * (R(-674.814349) + x * p);
    p = R(-13.4665664) + x * (R(-66.3651929) + x * p);
    p = R(0.236615325) + x * (R(-1.66424515) + x * p);
    return p;
}

K_FN real albedo_beckmann_correlated3(real x) {
    real p = R(624.496391);
    p = R(2193.99661) + x * (R(1912.70247) + x * p);
    p = R(203.95692) + x * (R(1121.5664) + x * p);
    p = R(-18.2951921) + x * (R(-26.644788) + x * p);
    p = R(-0.685054239) + x * (R(-4.97684813) + x * p);
    return p;
}

K_FN real albedo_beckmann_correlated4(real x) {
    real p = R(963.020979);
    p = R(3798.47323) + x * (R(3038.96701) + x * p);
    p = R(856.212085) + x * (R(2418.83282) + x * p);
    p = R(26.7711196) + x * (R(182.204842) + x * p);
    p = R(-0.136184886) + x * (R(2.26716066) + x * p);
    return p;
}

K_FN real albedo_beckmann_correlated5(real x) {
    real p = R(-89.8315133);
    p = R(-143.911581) + x * (R(-246.144619) + x * p);
    p = R(246.280473) + x * (R(161.153859) + x * p);
    p = R(32.4155995) + x * (R(124.489849) + x * p);
    p = R(0.509452456) + x * (R(5.57688998) + x * p);
    return p;
}

K_FN real albedo_beckmann_correlated6(real x) {
    real p = R(-683.983221);
    p = R(-2584.34056) + x * (R(-2122.6927) + x * p);
    p = R(-517.143628) + x * (R(-1575.56074) + x * p);
    p = R(-12.0374906) + x * (R(-96.7520993) + x * p);
    p = R(0.0451897778) + x * (R(-0.912549788) + x * p);
    return p;
}

K_FN real albedo_beckmann_correlated7(real x) {
    real p = R(-273.655827);
    p = R(-1056.0431) + x * (R(-846.538964) + x * p);
    p = R(-280.753073) + x * (R(-700.359112) + x * p);
    p = R(-15.2413797) + x * (R(-75.8113336) + x * p);
    p = R(-0.173069118) + x * (R(-2.31567434) + x * p);
    return p;
}

K_FN real albedo_beckmann_correlated_average(real x) {
    real p = R(0.000180738921);
    p = R(0.000341128284) + x * (R(-0.00120746276) + x * p);
    p = R(0.0105285883) + x * (R(-0.00303604159) + x * p);
    p = R(-0.0810735653) + x * (R(-0.0158841436) + x * p);
    p = R(0.426422482) + x * p;
    return p;
}

K_FN real albedo_beckmann_separable0(real x) {
    real p = R(-3.10777102);
    p = R(-4.42536774) + x * (R(-8.29933096) + x * p);
    p = R(11.7260422) + x * (R(7.26929446) + x * p);
    p = R(2.60494802) + x * (R(7.21474029) + x * p);
    p = R(0.411800359) + x * (R(0.976155573) + x * p);
    return p;
}

K_FN real albedo_beckmann_separable1(real x) {
    real p = R(-47.9297646);
    p = R(-244.402795) + x * (R(-173.575584) + x * p);
    p = R(-49.4785701) + x * (R(-164.766071) + x * p);
    p = R(4.48970241) + x * (R(-0.569012416) + x * p);
    p = R(0.578501811) + x * (R(2.15085677) + x * p);
    return p;
}

K_FN real albedo_beckmann_separable2(real x) {
    real p = R(6.65927697);
    p = R(-67.9224784) + x * (R(-3.86123679) + x * p);
    p = R(-103.571782) + x * (R(-125.294227) + x * p);
    p = R(-10.4162855) + x * (R(-45.0735049) + x * p);
    p = R(0.120491851) + x * (R(-0.907777051) + x * p);
    return p;
}

K_FN real albedo_beckmann_separable3(real x) {
    real p = R(194.507301);
    p = R(1074.48717) + x * (R(728.20983) + x * p);
    p = R(273.595143) + x * (R(779.897546) + x * p);
    p = R(-9.60744847) + x * (R(27.8704043) + x * p);
    p = R(-0.362605501) + x * (R(-3.36450859) + x * p);
    return p;
}

K_FN real albedo_beckmann_separable4(real x) {
    real p = R(111.16563);
    p = R(939.345915) + x * (R(503.375879) + x * p);
    p = R(525.477555) + x * (R(930.656233) + x * p);
    p = R(28.388663) + x * (R(168.45081) + x * p);
    p = R(-0.0752708721) + x * (R(1.81955428) + x * p);
    return p;
}

K_FN real albedo_beckmann_separable5(real x) {
    real p = R(-138.002134);
    p = R(-675.846913) + x * (R(-496.141196) + x * p);
    p = R(-66.0416911) + x * (R(-406.625248) + x * p);
    p = R(22.1873752) + x * (R(41.2204747) + x * p);
    p = R(0.30554819) + x * (R(4.15066905) + x * p);
    return p;
}

K_FN real albedo_beckmann_separable6(real x) {
    real p = R(-131.911719);
    p = R(-975.323877) + x * (R(-559.591633) + x * p);
    p = R(-468.688297) + x * (R(-898.717429) + x * p);
    p = R(-20.5272296) + x * (R(-136.963377) + x * p);
    p = R(0.0267396352) + x * (R(-1.15007241) + x * p);
    return p;
}

K_FN real albedo_beckmann_separable7(real x) {
    real p = R(-25.7392738);
    p = R(-261.993509) + x * (R(-126.502742) + x * p);
    p = R(-193.749644) + x * (R(-294.649079) + x * p);
    p = R(-16.7546665) + x * (R(-75.1492264) + x * p);
    p = R(-0.118581312) + x * (R(-2.05263836) + x * p);
    return p;
}

K_FN real albedo_beckmann_separable_average(real x) {
    real p = R(-0.000174565892);
    p = R(0.000731050859) + x * (R(-0.00161247084) + x * p);
    p = R(0.0110274892) + x * (R(-0.00244072163) + x * p);
    p = R(-0.0800435415) + x * (R(-0.0148549471) + x * p);
    p = R(0.431105854) + x * p;
    return p;
}

/* sum_k w^k P_k(v) */
K_FN real albedo_beckmann_correlated(real w, real v) {
    real p = albedo_beckmann_correlated7(v);
    p = albedo_beckmann_correlated5(v) + w * (albedo_beckmann_correlated6(v) + w * p);
    p = albedo_beckmann_correlated3(v) + w * (albedo_beckmann_correlated4(v) + w * p);
    p = albedo_beckmann_correlated1(v) + w * (albedo_beckmann_correlated2(v) + w * p);
    return albedo_beckmann_correlated0(v) + w * p;
}

K_FN real albedo_beckmann_separable(real w, real v) {
    real p = albedo_beckmann_separable7(v);
    p = albedo_beckmann_separable5(v) + w * (albedo_beckmann_separable6(v) + w * p);
    p = albedo_beckmann_separable3(v) + w * (albedo_beckmann_separable4(v) + w * p);
    p = albedo_beckmann_separable1(v) + w * (albedo_beckmann_separable2(v) + w * p);
    return albedo_beckmann_separable0(v) + w * p;
}

K_FN real albedo_beckmann_alpha(real alpha) {
    return k_min(k_max(alpha, R(1e-4)), R(1.0));
}

/* 1 - E */
K_FN real albedo_fit_beckmann_missing(real alpha, real mu, bool separable) {
    real a = albedo_beckmann_alpha(alpha);
    real c = k_saturate(mu);
    real rise = R(1.0) + k_sqrt(R(1.0) - c * c);
    real q = c / (rise * a);
    real share = q / (R(1.0) + q);
    real v = R(2.0) * share - R(1.0);
    real w = R(2.0) * a * a - R(1.0);
    real missing = k_select(separable, albedo_beckmann_separable(w, v),
                            share * albedo_beckmann_correlated(w, v));
    return k_saturate(k_exp(R(-0.5) * k_min(q * q, R(150.0))) * missing);
}

/* 1 - E_avg */
K_FN real albedo_fit_beckmann_missing_average(real alpha, bool separable) {
    real a = albedo_beckmann_alpha(alpha);
    real w = R(2.0) * a - R(1.0);
    real average = k_select(separable, albedo_beckmann_separable_average(w),
                            albedo_beckmann_correlated_average(w));
    return a * a * average;
}

#endif
