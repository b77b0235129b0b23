/* The table of a coat's albedo, and how it is read where both roughnesses are equal: of plain numbers, so that it can be
 * read for one shading point and for many side by side.
 *
 * E depends on the direction (two numbers) and on both roughnesses: a table of four dimensions,
 * interpolated linearly, its axes bent to where E turns:
 *   row      square root of the perceptual roughness r, r^2 = (alpha_x + alpha_y)/2
 *   ratio    s, alpha_y = r^2 s^2 (the narrower one): 1 isotropic, 0 a brush of no width
 *   azimuth  perceptual roughness toward the direction, from the narrow to the wide axis
 *   column   t = sqrt|cosine|, half of it against the roughness toward the direction: at grazing
 *            angles E depends on their ratio
 * Where E is concave a chord lies below it. There the nodes are raised: the table bounds E from above,
 * and what the coat and the base below it (material.h) reflect together stays below 1. The average is
 * that of the table as it is read, over the azimuth too. */
#ifndef LOBE_RENDER_COAT_TABLE_H
#define LOBE_RENDER_COAT_TABLE_H

#include "number.h"

#define COAT_IOR 1.5f /* where nothing else is said */

/* The table begins where the exact mirror ends. */
#define COAT_ROUGHNESS_MIN 0.01f

enum {
    COAT_ROWS = 16,
    COAT_RATIOS = 7,
    COAT_BEHIND = 6, /* cells of the columns for a shading normal that faces away */
    COAT_FRONT = 32,
    COAT_COLUMNS = COAT_BEHIND + COAT_FRONT + 1,
    COAT_AZIMUTHS = 6,
    COAT_AVERAGE_ROWS = 4 * (COAT_ROWS - 1) + 1,
    COAT_AVERAGE_RATIOS = 2 * (COAT_RATIOS - 1) + 1
};

typedef struct coat_table {
    float ior;
    float albedo[COAT_ROWS][COAT_RATIOS][COAT_COLUMNS][COAT_AZIMUTHS];
    float average[COAT_AVERAGE_ROWS][COAT_AVERAGE_RATIOS];
    /* what equal roughnesses read of them, in lines of the cache of their own */
    float round_albedo[COAT_ROWS * COAT_COLUMNS], round_average[COAT_AVERAGE_ROWS];
} coat_table;

/* From 0 to 1. */
static inline float coat_row_of(float roughness) {
    const float least = sqrtf(COAT_ROUGHNESS_MIN);
    return clampf((sqrtf(roughness) - least) / (1.0f - least), 0.0f, 1.0f);
}

/* Columns of t and of t/(t + roughness), added. */
static inline float coat_column_of(float cosine, float roughness) {
    const float t = sqrtf(minf(fabsf(cosine), 1.0f));
    const float position = 0.5f * t * (1.0f + (1.0f + roughness) / (t + roughness));
    return (float)COAT_BEHIND +
           copysignf(position, cosine) * (cosine < 0.0f ? (float)COAT_BEHIND : (float)COAT_FRONT);
}

/* A position on an axis of `count` nodes: the node below and the share of the one above. */
static inline int coat_place(float position, int count, float *share) {
    const int node = (int)minf(maxf(position, 0.0f), (float)(count - 2));
    *share = position - (float)node;
    return node;
}

/* The albedo toward a cosine, of round_albedo. */
static inline float coat_round_albedo(const float *nodes, float row, float roughness,
                                      float cosine) {
    float along, across;
    const int r = coat_place(row * (COAT_ROWS - 1), COAT_ROWS, &along);
    const int c = coat_place(coat_column_of(cosine, roughness), COAT_COLUMNS, &across);
    const int low = r * COAT_COLUMNS + c, high = low + COAT_COLUMNS;
    return mixf(mixf(nodes[low], nodes[low + 1], across),
                mixf(nodes[high], nodes[high + 1], across), along);
}

/* Its average over the directions, of round_average. */
static inline float coat_round_average(const float *nodes, float row) {
    float along;
    const int r = coat_place(row * (COAT_AVERAGE_ROWS - 1), COAT_AVERAGE_ROWS, &along);
    return mixf(nodes[r], nodes[r + 1], along);
}

#endif
