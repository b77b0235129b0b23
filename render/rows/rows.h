/* Shading points side by side, an array a number: what the loops of this folder read and write. The files with
 * loops are compiled once for each instruction set; every set gives the bits of material.c. */
#ifndef LOBE_RENDER_ROWS_H
#define LOBE_RENDER_ROWS_H

#include <stdint.h>

#include "../coat_table.h"

/* Stays in the first-level cache; a multiple of every width. */
enum { ROWS = 64 };

/* What all rows of a call share. */
typedef struct row_options {
    float ior;
    const float *coat_albedo, *coat_average; /* round_albedo and round_average of a coat_table */
    float floor_share;
    int32_t separable, previous; /* of facet_options */
} row_options;

/* Surfaces of material.h without glass, clear coat and walks, whose metal is Schlick's and scatters once, whose coat
 * is white, and whose coat and base, if there are any, are the same all around. Directions are those of the world. */
typedef struct shade_rows {
    float x[3][ROWS], y[3][ROWS], z[3][ROWS]; /* the shading frame */
    float geometric[3][ROWS], to_viewer[3][ROWS];
    float to_light[3][ROWS]; /* where the value is asked for */
    float base_color[3][ROWS];
    float metallic[ROWS], alpha_x[ROWS], alpha_y[ROWS];
    float coat[ROWS]; /* how much of its reflection a dielectric keeps */
    float u[3][ROWS]; /* of the draw: choice, u1, u2 */
    /* what comes out: f cos and density toward the light, and what surface_draw holds */
    float value[3][ROWS], value_pdf[ROWS];
    float direction[3][ROWS], weight[3][ROWS], pdf[ROWS];
    int32_t is_ggx[ROWS];
} shade_rows;

/* Shades the first n <= ROWS rows. What lies between the last of them and a whole vector is shaded too. */
typedef void row_loop(shade_rows *r, int n, const row_options *o);

/* The kernels that have loops. */
#define ROW_KERNELS(X)                                                                             \
    X(ggx_bounded)                                                                                 \
    X(ggx_caps)                                                                                    \
    X(ggx_ellipsoid)                                                                               \
    X(ggx_ndf)                                                                                     \
    X(ggx_horizon)                                                                                 \
    X(ggx_horizon_uniform)                                                                         \
    X(ggx_horizon_plane_uniform)

#define ROW_KERNEL_ENUMERATOR(kernel) ROW_##kernel,
typedef enum row_kernel { ROW_KERNELS(ROW_KERNEL_ENUMERATOR) ROW_KERNEL_COUNT } row_kernel;
#undef ROW_KERNEL_ENUMERATOR

/* The loops of an instruction set. */
typedef struct row_loops {
    row_loop *metal[ROW_KERNEL_COUNT], *coated[ROW_KERNEL_COUNT]; /* coated: metallic below 1 */
    row_loop *matte;
    /* below these the library's models for two planes stand in */
    float table_tilt_cosine, ellipse_tilt_cosine;
} row_loops;

#define ROW_SYMBOL_OF(set) lobe_row_loops_##set
#define ROW_SYMBOL(set) ROW_SYMBOL_OF(set)

#endif
