/* tools/numerics/albedo_table.c: lib/albedo_table.inc, the tables of albedos for F = 1, by quadrature.
 *
 *     cc -O2 -Iinclude -I. tools/numerics/albedo_table.c build/liblobe.a -lm -o albedo_table
 *     ./albedo_table > lib/albedo_table.inc          # a minute
 *
 * The layout is that of lib/albedo_table.h. */
#include "kernel/bind/c_f64.h"

#include "lib/albedo_table.h"

#include "lobe/albedo.h"

#include <math.h>
#include <stdio.h>

static const lobe_microsurface kinds[] = {
    {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, 0, 0},
    {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_SEPARABLE, 0, 0},
};
static int is_round(int row, int ratio) {
    return row == 0 || ratio == TURNED_RATIOS - 1;
}

enum { KINDS = sizeof kinds / sizeof kinds[0] };

static lobe_microsurface with(lobe_microsurface s, double root_x, double root_y) {
    s.alpha_x = root_x * root_x;
    s.alpha_y = root_y * root_y;
    return s;
}

/* sqrt(1 - E) at a cosine; x2 = cos^2 of the azimuth. */
static double root(lobe_microsurface s, double mu, double x2, lobe_effort effort) {
    const double plane = sqrt(fmax(1 - mu * mu, 0));
    const lobe_vec3_f64 wi = {plane * sqrt(x2), plane * sqrt(1 - x2), mu};
    return sqrt(fmax(1 - lobe_albedo(s, lobe_reflectance_one(), wi, effort), 0));
}

/* (1 - E_avg)^(1/4) */
static double average_root(lobe_microsurface s, lobe_effort effort) {
    const double e = lobe_albedo_average(s, lobe_reflectance_one(), effort);
    return sqrt(sqrt(fmax(1 - e, 0)));
}

static double mu_of(int column, int count, double root) {
    /* at the horizon the limit from above */
    return fmax(albedo_column_inverse((double)column / (count - 1), root), 1e-12);
}

static void print(double value) {
    static int printed = 0;
    printf("%.6g,%s", fabs(value) < 5e-9 ? 0 : value, ++printed % 10 ? "" : "\n");
}

static void print_round(lobe_microsurface s) {
    printf("{{");
    for (int r = 0; r < ROUND_ROWS; ++r) {
        const double axis = albedo_row_inverse((double)r / (ROUND_ROWS - 1));
        printf("{");
        for (int c = 0; c < ROUND_COLUMNS; ++c)
            print(root(with(s, axis, axis), mu_of(c, ROUND_COLUMNS, axis), 1, LOBE_EFFORT_FINE));
        printf("},\n");
    }
    printf("},{");
    for (int r = 0; r < ROUND_ROWS; ++r) {
        const double axis = albedo_row_inverse((double)r / (ROUND_ROWS - 1));
        print(average_root(with(s, axis, axis), LOBE_EFFORT_FINE));
    }
    printf("},\n");
}

/* Less that of a round surface of the roughness toward the direction. */
static double turned(lobe_microsurface s, albedo_axes a, int column, int azimuth) {
    const double toward = a.narrow + (a.wide - a.narrow) * azimuth / (TURNED_AZIMUTHS - 1);
    const double mu = mu_of(column, TURNED_COLUMNS, toward);
    const double n4 = pow(a.narrow, 4), w4 = pow(a.wide, 4);
    const double x2 = fmin(fmax((pow(toward, 4) - n4) / (w4 - n4), 0), 1);
    return root(with(s, a.wide, a.narrow), mu, x2, LOBE_EFFORT_MEDIUM) -
           root(with(s, toward, toward), mu, 1, LOBE_EFFORT_MEDIUM);
}

static void print_turned(lobe_microsurface s) {
    printf("{");
    for (int r = 0; r < TURNED_ROWS; ++r) {
        printf("{");
        for (int k = 0; k < TURNED_RATIOS; ++k) {
            printf("{");
            const albedo_axes a = albedo_axes_of(r, k);
            for (int c = 0; c < TURNED_COLUMNS; ++c) {
                printf("{");
                for (int azimuth = 0; azimuth < TURNED_AZIMUTHS; ++azimuth)
                    print(is_round(r, k) ? 0 : turned(s, a, c, azimuth));
                printf("},");
            }
            printf("},\n");
        }
        printf("},\n");
    }
    printf("},{");
    for (int r = 0; r < TURNED_ROWS; ++r) {
        printf("{");
        for (int k = 0; k < TURNED_RATIOS; ++k) {
            const albedo_axes a = albedo_axes_of(r, k);
            print(is_round(r, k) ? 0
                                 : average_root(with(s, a.wide, a.narrow), LOBE_EFFORT_MEDIUM) -
                                       average_root(with(s, a.mean, a.mean), LOBE_EFFORT_MEDIUM));
        }
        printf("},\n");
    }
    printf("}},\n");
}

int main(void) {
    printf("/* Made by tools/numerics/albedo_table.c. */\n");
    for (int k = 0; k < KINDS; ++k) {
        print_round(kinds[k]);
        print_turned(kinds[k]);
    }
    return 0;
}
