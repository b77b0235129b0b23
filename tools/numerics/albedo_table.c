/* tools/numerics/albedo_table.c: lib/albedo_table.inc, the tables of albedos for F = 1, by quadrature.
 *
 *     cc -O2 -ffp-contract=off -Iinclude -I. tools/numerics/albedo_table.c -lm -o albedo_table
 *     ./albedo_table > albedo_table.inc && mv albedo_table.inc lib/      # 12 seconds of processor time
 *
 * gcc and clang make the same bytes (compare with `cmp`). The layout is that of lib/albedo_table.h. */
#include "albedo_rays.h"

#include "lib/albedo_table.h"

#include <stdio.h>
#include <string.h>

/* Nodes enough for 1e-6 of E in the round tables and 7e-5 in the others, a tenth of what interpolation leaves. */
typedef struct maker {
    rays fine, fast;
} maker;

static maker maker_of(lobe_ndf ndf, lobe_masking masking) {
    const int is_vcavity = masking == LOBE_MASKING_VCAVITY, is_ggx = ndf == LOBE_NDF_GGX;
    maker m;
    m.fine = rays_of(ndf, masking, 24, 16, 24);
    m.fast = is_vcavity ? rays_of(ndf, masking, 12, 6, 12)
                        : rays_of(ndf, masking, is_ggx ? 16 : 18, is_ggx ? 8 : 12, 12);
    return m;
}

/* 1 - E at a cosine; square roots of the roughnesses, x2 = cos^2 of the azimuth. */
static both missing(rays *q, double root_x, double root_y, double mu, double x2) {
    const double plane = k_sqrt(k_max(1 - mu * mu, 0));
    rays_toward(q, v3_of(plane * k_sqrt(x2), plane * k_sqrt(1 - x2), mu), root_x * root_x,
                root_y * root_y);
    both b = rays_missing(q);
    for (int g2 = 0; g2 < 2; ++g2) b.of[g2] = k_max(b.of[g2], 0);
    return b;
}

static double mu_of(int column, int count, double root) {
    /* at the horizon the limit from above */
    return k_max(albedo_column_inverse((double)column / (count - 1), root), 1e-12);
}

/* 1 - E_avg turns where mu is about alpha: Gauss's rule over v, mu = alpha sinh v. Node and weight: */
typedef struct node {
    double mu, weight;
} node;

static node node_of(const gauss *rule, int k, double alpha) {
    const double length = k_asinh(1 / alpha), e = k_exp(length * rule->x[k]), inverse = 1 / e;
    const double mu = k_min(alpha * 0.5 * (e - inverse), 1), step = alpha * 0.5 * (e + inverse);
    return (node){mu, rule->weight[k] * length * step * 2 * mu};
}

/* ---- Equal roughnesses ----------------------------------------------------------------------- */

static both missing_average(rays *q, const gauss *rule, double root) {
    both sum = {{0, 0}};
    for (int k = 0; k < rule->count; ++k) {
        const node n = node_of(rule, k, root * root);
        const both here = missing(q, root, root, n.mu, 1);
        for (int g2 = 0; g2 < 2; ++g2) sum.of[g2] += n.weight * here.of[g2];
    }
    return sum;
}

static void fill_round(rays *q, albedo_tables t[2]) {
    const gauss rule = gauss_of(32);
    for (int r = 0; r < ROUND_ROWS; ++r) {
        const double axis = albedo_row_inverse((double)r / (ROUND_ROWS - 1));
        for (int c = 0; c < ROUND_COLUMNS; ++c) {
            const both here = missing(q, axis, axis, mu_of(c, ROUND_COLUMNS, axis), 1);
            for (int g2 = 0; g2 < 2; ++g2) t[g2].round[r][c] = (float)k_sqrt(here.of[g2]);
        }
        const both average = missing_average(q, &rule, axis);
        for (int g2 = 0; g2 < 2; ++g2)
            t[g2].round_average[r] = (float)k_sqrt(k_sqrt(average.of[g2]));
    }
}

/* What lib/albedo_table.c reads there. */
static double round_at(const albedo_tables *t, double mu, double root) {
    const albedo_stencil row = albedo_stencil_of(albedo_row(root), ROUND_ROWS);
    const albedo_stencil column = albedo_stencil_of(albedo_column(mu, root), ROUND_COLUMNS);
    double along[4];
    for (int k = 0; k < 4; ++k) {
        const float *v = &t->round[(int)row.first + k][(int)column.first];
        along[k] = albedo_mix(column, (double)v[0], (double)v[1], (double)v[2], (double)v[3]);
    }
    return albedo_mix(row, along[0], along[1], along[2], along[3]);
}

static double round_average(const albedo_tables *t, double root) {
    const albedo_stencil row = albedo_stencil_of(albedo_row(root), ROUND_ROWS);
    const float *v = &t->round_average[(int)row.first];
    return albedo_mix(row, (double)v[0], (double)v[1], (double)v[2], (double)v[3]);
}

/* ---- Unequal roughnesses --------------------------------------------------------------------- */

static double fourth(double x) {
    return k_square(k_square(x));
}

static int is_round(int row, int ratio) {
    return row == 0 || ratio == TURNED_RATIOS - 1;
}

/* A node less what the round table says for a surface of the roughness toward the direction. */
static void fill_turned(rays *q, int row, int ratio, int column, int azimuth, albedo_tables t[2]) {
    const albedo_axes a = albedo_axes_of(row, ratio);
    const double toward = a.narrow + (a.wide - a.narrow) * azimuth / (TURNED_AZIMUTHS - 1);
    const double mu = mu_of(column, TURNED_COLUMNS, toward);
    const double n4 = fourth(a.narrow), w4 = fourth(a.wide);
    const double x2 = k_min(k_max((fourth(toward) - n4) / (w4 - n4), 0), 1);
    const both here = missing(q, a.wide, a.narrow, mu, x2);
    for (int g2 = 0; g2 < 2; ++g2) {
        const double turned = k_sqrt(here.of[g2]) - k_max(round_at(&t[g2], mu, toward), 0);
        t[g2].turned[row][ratio][column][azimuth] = (int16_t)k_round(turned / TURNED_STEP);
    }
}

/* What lib/albedo_table.c makes of the tables in one row and ratio. */
static double looked_up(const albedo_tables *t, int row, int ratio, double mu, double toward) {
    const albedo_axes a = albedo_axes_of(row, ratio);
    const double turn = (toward - a.narrow) / (a.wide - a.narrow);
    const albedo_stencil column = albedo_stencil_of(albedo_column(mu, toward), TURNED_COLUMNS);
    const albedo_stencil azimuth = albedo_stencil_of(k_saturate(turn), TURNED_AZIMUTHS);
    double along[4];
    for (int k = 0; k < 4; ++k) {
        const int16_t *v = &t->turned[row][ratio][(int)column.first + k][(int)azimuth.first];
        along[k] = albedo_mix(azimuth, v[0], v[1], v[2], v[3]);
    }
    const double turned = albedo_mix(column, along[0], along[1], along[2], along[3]) * TURNED_STEP;
    return k_square(k_max(round_at(t, mu, toward) + turned, 0));
}

/* The average of what is looked up, so that Kulla & Conty's lobe holds what is missing; over the azimuth by the
 * tangent of half of it. */
static double turned_average(const albedo_tables *t, const gauss *rule, int row, int ratio) {
    const albedo_axes a = albedo_axes_of(row, ratio);
    double sum = 0;
    for (int j = 0; j < rule->count; ++j) {
        const double half = rule->x[j], inverse = 1 / (1 + half * half);
        const double c2 = k_square((1 - half * half) * inverse);
        const double alpha2 = fourth(a.wide) * c2 + fourth(a.narrow) * (1 - c2);
        const double toward = k_sqrt(k_sqrt(alpha2));
        for (int k = 0; k < rule->count; ++k) {
            const node n = node_of(rule, k, toward * toward);
            sum += rule->weight[j] * 4 / RAYS_PI * inverse * n.weight *
                   looked_up(t, row, ratio, n.mu, toward);
        }
    }
    return k_sqrt(k_sqrt(sum)) - round_average(t, a.mean);
}

static void fill_face(rays *q, const gauss *rule, int row, int ratio, albedo_tables t[2]) {
    for (int c = 0; c < TURNED_COLUMNS; ++c)
        for (int a = 0; a < TURNED_AZIMUTHS; ++a) fill_turned(q, row, ratio, c, a, t);
    for (int g2 = 0; g2 < 2; ++g2)
        t[g2].turned_average[row][ratio] = (float)turned_average(&t[g2], rule, row, ratio);
}

/* ---- The file -------------------------------------------------------------------------------- */

/* Rows of numbers, with a brace for each axis but the last. */
static void print_floats(const float *values, int rows, int columns) {
    printf("{");
    for (int r = 0; r < rows; ++r) {
        printf("{");
        for (int c = 0; c < columns; ++c) {
            const double v = (double)values[r * columns + c];
            printf("%.6g,%s", k_abs(v) < 5e-9 ? 0 : v, c % 10 == 9 ? "\n" : "");
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

static void print_table(const albedo_tables *t) {
    printf("{");
    print_floats(t->round[0], ROUND_ROWS, ROUND_COLUMNS);
    printf("{");
    for (int r = 0; r < ROUND_ROWS; ++r) printf("%.6g,", (double)t->round_average[r]);
    printf("},\n");
    print_turned(t);
    print_floats(t->turned_average[0], TURNED_ROWS, TURNED_RATIOS);
    printf("},\n");
}

static void make_tables(lobe_ndf ndf, lobe_masking masking) {
    static albedo_tables t[2];
    const gauss rule = gauss_of(32);
    maker m = maker_of(ndf, masking);
    memset(t, 0, sizeof t);
    fill_round(&m.fine, t);
    for (int row = 0; row < TURNED_ROWS; ++row)
        for (int ratio = 0; ratio < TURNED_RATIOS; ++ratio)
            if (!is_round(row, ratio)) fill_face(&m.fast, &rule, row, ratio, t);
    for (int g2 = 0; g2 < 2; ++g2) print_table(&t[g2]);
}

int main(void) {
    printf("/* Made by tools/numerics/albedo_table.c. */\n");
    for (int ndf = 0; ndf < LOBE_NDF_COUNT; ++ndf)
        for (int masking = 0; masking < LOBE_MASKING_COUNT; ++masking)
            make_tables((lobe_ndf)ndf, (lobe_masking)masking);
    return ferror(stdout) != 0;
}
