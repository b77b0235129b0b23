/* kernel/multiscatter.h: what a microsurface reflects after more than one scattering, two
 * approximations for conductors. E is the albedo of one scattering with F = 1 toward a direction, E_avg
 * its average, F_avg = 2 * integral of F mu dmu. What is missing, 1 - E, is passed as such: for a small
 * roughness it would be lost in the rounding of E. */
#ifndef K_MULTISCATTER_H
#define K_MULTISCATTER_H

#include "scalar.h"

/* The colour of all scatterings but the first: F_avg^2 E_avg/(1 - F_avg (1 - E_avg)) (Hill 2018,
 * part 2). 1 for F_avg = 1. */
K_FN real multiscatter_fms(real f_avg, real missing_avg) {
    return f_avg * f_avg * (R(1.0) - missing_avg) / k_max(R(1.0) - f_avg * missing_avg, K_TINY);
}

/* f of the diffuse lobe, reciprocal: F_ms (1 - E(i)) (1 - E(o))/(pi (1 - E_avg)) (Kulla & Conty 2017).
 * 0 where nothing is missing. */
K_FN real multiscatter_kulla_conty(real f_ms, real missing_i, real missing_o, real missing_avg) {
    real lobe = f_ms * missing_i * missing_o * K_INV_PI / k_max(missing_avg, K_TINY);
    return k_select(missing_avg > R(1e3) * K_TINY, lobe, R(0.0));
}

/* Factor on the lobe of one scattering: 1 + F_0 (1 - E(i))/E(i), F_0 = F at normal incidence
 * (Turquin 2019). Not reciprocal. */
K_FN real multiscatter_turquin(real f0, real missing_i) {
    return R(1.0) + f0 * missing_i / k_max(R(1.0) - missing_i, K_EPS);
}

#endif
