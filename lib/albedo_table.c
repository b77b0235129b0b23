/* lib/albedo_table.c: 1 - E and 1 - E_avg for F = 1 from tables, in single precision. */
#include "../kernel/bind/c_f32.h"

#include "lobe/albedo.h"

#include "albedo_table.h"

static const albedo_tables tables[LOBE_NDF_COUNT * LOBE_MASKING_COUNT * 2] = {
#include "albedo_table.inc"
};

static const float ROOT_MIN = 0.01f; /* square root of the smallest roughness */

static const albedo_tables *tables_of(lobe_ndf ndf, lobe_masking masking, lobe_g2 g2) {
    const bool known = (unsigned)ndf < LOBE_NDF_COUNT && (unsigned)masking < LOBE_MASKING_COUNT &&
                       (unsigned)g2 <= LOBE_G2_SEPARABLE;
    return known ? &tables[((int)ndf * LOBE_MASKING_COUNT + (int)masking) * 2 + (int)g2] : NULL;
}

static float mix(float a, float b, float share) {
    return a + share * (b - a);
}

/* A position from 0 to 1 on an axis of `count` nodes: the node below and the share of the next. */
typedef struct place {
    int node;
    float share;
} place;

static place place_of(float position, int count) {
    const float x = k_saturate(position) * (float)(count - 1);
    place p;
    p.node = (int)k_min(x, (float)(count - 2));
    p.share = x - (float)p.node;
    return p;
}

static float round_at(const albedo_tables *t, float mu, float root) {
    const albedo_stencil row = albedo_stencil_of(albedo_row(root), (float)ROUND_ROWS);
    const albedo_stencil column = albedo_stencil_of(albedo_column(mu, root), (float)ROUND_COLUMNS);
    const int r = (int)row.first, c = (int)column.first;
    float along[4];
    for (int k = 0; k < 4; ++k) {
        const float *v = &t->round[r + k][c];
        along[k] = albedo_mix(column, v[0], v[1], v[2], v[3]);
    }
    return albedo_mix(row, along[0], along[1], along[2], along[3]);
}

static float round_average(const albedo_tables *t, float root) {
    const albedo_stencil row = albedo_stencil_of(albedo_row(root), (float)ROUND_ROWS);
    const float *v = &t->round_average[(int)row.first];
    return albedo_mix(row, v[0], v[1], v[2], v[3]);
}

static float turned_average(const albedo_tables *t, const lobe_albedo_f32 *a) {
    const place row = place_of(a->row, TURNED_ROWS);
    const albedo_stencil ratio = albedo_stencil_of(k_saturate(a->ratio), (float)TURNED_RATIOS);
    float side[2];
    for (int r = 0; r < 2; ++r) {
        const float *v = &t->turned_average[row.node + r][(int)ratio.first];
        side[r] = albedo_mix(ratio, v[0], v[1], v[2], v[3]);
    }
    return mix(side[0], side[1], row.share);
}

/* Of four azimuths at each of four ratios, in one row and column. */
static float face(const int16_t ratios[TURNED_RATIOS][TURNED_COLUMNS][TURNED_AZIMUTHS], int column,
                  albedo_stencil ratio, albedo_stencil azimuth) {
    float along[4];
    for (int k = 0; k < 4; ++k) {
        const int16_t *v = &ratios[(int)ratio.first + k][column][(int)azimuth.first];
        along[k] = albedo_mix(azimuth, (float)v[0], (float)v[1], (float)v[2], (float)v[3]);
    }
    return TURNED_STEP * albedo_mix(ratio, along[0], along[1], along[2], along[3]);
}

static float turned_at(const albedo_tables *t, const lobe_albedo_f32 *a, float mu, float toward) {
    const float turn = (toward - a->narrow) / k_max(a->wide - a->narrow, 1e-6f);
    const place row = place_of(a->row, TURNED_ROWS);
    const place column = place_of(albedo_column(mu, toward), TURNED_COLUMNS);
    const albedo_stencil ratio = albedo_stencil_of(k_saturate(a->ratio), (float)TURNED_RATIOS);
    const albedo_stencil azimuth = albedo_stencil_of(k_saturate(turn), (float)TURNED_AZIMUTHS);
    float side[2];
    for (int r = 0; r < 2; ++r)
        side[r] = mix(face(t->turned[row.node + r], column.node, ratio, azimuth),
                      face(t->turned[row.node + r], column.node + 1, ratio, azimuth), column.share);
    return mix(side[0], side[1], row.share);
}

static float root_of(float alpha) {
    return k_sqrt(k_min(k_max(alpha, (float)LOBE_ALPHA_MIN), 2.0f));
}

lobe_albedo_f32 lobe_albedo_prepare_f32(lobe_ndf ndf, lobe_masking masking, lobe_g2 g2,
                                        float alpha_x, float alpha_y) {
    lobe_albedo_f32 a;
    memset(&a, 0, sizeof a);
    const albedo_tables *t = tables_of(ndf, masking, g2);
    a.is_valid = t && alpha_x >= 0.0f && alpha_x <= 2.0f && alpha_y >= 0.0f && alpha_y <= 2.0f;
    if (!a.is_valid) return a;
    a.table = (int32_t)(t - tables);
    a.alpha_x = alpha_x;
    a.alpha_y = alpha_y;
    a.is_mirror = alpha_x < (float)LOBE_ALPHA_MIN && alpha_y < (float)LOBE_ALPHA_MIN;
    if (a.is_mirror) return a;
    const float x = root_of(alpha_x), y = root_of(alpha_y);
    const float mean = k_sqrt(0.5f * (x * x + y * y));
    a.narrow = k_min(x, y);
    a.wide = k_max(x, y);
    a.row = (k_sqrt(mean) - 0.1f) / 0.9f;
    a.ratio = mean > ROOT_MIN ? (a.narrow - ROOT_MIN) / (mean - ROOT_MIN) : 1.0f;
    float root = round_average(t, mean);
    if (x != y) root += turned_average(t, &a);
    a.missing_average = k_min(k_square(k_square(k_max(root, 0.0f))), 1.0f);
    return a;
}

/* The square root of the roughness toward a direction. */
static float root_toward(const lobe_albedo_f32 *a, lobe_vec3_f32 w) {
    const float x = a->alpha_x * w.x, y = a->alpha_y * w.y, plane = w.x * w.x + w.y * w.y;
    if (!(plane > 1e-12f)) return a->wide;
    return k_min(k_max(k_sqrt(k_sqrt((x * x + y * y) / plane)), a->narrow), a->wide);
}

float lobe_albedo_missing_f32(const lobe_albedo_f32 *a, lobe_vec3_f32 w) {
    if (!a->is_valid || a->is_mirror) return 0.0f;
    const albedo_tables *t = &tables[a->table];
    const float mu = k_saturate(w.z), toward = root_toward(a, w);
    float root = round_at(t, mu, toward);
    if (a->narrow != a->wide) root += turned_at(t, a, mu, toward);
    return k_min(k_square(k_max(root, 0.0f)), 1.0f);
}
