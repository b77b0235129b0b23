/* tools/numerics/dielectric_turned.c: lib/dielectric_turned.inc, the table of lib/dielectric_turned.c.
 *
 *     cc -O2 -ffp-contract=off -I. -Iinclude tools/numerics/dielectric_turned.c -lm -o dielectric_turned
 *     ./dielectric_turned > turned.inc && mv turned.inc lib/dielectric_turned.inc      # 45 seconds
 *
 * The same bytes from every compiler: nothing of the C library but the square root. Its error is measured by
 * tools/numerics/dielectric_furnace.c. */
#include "dielectric_sum.h"

#include "lib/dielectric_axes.h"
#include "lib/dielectric_turned.h"

#include <stdio.h>

static lobe_turned_table table;

static both once(dielectric_sum *q, double share, double cosine, double wide, double narrow,
                 double eta) {
    const double sine = k_sqrt((1 - cosine) * (1 + cosine));
    const v3 wi = v3_of(sine * k_sqrt(share), sine * k_sqrt(1 - share), cosine);
    sum_toward(q, wi, wide, narrow, eta);
    return sum_of(q);
}

static void fill(dielectric_sum *q, int row, int column, int alpha, int ratio, int azimuth) {
    const double root = (double)alpha / (LOBE_TURNED_ALPHAS - 1);
    const double wide = k_max(root * root, LOBE_ENERGY_LEAST_ALPHA);
    const double part =
        LOBE_TURNED_LEAST_ROOT + (1 - LOBE_TURNED_LEAST_ROOT) * ratio / (LOBE_TURNED_RATIOS - 1);
    const double narrow = k_max(wide * part * part, LOBE_ENERGY_LEAST_ALPHA);
    const double turn = (double)azimuth / (LOBE_TURNED_AZIMUTHS - 1);
    const double root_n = k_sqrt(narrow), root_t = root_n + (k_sqrt(wide) - root_n) * turn;
    const double toward = root_t * root_t, least2 = narrow * narrow;
    const double share =
        k_saturate((toward * toward - least2) / k_max(wide * wide - least2, K_TINY));
    const double step = (double)(row - (LOBE_TURNED_INDICES - 1)) / (LOBE_TURNED_INDICES - 1);
    const double s = energy_axis_inverse(k_abs(step), energy_row_scale(toward));
    const double n = 1 + 2 * k_max(s * s, 1e-10); /* equal indices are approached, not reached */
    const double eta = step < 0 ? 1 / n : n;
    const double shift = energy_shift(s, toward);
    const double at = energy_axis_inverse((double)column / (LOBE_TURNED_COSINES - 1), shift);
    const double cosine = k_max(at, 1e-9);
    const double single = lobe_turned_single(wide, narrow, share, (1 - cosine) * (1 + cosine));
    const both of = once(q, share, cosine, wide, narrow, eta);
    const both round = once(q, share, cosine, single, single, eta);
    for (int g2 = 0; g2 < 2; ++g2)
        table[g2][row][column][alpha][ratio][azimuth] =
            (int16_t)k_round((of.of[g2] / round.of[g2] - 1) / LOBE_TURNED_STEP);
}

static void print_ratios(int g2, int row, int column, int alpha) {
    printf("{");
    for (int r = 0; r < LOBE_TURNED_RATIOS - 1; ++r) {
        printf("{");
        for (int z = 0; z < LOBE_TURNED_AZIMUTHS; ++z)
            printf("%d,", table[g2][row][column][alpha][r][z]);
        printf("},");
    }
    printf("},\n");
}

static void print_row(int g2, int row) {
    printf("{");
    for (int c = 0; c < LOBE_TURNED_COSINES; ++c) {
        printf("{");
        for (int a = 0; a < LOBE_TURNED_ALPHAS; ++a) print_ratios(g2, row, c, a);
        printf("},");
    }
    printf("},\n");
}

int main(void) {
    dielectric_sum q = sum_rules(12, 8, 16);
    for (int row = 0; row < LOBE_TURNED_ROWS; ++row)
        for (int c = 0; c < LOBE_TURNED_COSINES; ++c)
            for (int a = 0; a < LOBE_TURNED_ALPHAS; ++a)
                for (int r = 0; r < LOBE_TURNED_RATIOS - 1; ++r)
                    for (int z = 0; z < LOBE_TURNED_AZIMUTHS; ++z) fill(&q, row, c, a, r, z);
    printf("/* Made by tools/numerics/dielectric_turned.c. */\n");
    for (int g2 = 0; g2 < 2; ++g2) {
        printf("{");
        for (int row = 0; row < LOBE_TURNED_ROWS; ++row) print_row(g2, row);
        printf("},\n");
    }
    return ferror(stdout) != 0;
}
