/* kernel/fresnel.h: Fresnel reflectances and their averages 2 * integral of F(mu) mu dmu. */
#ifndef K_FRESNEL_H
#define K_FRESNEL_H

#include "log.h"
#include "scalar.h"

K_FN real fresnel_fifth_power(real x) {
    real x2 = x * x;
    return x2 * x2 * x;
}

/* Schlick 1994, eq. 15 */
K_FN real fresnel_schlick(real f0, real cos_i) {
    return f0 + (R(1.0) - f0) * fresnel_fifth_power(R(1.0) - k_saturate(cos_i));
}

K_FN real fresnel_schlick_average(real f0) {
    return f0 + (R(1.0) - f0) * R(0.047619047619047619);
}

/* What F82 takes away: b mu (1 - mu)^6, chosen so that F(1/7) = tint * Schlick(1/7). */
K_FN real fresnel_f82_b(real f0, real tint) {
    real at_82 = fresnel_schlick(f0, R(0.14285714285714285714));
    /* (1/7) (6/7)^6 */
    return at_82 * (R(1.0) - tint) * R(17.651384602194787380);
}

K_FN real fresnel_f82(real f0, real tint, real cos_i) {
    real mu = k_saturate(cos_i);
    real away = R(1.0) - mu;
    real sixth = fresnel_fifth_power(away) * away;
    return k_saturate(fresnel_schlick(f0, mu) - fresnel_f82_b(f0, tint) * mu * sixth);
}

/* Of F before it is clamped at 0: a dark tint on a dark f0 takes more than there is. */
K_FN real fresnel_f82_average(real f0, real tint) {
    real loss = fresnel_f82_b(f0, tint) * R(0.0079365079365079365);
    return k_max(fresnel_schlick_average(f0) - loss, R(0.0));
}

/* Exact dielectric of squared index n2m1 + 1. The numerators are written with g - c, g^2 = n2m1 + c^2,
 * so that they do not cancel for an index near 1. */
K_FN real fresnel_dielectric_gap(real n2m1, real cos_i) {
    real c = k_saturate(cos_i);
    real g2 = n2m1 + c * c;
    bool total = g2 <= R(0.0);
    real g = k_sqrt(k_max(g2, R(0.0)));
    real sum = k_max(g + c, K_TINY);
    real s = n2m1 / (sum * sum); /* (g - c)/(g + c) */
    /* p-polarised: r_p = r_s (c (g + c) - 1)/(c (g - c) + 1) up to sign */
    real ratio = (c * (g + c) - R(1.0)) / (c * n2m1 / sum + R(1.0));
    real value = R(0.5) * s * s * (R(1.0) + ratio * ratio);
    return k_select(total, R(1.0), k_saturate(value));
}

K_FN real fresnel_dielectric(real ior, real cos_i) {
    return fresnel_dielectric_gap((ior - R(1.0)) * (ior + R(1.0)), cos_i);
}

/* The average is smooth(n) + log term. Near n = 1 the smooth part cancels: there it is d p(d),
 * d = n - 1 in [0, 1/2] (tools/numerics/coefficients.py). */
K_FN real fresnel_average_near_one(real d) {
#if K_IS_F64
    real p = R(0.14988283249629284648) + d * R(-0.029810945997891402047);
    p = R(0.44593409900260875199) + d * (R(-0.34473220303671576556) + d * p);
    p = R(-0.25460946345714531198) + d * (R(-0.2502320894257352792) + d * p);
    p = R(-0.89280195540244115093) + d * (R(0.78216263855854438755) + d * p);
    p = R(0.60628880040799845345) + d * (R(0.34274268234932890834) + d * p);
    p = R(0.93601186781009517194) + d * (R(-1.2409962423577342136) + d * p);
    p = R(-1.066666666682402476) + d * (R(0.16875000105344607782) + d * p);
    p = R(0.33333333333333324272) + d * (R(0.79166666666675941724) + d * p);
#else
    real p = R(-0.27716587366938849797) + d * R(0.12755827615401192446);
    p = R(0.71635623988712202132) + d * (R(0.012482644464595029355) + d * p);
    p = R(0.93901527527868219916) + d * (R(-1.2641423704317866483) + d * p);
    p = R(-1.066657959141863523) + d * (R(0.1685239392381785486) + d * p);
    p = R(0.3333333336602081551) + d * (R(0.79166653572163337413) + d * p);
#endif
    return d * p;
}

/* The smooth part for n >= 3/2, x = 1/n. */
K_FN real fresnel_average_smooth(real x) {
    real x2 = x * x;
    real x4 = x2 * x2;
    real first = (R(1.0) - x) * (R(3.0) + x) / (R(6.0) * k_square(R(1.0) + x));
    real inner = (R(1.0) + x2) * (R(1.0) - x4);
    real second = R(2.0) * x * (R(1.0) + R(2.0) * x - x2) / inner;
    real third = R(8.0) * x2 * (R(1.0) + x4) / (inner * (R(1.0) - x4));
    return R(0.5) + first - second - third * k_log(x);
}

/* n >= 1 (Duntley 1942; facts re-derived) */
K_FN real fresnel_average_outside(real n) {
    real x = R(1.0) / n;
    real x2 = x * x;
    real gap = (R(1.0) - x) * (R(1.0) + x);
    real ring = R(1.0) + x2;
    real log_term = gap * gap / (ring * ring * ring) * k_log((R(1.0) - x) / (R(1.0) + x));
    real far = fresnel_average_smooth(k_min(x, R(0.7)));
    real smooth_part =
        k_select(n < R(1.5), fresnel_average_near_one(k_min(n, R(1.5)) - R(1.0)), far);
    return k_saturate(smooth_part + log_term);
}

/* Inside: 1 - (1 - F_avg(n))/n^2 with n the inverse index. */
K_FN real fresnel_dielectric_average(real ior) {
    real n = k_max(ior, R(1.0) / k_max(ior, K_TINY));
    real outside = fresnel_average_outside(n);
    real inside = R(1.0) - (R(1.0) - outside) / (n * n);
    return k_select(ior < R(1.0), inside, outside);
}

/* Exact unpolarised conductor of index n + i k. */
K_FN real fresnel_conductor(real n, real k, real cos_i) {
    real c = k_saturate(cos_i);
    real c2 = c * c;
    real s2 = R(1.0) - c2;
    real n2 = n * n;
    real k2 = k * k;
    real t0 = n2 - k2 - s2;
    real a2b2 = k_sqrt(t0 * t0 + R(4.0) * n2 * k2);
    /* a b = n k: of a small n the sum would cancel */
    real small = R(2.0) * n2 * k2 / k_max(a2b2 - t0, K_TINY);
    real a = k_sqrt(k_select(t0 < R(0.0), small, R(0.5) * (a2b2 + t0)));
    real sum_s = a2b2 + c2;
    real cross_s = R(2.0) * a * c;
    real r_s = (sum_s - cross_s) / k_max(sum_s + cross_s, K_TINY);
    real sum_p = c2 * a2b2 + s2 * s2;
    real cross_p = cross_s * s2;
    real r_p = r_s * (sum_p - cross_p) / k_max(sum_p + cross_p, K_TINY);
    return k_saturate(R(0.5) * (r_s + r_p));
}

/* 4 * integral of F(t^2) t^3 dt by Gauss's rule of 12 points: near grazing F turns like a root of mu. */
K_FN real fresnel_conductor_average(real n, real k) {
    real sum = R(7.3942299226975769581e-8) * fresnel_conductor(n, k, R(0.000085002552345815733853));
    sum =
        sum + R(0.000023566701939840387638) * fresnel_conductor(n, k, R(0.0022983751314813111136));
    sum = sum + R(0.00048753664411992414616) * fresnel_conductor(n, k, R(0.013236194835733074551));
    sum = sum + R(0.003569774745543504626) * fresnel_conductor(n, k, R(0.042576617713545591736));
    sum = sum + R(0.014747267884508245629) * fresnel_conductor(n, k, R(0.099909253414721962344));
    sum = sum + R(0.041693880360698576164) * fresnel_conductor(n, k, R(0.19130414739611565601));
    sum = sum + R(0.088740854182789153998) * fresnel_conductor(n, k, R(0.31653755590758457149));
    sum = sum + R(0.14938631475724847941) * fresnel_conductor(n, k, R(0.4677407524129021561));
    sum = sum + R(0.20313552200998915383) * fresnel_conductor(n, k, R(0.62989457200016303903));
    sum = sum + R(0.22188130216423344226) * fresnel_conductor(n, k, R(0.78313886903003776159));
    sum = sum + R(0.18456889747839710575) * fresnel_conductor(n, k, R(0.90641563150195616779));
    sum = sum + R(0.091765009128233346835) * fresnel_conductor(n, k, R(0.98164563679906506642));
    return sum;
}

#endif
