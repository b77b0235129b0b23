/* kernel/beckmann_vcavity_hit.h: how much of a Beckmann surface of V-cavities i sees from below.
 *
 * With a = |i_z|/sqrt(ax^2 ix^2 + ay^2 iy^2) (Tokuyoshi 2021: a = -u) the printed sum of exponentials and
 * error functions is the mean of erfc over [a, 3a],
 *     H = (ierfc(a) - ierfc(3a))/(2a),  ierfc(x) = exp(-x^2) defect(x)/sqrt(pi)   (kernel/erf.h),
 * and of it the facets steeper than the slope 3 cot(theta) have erfc(3a). Near the horizon 1 - H is
 * a series in a^2, beyond it the difference is benign; deep below everything is kept relative to
 * exp(-a^2). Polynomial: tools/numerics/coefficients.py. */
#ifndef K_BECKMANN_VCAVITY_HIT_H
#define K_BECKMANN_VCAVITY_HIT_H

#include "erf.h"

/* H = scaled exp(-a^2) */
K_STRUCT(beckmann_vcavity_hit) {
    real scaled;
    real masked_share; /* erfc(3a)/H: the share of facets that are partly masked; 1 for a = 0 */
};

/* The mean of erf over [a, 3a], divided by a, a <= 1/4, y = a^2 */
K_FN real beckmann_vcavity_mean_erf(real y) {
#if K_IS_F64
    real p = R(17.342930897144522374) + y * R(-11.339059038239905976);
    p = R(20.591773887421181299) + y * (R(-20.051253895339503439) + y * p);
    p = R(15.423271004670049558) + y * (R(-18.928813254905038936) + y * p);
    p = R(6.8455002803543803455) + y * (R(-11.015129959360323718) + y * p);
    return R(2.256758334191025133) + y * (R(-3.7612638903183278314) + y * p);
#else
    real p = R(15.189269375981219374) + y * R(-15.474409718058243158);
    p = R(6.845392126765939873) + y * (R(-11.007678516790834251) + y * p);
    return R(2.2567583336907389083) + y * (R(-3.761263313492432533) + y * p);
#endif
}

K_FN beckmann_vcavity_hit beckmann_vcavity_hit_of(real a) {
    real near_a = k_min(a, R(0.25));
    real near_hit = R(1.0) - near_a * beckmann_vcavity_mean_erf(near_a * near_a);
    real far_a = k_max(a, R(0.25));
    real decay = k_exp(R(-8.0) * far_a * far_a);
    real far_hit = (k_erfcx_defect(far_a) - decay * k_erfcx_defect(R(3.0) * far_a)) *
                   (R(0.5) * K_INV_SQRT_PI / far_a);
    bool is_near = a < R(0.25);
    beckmann_vcavity_hit h;
    h.scaled = k_select(is_near, near_hit * k_exp_square(near_a), far_hit);
    h.masked_share = k_select(is_near, k_erfc(R(3.0) * near_a) / near_hit,
                              decay * k_erfcx_positive(R(3.0) * far_a) / far_hit);
    return h;
}

/* Worst errors, 4 10^5 values of a from 6e-6 to 16: H exp(a^2) 4.8e-07 relative at a = 0.2546 in float, 7.7e-16
 * at 0.2528 in double; the share 4.0e-06 at 2.84 and 7.4e-15 at 2.94. */

#endif
