#include "coat.h"

#include "lobe/fresnel.h"

#include <stdlib.h>
#include <string.h>

/* The table of Smith-GGX with correlated heights and unequal roughnesses, ready made: building it takes a
 * third of a second. Albedos in
 * steps of 1/65535, rounded up. */
typedef struct packed_table {
    uint16_t albedo[COAT_ROWS][COAT_RATIOS][COAT_COLUMNS][COAT_AZIMUTHS];
    float average[COAT_AVERAGE_ROWS][COAT_AVERAGE_RATIOS];
} packed_table;

static const packed_table ready = {
#include "coat_table.inc"
};

static float square(float x) {
    return x * x;
}

static float row_roughness(float row) {
    float least = sqrtf(COAT_ROUGHNESS_MIN), root = least + row * (1.0f - least);
    return root * root;
}

/* The inverse: t^2 + t (1 + 2 roughness - 2 position) = 2 position roughness. */
static float column_cosine(int column, float roughness) {
    int offset = column - COAT_BEHIND;
    float position = fabsf((float)offset) / (offset < 0 ? COAT_BEHIND : COAT_FRONT);
    float b = 0.5f + roughness - position;
    float root = sqrtf(b * b + 2.0f * position * roughness);
    float t = b > 0.0f ? 2.0f * position * roughness / (b + root) : root - b;
    return copysignf(minf(t * t, 1.0f), (float)offset);
}

static float albedo_of(lobe_microsurface s, const coat *c, float x, float y, float z) {
    lobe_reflectance f = {LOBE_REFLECTANCE_DIELECTRIC, (double)c->table->ior, 0.0};
    lobe_vec3_f64 wi = {(double)x, (double)y, (double)z};
    s.alpha_x = (double)c->alpha_x;
    s.alpha_y = (double)c->alpha_y;
    return (float)lobe_albedo(s, f, wi, LOBE_EFFORT_COARSE);
}

/* The roughnesses of a row and ratio, x the wide one. */
static coat node_at(const coat_table *table, float row, float ratio) {
    coat c = {.table = table, .row = row, .ratio = ratio};
    float roughness = row_roughness(row);
    c.narrow = mixf(COAT_ROUGHNESS_MIN, roughness, ratio);
    c.alpha_y = square(c.narrow);
    c.alpha_x = 2.0f * square(roughness) - c.alpha_y;
    c.wide = sqrtf(c.alpha_x);
    return c;
}

/* The azimuths of one row, ratio and column. */
static void fill(lobe_microsurface s, const coat *c, int column, float albedo[COAT_AZIMUTHS]) {
    for (int a = 0; a < COAT_AZIMUTHS; a++) {
        float toward = c->narrow + (c->wide - c->narrow) * (float)a / (COAT_AZIMUTHS - 1);
        float x2 = 1.0f;
        if (c->wide > 1.0001f * c->narrow)
            x2 = clampf((square(square(toward)) - square(c->alpha_y)) /
                            (square(c->alpha_x) - square(c->alpha_y)),
                        0.0f, 1.0f);
        else if (a > 0) {
            albedo[a] = albedo[0];
            continue;
        }
        float z = column_cosine(column, toward), plane = sqrtf(1.0f - z * z);
        albedo[a] = albedo_of(s, c, plane * sqrtf(x2), plane * sqrtf(1.0f - x2), z);
    }
}

/* By how much a parabola through three even values lies above its chords near the middle one. */
static float sag(float before, float here, float after) {
    return maxf(here - 0.5f * (before + after), 0.0f) / 4.0f;
}

/* That along one axis of the table; an end takes its neighbour's. */
static float sag_along(const float *here, int position, int first, int last, int stride) {
    if (position == first) here += stride;
    if (position == last) here -= stride;
    return sag(here[-stride], *here, here[stride]);
}

/* Raises one row and ratio to bound E from above; `raw` is E itself. */
static void raise(coat_table *table, const coat_table *raw, int row, int ratio,
                  int has_anisotropy) {
    enum { COLUMN = COAT_AZIMUTHS, RATIO = COAT_COLUMNS * COLUMN, ROW = COAT_RATIOS * RATIO };
    for (int c = 0; c < COAT_COLUMNS; c++) {
        int first = c < COAT_BEHIND ? 0 : COAT_BEHIND;
        int last = c < COAT_BEHIND ? COAT_BEHIND : COAT_COLUMNS - 1;
        for (int a = 0; a < COAT_AZIMUTHS; a++) {
            const float *here = &raw->albedo[row][ratio][c][a];
            float sum = sag_along(here, row, 0, COAT_ROWS - 1, ROW) +
                        sag_along(here, c, first, last, COLUMN);
            /* half as much again for what a parabola misses on the coarse axes */
            if (has_anisotropy)
                sum += 1.5f * (sag_along(here, ratio, 0, COAT_RATIOS - 1, RATIO) +
                               sag_along(here, a, 0, COAT_AZIMUTHS - 1, 1));
            table->albedo[row][ratio][c][a] = minf(*here + sum, 1.0f);
        }
    }
}

/* 1/pi * integral of E cosine over the front: t^4 = cosine^2 in even steps of t, a quarter of the
 * azimuths. */
static float average_of(const coat *c) {
    enum { STEPS = 48, TURNS = 16 };
    double sum = 0.0;
    for (int j = 0; j < TURNS; j++) {
        float angle = 0.5f * LOBE_PI * ((float)j + 0.5f) / TURNS;
        for (int i = 0; i < STEPS; i++) {
            float t = ((float)i + 0.5f) / STEPS, z = t * t, plane = sqrtf(1.0f - z * z);
            vec3 d = {plane * cosf(angle), plane * sinf(angle), z};
            sum += (double)(t * t * t * lobe_coat_albedo(c, d));
        }
    }
    return (float)(4.0 * sum / (STEPS * TURNS));
}

/* The last ratio and the first azimuth: nothing to interpolate there. */
static void keep_round_albedo(coat_table *table) {
    for (int r = 0; r < COAT_ROWS; r++)
        for (int c = 0; c < COAT_COLUMNS; c++)
            table->round_albedo[r * COAT_COLUMNS + c] = table->albedo[r][COAT_RATIOS - 1][c][0];
}

/* As interpolation ends, not as the last node has it: they differ in the last digit. */
static void keep_round_average(coat_table *table) {
    for (int r = 0; r < COAT_AVERAGE_ROWS; r++) {
        const float *end = &table->average[r][COAT_AVERAGE_RATIOS - 1];
        table->round_average[r] = mixf(end[-1], end[0], 1.0f);
    }
}

int lobe_coat_build(coat_table *table, lobe_ndf ndf, lobe_masking masking, lobe_g2 g2,
                    int has_anisotropy) {
    const lobe_microsurface s = {ndf, masking, g2, 0.0, 0.0};
    coat_table *raw = calloc(1, sizeof *raw);
    if (!raw) return 0;
    int first = has_anisotropy ? 0 : COAT_RATIOS - 1;
#pragma omp parallel for collapse(2) schedule(dynamic)
    for (int r = 0; r < COAT_ROWS; r++)
        for (int k = first; k < COAT_RATIOS; k++) {
            coat c = node_at(table, (float)r / (COAT_ROWS - 1), (float)k / (COAT_RATIOS - 1));
            for (int column = 0; column < COAT_COLUMNS; column++)
                fill(s, &c, column, raw->albedo[r][k][column]);
        }
    for (int r = 0; r < COAT_ROWS; r++)
        for (int k = first; k < COAT_RATIOS; k++) raise(table, raw, r, k, has_anisotropy);
    free(raw);
    keep_round_albedo(table);
    first = has_anisotropy ? 0 : COAT_AVERAGE_RATIOS - 1;
#pragma omp parallel for schedule(dynamic)
    for (int r = 0; r < COAT_AVERAGE_ROWS; r++)
        for (int k = first; k < COAT_AVERAGE_RATIOS; k++) {
            coat c = node_at(table, (float)r / (COAT_AVERAGE_ROWS - 1),
                             (float)k / (COAT_AVERAGE_RATIOS - 1));
            table->average[r][k] = average_of(&c);
        }
    keep_round_average(table);
    return 1;
}

static void unpack(coat_table *table) {
    const uint16_t *packed = &ready.albedo[0][0][0][0];
    float *albedo = &table->albedo[0][0][0][0];
    for (size_t k = 0; k < sizeof table->albedo / sizeof *albedo; k++)
        albedo[k] = (float)packed[k] / 65535.0f;
    memcpy(table->average, ready.average, sizeof table->average);
    keep_round_albedo(table);
    keep_round_average(table);
}

static int fill_table(coat_table *table, lobe_microsurface s, int has_anisotropy) {
    if (s.ndf != LOBE_NDF_GGX || s.masking != LOBE_MASKING_SMITH || s.g2 != LOBE_G2_CORRELATED ||
        table->ior != COAT_IOR || !has_anisotropy)
        return lobe_coat_build(table, s.ndf, s.masking, s.g2, has_anisotropy);
    unpack(table);
    return 1;
}

/* A table and what it is of. */
typedef struct coat_entry {
    lobe_microsurface surface;
    int has_anisotropy;
    coat_table table;
    struct coat_entry *next;
} coat_entry;

static int is_of(const coat_entry *e, lobe_microsurface s, float ior, int has_anisotropy) {
    return e->surface.ndf == s.ndf && e->surface.masking == s.masking && e->surface.g2 == s.g2 &&
           e->table.ior == ior && e->has_anisotropy == has_anisotropy;
}

static coat_entry *make_entry(lobe_microsurface s, float ior, int has_anisotropy) {
    coat_entry *e = calloc(1, sizeof *e);
    if (!e) return NULL;
    e->surface = s;
    e->has_anisotropy = has_anisotropy;
    e->table.ior = ior;
    if (fill_table(&e->table, s, has_anisotropy)) return e;
    free(e);
    return NULL;
}

const coat_table *lobe_coat_table(lobe_ndf ndf, lobe_masking masking, lobe_g2 g2, float ior,
                                  int has_anisotropy) {
    static coat_entry *entries;
    lobe_microsurface s = {ndf, masking, g2, 0.0, 0.0};
    coat_entry *e;
#pragma omp critical(lobe_coat)
    {
        for (e = entries; e && !is_of(e, s, ior, has_anisotropy != 0);) e = e->next;
        if (!e && (e = make_entry(s, ior, has_anisotropy != 0))) {
            e->next = entries;
            entries = e;
        }
    }
    return e ? &e->table : NULL;
}

coat lobe_coat_at(const coat_table *table, const lobe_reflection_f32 *ggx) {
    coat c = {.table = table, .alpha_x = ggx->alpha_x, .alpha_y = ggx->alpha_y};
    float mean = sqrtf(0.5f * (c.alpha_x + c.alpha_y));
    c.is_mirror = ggx->is_mirror;
    c.wide = sqrtf(maxf(c.alpha_x, c.alpha_y));
    c.narrow = sqrtf(minf(c.alpha_x, c.alpha_y));
    c.row = coat_row_of(mean);
    c.ratio = 1.0f;
    if (c.wide > c.narrow)
        c.ratio = clampf((c.narrow - COAT_ROUGHNESS_MIN) / (mean - COAT_ROUGHNESS_MIN), 0.0f, 1.0f);
    return c;
}

/* The perceptual roughness that the Smith model sees along a direction. */
static float roughness_toward(const coat *c, vec3 d) {
    float plane = d.x * d.x + d.y * d.y;
    float squared = square(c->alpha_x * d.x) + square(c->alpha_y * d.y);
    if (!(plane > 1e-12f)) return c->wide;
    return clampf(sqrtf(sqrtf(squared / plane)), c->narrow, c->wide);
}

/* Between two azimuths and two columns of one row and ratio. */
static float mix_face(const float face[COAT_COLUMNS][COAT_AZIMUTHS], int column, float across,
                      int azimuth, float around) {
    const float *low = face[column] + azimuth, *high = face[column + 1] + azimuth;
    return mixf(mixf(low[0], low[1], around), mixf(high[0], high[1], around), across);
}

float lobe_coat_albedo(const coat *c, vec3 direction) {
    if (c->is_mirror && direction.z > 0.0f)
        return lobe_fresnel_dielectric_f32(c->table->ior, direction.z);
    if (c->ratio == 1.0f && c->wide == c->narrow)
        return coat_round_albedo(c->table->round_albedo, c->row, c->wide, direction.z);
    float toward = roughness_toward(c, direction), width = c->wide - c->narrow;
    float turn = width > 0.0f ? (toward - c->narrow) / width : 0.0f;
    float along, aside, across, around;
    int row = coat_place(c->row * (COAT_ROWS - 1), COAT_ROWS, &along);
    int ratio = coat_place(c->ratio * (COAT_RATIOS - 1), COAT_RATIOS, &aside);
    int column = coat_place(coat_column_of(direction.z, toward), COAT_COLUMNS, &across);
    int azimuth = coat_place(turn * (COAT_AZIMUTHS - 1), COAT_AZIMUTHS, &around);
    float corner[2][2];
    for (int r = 0; r < 2; r++)
        for (int s = 0; s < 2; s++)
            corner[r][s] =
                mix_face(c->table->albedo[row + r][ratio + s], column, across, azimuth, around);
    return mixf(mixf(corner[0][0], corner[0][1], aside), mixf(corner[1][0], corner[1][1], aside),
                along);
}

float lobe_coat_average(const coat *c) {
    if (c->is_mirror) return lobe_fresnel_dielectric_average_f32(c->table->ior);
    if (c->ratio == 1.0f) return coat_round_average(c->table->round_average, c->row);
    float along, aside;
    int row = coat_place(c->row * (COAT_AVERAGE_ROWS - 1), COAT_AVERAGE_ROWS, &along);
    int ratio = coat_place(c->ratio * (COAT_AVERAGE_RATIOS - 1), COAT_AVERAGE_RATIOS, &aside);
    const float *low = c->table->average[row] + ratio, *high = c->table->average[row + 1] + ratio;
    return mixf(mixf(low[0], low[1], aside), mixf(high[0], high[1], aside), along);
}

/* share (t + (1 - t) (F - f0)/(1 - f0)) with t = min(f0 color, 1): `one` is negative where the colour is dark. */
static void tint_channel(float f0, float share, float color, float *one, float *own) {
    float tinted = minf(f0 * color, 1.0f), scale = share / (1.0f - f0);
    *one = scale * (tinted - f0);
    *own = scale * (1.0f - tinted);
}

coat_tint lobe_coat_tint(float ior, float share, vec3 color) {
    coat_tint t = {v3_all(0.0f), v3_all(share), 0.0f, share};
    if (color.x == 1.0f && color.y == 1.0f && color.z == 1.0f) return t;
    float amplitude = (ior - 1.0f) / (ior + 1.0f), f0 = amplitude * amplitude;
    tint_channel(f0, share, color.x, &t.one.x, &t.own.x);
    tint_channel(f0, share, color.y, &t.one.y, &t.own.y);
    tint_channel(f0, share, color.z, &t.one.z, &t.own.z);
    tint_channel(f0, share, v3_max(color), &t.most_one, &t.most_own);
    return t;
}
