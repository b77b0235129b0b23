/* The albedo E of a dielectric GGX coat, and its average, at little cost per shading: a table an index.
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
 * that of the table as it is read, over the azimuth too.
 * Measured at an index of 1.5, E - table, roughness 0.01 to 1 and cosine 0.001 to 1: isotropic -0.0041 to 0.0004;
 * anisotropy 0.5 -0.0058 to 0.0003, 0.7 -0.0075, 0.9 -0.0243, 0.95 -0.0418 to 0.0006. */
#ifndef LOBE_RENDER_COAT_H
#define LOBE_RENDER_COAT_H

#include "lobe/albedo.h"
#include "vector.h"

#define COAT_IOR 1.5f /* where nothing else is said */

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
} coat_table;

/* The table of a microsurface, made at the first call and kept. Without anisotropy it holds what equal
 * roughnesses read and takes a twentieth of the time; with it, that of Smith-GGX with correlated heights
 * and COAT_IOR is ready (tools/numerics/coat_table.c). NULL: memory is lacking. */
const coat_table *lobe_coat_table(lobe_ndf ndf, lobe_masking masking, lobe_g2 g2, float ior,
                                  int has_anisotropy);

/* Builds one anew; `table` is all 0 but its index. 0: memory is lacking. */
int lobe_coat_build(coat_table *table, lobe_ndf ndf, lobe_masking masking, lobe_g2 g2,
                    int has_anisotropy);

/* KHR_materials_specular: the coat reflects one + own F of its index, by channel; `most` is the channel
 * that reflects most, at every angle. */
typedef struct coat_tint {
    vec3 one, own;
    float most_one, most_own;
} coat_tint;

/* F straight ahead times `color`, at most 1, F at grazing angles as it is, all times `share`. */
coat_tint lobe_coat_tint(float ior, float share, vec3 color);

/* The coat at a shading point. */
typedef struct coat {
    const coat_table *table;
    float wide, narrow; /* perceptual roughnesses along the axes */
    float alpha_x, alpha_y;
    float row, ratio; /* from 0 to 1 */
    int is_mirror;
} coat;

coat lobe_coat_at(const coat_table *table, const lobe_reflection_f32 *ggx);

/* E toward a local direction, on either side; at most 1. */
float lobe_coat_albedo(const coat *c, vec3 direction);
float lobe_coat_average(const coat *c);

#endif
