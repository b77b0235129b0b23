/* lib/dielectric_turned.h: what unequal roughnesses make of the energy of lib/dielectric_energy.h, from a table.
 *
 * Kept is E of the compensated model over E of the round surface that is looked up for it, less 1, in multiples of LOBE_TURNED_STEP. With w and n the larger and the smaller alpha, t that toward the
 * direction, cosine and index are on the axes of dielectric_energy.h, measured against t, and
 *   alpha     sqrt(w)
 *   ratio     sqrt(n/w), from sqrt(1/10) on; equal roughnesses, the last one, are not kept: nothing to add
 *   azimuth   sqrt(t), from sqrt(n) to sqrt(w)
 * read cubically along all five. Made and measured by tools/numerics/dielectric_turned.c.
 *
 * Before including: a binding of the kernel language. */
#ifndef LOBE_DIELECTRIC_TURNED_H
#define LOBE_DIELECTRIC_TURNED_H

#include "../kernel/albedo_table.h"

enum {
    LOBE_TURNED_INDICES = 12, /* to each side, equal ones counted */
    LOBE_TURNED_ROWS = 2 * LOBE_TURNED_INDICES - 1,
    LOBE_TURNED_COSINES = 12,
    LOBE_TURNED_ALPHAS = 6,
    LOBE_TURNED_RATIOS = 4,
    LOBE_TURNED_AZIMUTHS = 7
};

#define LOBE_TURNED_STEP R(0x1p-14)

typedef int16_t lobe_turned_table[2][LOBE_TURNED_ROWS][LOBE_TURNED_COSINES][LOBE_TURNED_ALPHAS]
                                 [LOBE_TURNED_RATIOS - 1][LOBE_TURNED_AZIMUTHS];

#define LOBE_TURNED_LEAST_ROOT R(0.31622776601683793320) /* sqrt(1/10) */

/* A round surface to look up: squares of the roughness toward the direction and of that across, in shares
 * (1 + sin^2)/2 and (1 - sin^2)/2: of a dozen rules tried the one of the smallest worst error.
 * wide_share: square of the cosine of the azimuth from the wider axis; plane: sin^2. */
static inline real lobe_turned_single(real wide, real narrow, real wide_share, real plane) {
    real w2 = wide * wide;
    real n2 = narrow * narrow;
    real toward = wide_share * w2 + (R(1.0) - wide_share) * n2;
    real across = wide_share * n2 + (R(1.0) - wide_share) * w2;
    return k_sqrt(R(0.5) * ((toward + across) + plane * (toward - across)));
}

#endif
