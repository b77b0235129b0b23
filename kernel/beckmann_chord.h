/* kernel/beckmann_chord.h: a Gaussian slope of unit roughness on a chord, |y - centre| < w. */
#ifndef K_BECKMANN_CHORD_H
#define K_BECKMANN_CHORD_H

#include "erf.h"
#include "erfinv.h"

K_STRUCT(beckmann_chord) {
    real centre;
    real w;
};

/* exp(-(centre + h w)^2) + exp(-(centre - h w)^2) */
K_FN real beckmann_chord_pair(beckmann_chord chord, real h) {
    return k_exp_minus_square(chord.centre + h * chord.w) +
           k_exp_minus_square(chord.centre - h * chord.w);
}

/* Share of the Gaussian on the chord; on a short one, where it hardly changes, by Gauss-Legendre
 * quadrature. */
K_FN real beckmann_chord_share(beckmann_chord chord) {
#if K_IS_F64
    real short_width = R(0.1);
    real short_rise = R(0.0625);
#else
    real short_width = R(0.5);
    real short_rise = R(0.25);
#endif
    real a = k_abs(chord.centre);
    real exact = R(0.5) * (k_erfc(a - chord.w) - k_erfc(a + chord.w));
    real sum = R(0.56888888888888888889) * k_exp_minus_square(chord.centre) +
               R(0.47862867049936646804) * beckmann_chord_pair(chord, R(0.53846931010568309104)) +
               R(0.23692688505618908751) * beckmann_chord_pair(chord, R(0.90617984593866399280));
    bool is_short = k_and(chord.w < short_width, a * chord.w < short_rise);
    return k_max(k_select(is_short, K_INV_SQRT_PI * chord.w * sum, exact), K_TINY);
}

/* Distance of a slope on the chord from its centre; the side of the chord that is nearer to 0 keeps its
 * digits. */
K_FN real beckmann_chord_offset(beckmann_chord chord, real u) {
    real a = k_abs(chord.centre);
    bool mirrored = chord.centre < R(0.0);
    real v = k_select(mirrored, u, R(1.0) - u);
    real share = v * k_erfc(a - chord.w) + (R(1.0) - v) * k_erfc(a + chord.w);
    real most = chord.w * (R(1.0) - R(4.0) * K_EPS);
    real offset = k_min(k_max(k_erfcinv(share) - a, -most), most);
    return k_select(mirrored, -offset, offset);
}

#endif
