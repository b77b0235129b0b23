/* lib/albedo_table.h: the layout of the tables of albedos for F = 1 and what their nodes hold.
 *
 * All is kept of what is missing, 1 - E, and by its square root: that is smooth where E nears 1, and
 * keeps its digits there.
 * `round`: sqrt(1 - E) for equal roughnesses, over the row and the column of kernel/albedo_table.h; read
 * by cubic interpolation. `round_average`: the fourth root of 1 - E_avg.
 * `turned`: for unequal ones sqrt(1 - E) less that of a round surface of the roughness toward the
 * direction. With r^2 = (alpha_x + alpha_y)/2, n and w the square roots of the smaller and the larger
 * alpha:
 *   row      sqrt(r), from r = 1/100 to 1
 *   ratio    n from 1/100 to r
 *   column   that of the roughness toward the direction
 *   azimuth  square root of the roughness toward the direction, from n to w
 * read cubically in all four; kept as multiples of TURNED_STEP. `turned_average`: the fourth root of 1 - E_avg
 * less that of a round surface of roughness r, read cubically too.
 *
 * Before including: a binding of the kernel language. */
#ifndef LOBE_ALBEDO_TABLE_H
#define LOBE_ALBEDO_TABLE_H

#include "../kernel/albedo_table.h"

enum {
    ROUND_ROWS = 36,
    ROUND_COLUMNS = 76,
    TURNED_ROWS = 16,
    TURNED_RATIOS = 10,
    TURNED_COLUMNS = 22,
    TURNED_AZIMUTHS = 10
};

#define TURNED_STEP R(0x1p-15)

/* One for each lobe_ndf, lobe_masking and lobe_g2, in this order. */
typedef struct albedo_tables {
    float round[ROUND_ROWS][ROUND_COLUMNS];
    float round_average[ROUND_ROWS];
    int16_t turned[TURNED_ROWS][TURNED_RATIOS][TURNED_COLUMNS][TURNED_AZIMUTHS];
    float turned_average[TURNED_ROWS][TURNED_RATIOS];
} albedo_tables;

/* Square roots of the roughnesses of a row and ratio of `turned`. */
typedef struct albedo_axes {
    real mean, narrow, wide;
} albedo_axes;

static inline albedo_axes albedo_axes_of(int row, int ratio) {
    albedo_axes a;
    a.mean = k_square(R(0.1) + R(0.9) * (real)row / (TURNED_ROWS - 1));
    a.narrow = R(0.01) + (a.mean - R(0.01)) * (real)ratio / (TURNED_RATIOS - 1);
    a.wide = k_sqrt(R(2.0) * a.mean * a.mean - a.narrow * a.narrow);
    return a;
}

#endif
