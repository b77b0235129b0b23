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
    const albedo_stencil row = albedo_stencil_of(k_saturate(a->row), (float)TURNED_ROWS);
    const albedo_stencil ratio = albedo_stencil_of(k_saturate(a->ratio), (float)TURNED_RATIOS);
    float along[4];
    for (int r = 0; r < 4; ++r) {
        const float *v = &t->turned_average[(int)row.first + r][(int)ratio.first];
        along[r] = albedo_mix(ratio, v[0], v[1], v[2], v[3]);
    }
    return albedo_mix(row, along[0], along[1], along[2], along[3]);
}

/* Of four azimuths at each of four columns, in one row and ratio. */
static float face(const int16_t columns[TURNED_COLUMNS][TURNED_AZIMUTHS], albedo_stencil column,
                  albedo_stencil azimuth) {
    float along[4];
    for (int k = 0; k < 4; ++k) {
        const int16_t *v = &columns[(int)column.first + k][(int)azimuth.first];
        along[k] = albedo_mix(azimuth, (float)v[0], (float)v[1], (float)v[2], (float)v[3]);
    }
    return albedo_mix(column, along[0], along[1], along[2], along[3]);
}

static float turned_at(const albedo_tables *t, const lobe_albedo_f32 *a, float mu, float toward) {
    const float turn = (toward - a->narrow) / k_max(a->wide - a->narrow, 1e-6f);
    const albedo_stencil row = albedo_stencil_of(k_saturate(a->row), (float)TURNED_ROWS);
    const albedo_stencil ratio = albedo_stencil_of(k_saturate(a->ratio), (float)TURNED_RATIOS);
    const albedo_stencil column =
        albedo_stencil_of(albedo_column(mu, toward), (float)TURNED_COLUMNS);
    const albedo_stencil azimuth = albedo_stencil_of(k_saturate(turn), (float)TURNED_AZIMUTHS);
    float rows[4];
    for (int r = 0; r < 4; ++r) {
        float ratios[4];
        for (int k = 0; k < 4; ++k)
            ratios[k] = face(t->turned[(int)row.first + r][(int)ratio.first + k], column, azimuth);
        rows[r] = albedo_mix(ratio, ratios[0], ratios[1], ratios[2], ratios[3]);
    }
    return TURNED_STEP * albedo_mix(row, rows[0], rows[1], rows[2], rows[3]);
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
