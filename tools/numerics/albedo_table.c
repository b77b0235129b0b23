/* tools/numerics/albedo_table.c: lib/albedo_table.inc, the tables of albedos for F = 1, by quadrature.
 *
 *     cc -O2 -fopenmp -Iinclude -I. tools/numerics/albedo_table.c build/liblobe.a -lm -o albedo_table
 *     ./albedo_table > albedo_table.inc && mv albedo_table.inc lib/      # six minutes of processor time
 *
 * The layout is that of lib/albedo_table.h. */
#include "kernel/bind/c_f64.h"

#include "lib/albedo_table.h"

#include "lobe/albedo.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int is_round(int row, int ratio) {
    return row == 0 || ratio == TURNED_RATIOS - 1;
}

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
static double average_root(lobe_microsurface s) {
    const double e = lobe_albedo_average(s, lobe_reflectance_one(), LOBE_EFFORT_FINE);
    return sqrt(sqrt(fmax(1 - e, 0)));
}

/* The same by few directions, good enough for a difference: the midpoint rule in y, mu = a x/(1 + a - x) with a
 * the roughness toward the direction and x = y^2 (3 - 2 y), and in the azimuth. */
static double turned_average_root(lobe_microsurface s) {
    enum { STEPS = 20 };
    const int turns = s.alpha_x == s.alpha_y ? 1 : 6;
    double sum = 0;
    for (int j = 0; j < turns; ++j) {
        const double angle = acos(0.0) * (j + 0.5) / turns, c2 = cos(angle) * cos(angle);
        const double a = sqrt(s.alpha_x * s.alpha_x * c2 + s.alpha_y * s.alpha_y * (1 - c2));
        for (int i = 0; i < STEPS; ++i) {
            const double y = (i + 0.5) / STEPS, x = y * y * (3 - 2 * y), rest = 1 + a - x;
            const double mu = a * x / rest, step = 6 * y * (1 - y) * a * (1 + a) / (rest * rest);
            const double lacks = root(s, mu, c2, LOBE_EFFORT_MEDIUM);
            sum += 2 * mu * step * lacks * lacks;
        }
    }
    return sqrt(sqrt(sum / (STEPS * turns)));
}

static double mu_of(int column, int count, double root) {
    /* at the horizon the limit from above */
    return fmax(albedo_column_inverse((double)column / (count - 1), root), 1e-12);
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

static void fill_round(lobe_microsurface s, albedo_tables *t) {
#pragma omp parallel for schedule(dynamic)
    for (int r = 0; r < ROUND_ROWS; ++r) {
        const double axis = albedo_row_inverse((double)r / (ROUND_ROWS - 1));
        for (int c = 0; c < ROUND_COLUMNS; ++c)
            t->round[r][c] = (float)root(with(s, axis, axis), mu_of(c, ROUND_COLUMNS, axis), 1,
                                         LOBE_EFFORT_FINE);
        t->round_average[r] = (float)average_root(with(s, axis, axis));
    }
}

/* One row and ratio. */
static void fill_face(lobe_microsurface s, int row, int ratio, albedo_tables *t) {
    const albedo_axes a = albedo_axes_of(row, ratio);
    for (int c = 0; c < TURNED_COLUMNS; ++c)
        for (int azimuth = 0; azimuth < TURNED_AZIMUTHS; ++azimuth)
            t->turned[row][ratio][c][azimuth] =
                (int16_t)lrint(turned(s, a, c, azimuth) / TURNED_STEP);
    t->turned_average[row][ratio] = (float)(turned_average_root(with(s, a.wide, a.narrow)) -
                                            turned_average_root(with(s, a.mean, a.mean)));
}

static void fill_turned(lobe_microsurface s, albedo_tables *t) {
#pragma omp parallel for collapse(2) schedule(dynamic)
    for (int r = 0; r < TURNED_ROWS; ++r)
        for (int k = 0; k < TURNED_RATIOS; ++k)
            if (!is_round(r, k)) fill_face(s, r, k, t);
}

/* Rows of numbers, with a brace for each axis but the last. */
static void print_floats(const float *values, int rows, int columns) {
    printf("{");
    for (int r = 0; r < rows; ++r) {
        printf("{");
        for (int c = 0; c < columns; ++c) {
            const double v = (double)values[r * columns + c];
            printf("%.6g,%s", fabs(v) < 5e-9 ? 0 : v, c % 10 == 9 ? "\n" : "");
        }
        printf("},\n");
    }
    printf("},\n");
}

static void print_turned(const albedo_tables *t) {
    printf("{");
    for (int r = 0; r < TURNED_ROWS; ++r) {
        printf("{");
        for (int k = 0; k < TURNED_RATIOS; ++k) {
            printf("{");
            for (int c = 0; c < TURNED_COLUMNS; ++c) {
                printf("{");
                for (int a = 0; a < TURNED_AZIMUTHS; ++a) printf("%d,", t->turned[r][k][c][a]);
                printf("},%s", c % 3 == 2 ? "\n" : "");
            }
            printf("},\n");
        }
        printf("},\n");
    }
    printf("},\n");
}

static void print_tables(lobe_ndf ndf, lobe_masking masking, lobe_g2 g2) {
    static albedo_tables t;
    const lobe_microsurface s = {ndf, masking, g2, 0, 0};
    memset(&t, 0, sizeof t);
    fill_round(s, &t);
    fill_turned(s, &t);
    printf("{");
    print_floats(t.round[0], ROUND_ROWS, ROUND_COLUMNS);
    printf("{");
    for (int r = 0; r < ROUND_ROWS; ++r) printf("%.6g,", (double)t.round_average[r]);
    printf("},\n");
    print_turned(&t);
    print_floats(t.turned_average[0], TURNED_ROWS, TURNED_RATIOS);
    printf("},\n");
}

int main(void) {
    printf("/* Made by tools/numerics/albedo_table.c. */\n");
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ++ndf)
        for (int masking = 0; masking < LOBE_MASKING_COUNT; ++masking)
            for (int g2 = 0; g2 < 2; ++g2)
                print_tables((lobe_ndf)ndf, (lobe_masking)masking, (lobe_g2)g2);
    return 0;
}
