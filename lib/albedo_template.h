/* lib/albedo_template.h: the closed fits and the compensation of lobe/albedo.h over the kernels, once
 * for each precision. Before including: as for reflection_template.h. */
#include "lobe/albedo.h"

#include "../kernel/albedo_fit.h"
#include "../kernel/albedo_fit_beckmann.h"
#include "../kernel/multiscatter.h"

real LOBE_NAME(albedo_fit_missing)(lobe_ndf ndf, lobe_g2 g2, real alpha, real mu) {
    const bool separable = g2 == LOBE_G2_SEPARABLE;
    return ndf == LOBE_NDF_BECKMANN ? albedo_fit_beckmann_missing(alpha, mu, separable)
                                    : albedo_fit_missing(alpha, mu, separable);
}

real LOBE_NAME(albedo_fit_missing_average)(lobe_ndf ndf, lobe_g2 g2, real alpha) {
    const bool separable = g2 == LOBE_G2_SEPARABLE;
    return ndf == LOBE_NDF_BECKMANN ? albedo_fit_beckmann_missing_average(alpha, separable)
                                    : albedo_fit_missing_average(alpha, separable);
}

real LOBE_NAME(multiscatter_fms)(real f_avg, real missing_avg) {
    return multiscatter_fms(f_avg, missing_avg);
}

real LOBE_NAME(multiscatter_kulla_conty)(real f_ms, real missing_i, real missing_o,
                                         real missing_avg) {
    return multiscatter_kulla_conty(f_ms, missing_i, missing_o, missing_avg);
}

real LOBE_NAME(multiscatter_turquin)(real f0, real missing_i) {
    return multiscatter_turquin(f0, missing_i);
}
