/* tools/numerics/dielectric_energy.c: lib/dielectric_energy.inc, the table of lib/dielectric_energy.c.
 *
 *     cc -O2 -ffp-contract=off -I. -Iinclude tools/numerics/dielectric_energy.c -lm -o dielectric_energy
 *     ./dielectric_energy > energy.inc && mv energy.inc lib/dielectric_energy.inc      # 4.4 seconds
 *
 * The same bytes from every compiler and on every machine (compare with `cmp`). Its error is measured by
 * tools/numerics/dielectric_furnace.c. */
#include "dielectric_sum.h"

#include "lib/dielectric_axes.h"

#include <stdio.h>

static lobe_energy_table table;

static int kept(double energy, double base) {
    const double steps = k_log(k_max(energy / base, 1e-6)) / LOBE_ENERGY_STEP;
    return (int)k_round(steps);
}

static void fill(dielectric_sum *q, int inside, int row, int column, int cell) {
    const double r = (double)column / (LOBE_ENERGY_ALPHAS - 1);
    const double alpha = k_max(r * r, LOBE_ENERGY_LEAST_ALPHA);
    const double place = (double)row / (LOBE_ENERGY_INDICES - 1);
    const double s = energy_axis_inverse(place, energy_row_scale(alpha));
    const double n = 1 + 2 * k_max(s * s, 1e-10); /* equal indices are approached, not reached */
    const double shift = energy_shift(s, alpha);
    const double at = energy_axis_inverse((double)cell / (LOBE_ENERGY_COSINES - 1), shift);
    const double cosine = k_max(at, 1e-12);
    const v3 wi = v3_of(k_sqrt((1 - cosine) * (1 + cosine)), 0, cosine);
    sum_toward(q, wi, alpha, alpha, inside ? 1 / n : n);
    const both e = sum_of(q);
    for (int g2 = 0; g2 < 2; ++g2)
        table[g2][inside][row][column][cell] =
            (int16_t)kept(e.of[g2], energy_base(cosine, shift, alpha));
}

static void print_cells(const int16_t *cells) {
    printf("{");
    for (int k = 0; k < LOBE_ENERGY_COSINES; ++k) printf("%d,", cells[k]);
    printf("},\n");
}

static void print_rows(int g2, int inside) {
    printf("{");
    for (int row = 0; row < LOBE_ENERGY_INDICES; ++row) {
        printf("{");
        for (int k = 0; k < LOBE_ENERGY_ALPHAS; ++k) print_cells(table[g2][inside][row][k]);
        printf("},\n");
    }
    printf("},\n");
}

int main(void) {
    dielectric_sum q = sum_rules(14, 10, 20);
    for (int inside = 0; inside < 2; ++inside)
        for (int row = 0; row < LOBE_ENERGY_INDICES; ++row)
            for (int column = 0; column < LOBE_ENERGY_ALPHAS; ++column)
                for (int cell = 0; cell < LOBE_ENERGY_COSINES; ++cell)
                    fill(&q, inside, row, column, cell);
    printf("/* Made by tools/numerics/dielectric_energy.c. */\n");
    for (int g2 = 0; g2 < 2; ++g2) {
        printf("{");
        for (int inside = 0; inside < 2; ++inside) print_rows(g2, inside);
        printf("},\n");
    }
    return ferror(stdout) != 0;
}
