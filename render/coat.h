/* The albedo E of a dielectric GGX coat, and its average, at little cost per shading: a table an index.
 * Measured at an index of 1.5, E - table, roughness 0.01 to 1 and cosine 0.001 to 1: isotropic -0.0041 to 0.0004;
 * anisotropy 0.5 -0.0058 to 0.0003, 0.7 -0.0075, 0.9 -0.0243, 0.95 -0.0418 to 0.0006. */
#ifndef LOBE_RENDER_COAT_H
#define LOBE_RENDER_COAT_H

#include "coat_table.h"
#include "lobe/albedo.h"
#include "vector.h"

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
