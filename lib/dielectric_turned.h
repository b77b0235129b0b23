/* lib/dielectric_turned.h: what unequal roughnesses make of the energy of lib/dielectric_energy.h, from a table.
 *
 * Kept is E of the compensated model over E of the round surface that is looked up for it, less 1, in
 * multiples of LOBE_TURNED_STEP. With w and n the larger and the smaller alpha, t that toward the direction,
 * cosine and index are on the axes of lib/dielectric_axes.h, measured
 * against t, and
 *   alpha     sqrt(w)
 *   ratio     sqrt(n/w), from sqrt(1/10) on; equal roughnesses, the last one, are not kept: nothing to add
 *   azimuth   sqrt(t), from sqrt(n) to sqrt(w)
 * read cubically along all five. Made by tools/numerics/dielectric_turned.c, measured by
 * tools/numerics/dielectric_furnace.c.
 *
 * Before including: a binding of the kernel language. */
#ifndef LOBE_DIELECTRIC_TURNED_H
#define LOBE_DIELECTRIC_TURNED_H

#include "../kernel/albedo_table.h"

enum {
    LOBE_TURNED_INDICES = 12, /* to each side, equal ones counted */
    LOBE_TURNED_ROWS = 2 * LOBE_TURNED_INDICES - 1,
    LOBE_TURNED_COSINES = 14,
    LOBE_TURNED_ALPHAS = 6,
    LOBE_TURNED_RATIOS = 5,
    LOBE_TURNED_AZIMUTHS = 12
};

#define LOBE_TURNED_STEP R(0x1p-14)

typedef int16_t lobe_turned_table[2][LOBE_TURNED_ROWS][LOBE_TURNED_COSINES][LOBE_TURNED_ALPHAS]
                                 [LOBE_TURNED_RATIOS - 1][LOBE_TURNED_AZIMUTHS];

#define LOBE_TURNED_LEAST_ROOT R(0.31622776601683793320) /* sqrt(1/10) */

/* Roughness toward a direction; share: square of the cosine of the azimuth from the wider axis. */
static inline real lobe_turned_toward(real wide, real narrow, real share) {
    return k_sqrt(share * wide * wide + (R(1.0) - share) * narrow * narrow);
}

/* On the axis of azimuths. */
static inline real lobe_turned_azimuth(real wide, real narrow, real toward) {
    real least = k_sqrt(narrow);
    return k_saturate((k_sqrt(toward) - least) / k_max(k_sqrt(wide) - least, R(1e-6)));
}

/* A round surface to look up: squares of the roughness toward the direction and of that across, in shares
 * (1 + sin^2)/2 and (1 - sin^2)/2: of a dozen rules tried the one of the smallest worst error.
 * plane: sin^2. */
static inline real lobe_turned_single(real wide, real narrow, real share, real plane) {
    real w2 = wide * wide;
    real n2 = narrow * narrow;
    real toward = share * w2 + (R(1.0) - share) * n2;
    real across = share * n2 + (R(1.0) - share) * w2;
    return k_sqrt(R(0.5) * ((toward + across) + plane * (toward - across)));
}

#endif
