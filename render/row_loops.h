/* The loops over rows of the instruction set in use, and which of them shades a metal or a coat. */
#ifndef LOBE_RENDER_ROW_LOOPS_H
#define LOBE_RENDER_ROW_LOOPS_H

#include "lobe/reflection.h"
#include "rows/rows.h"

/* Below it a surface may be a mirror, a point mass: no loop is made for that. */
#define ROW_ALPHA_MIN 1e-4f

const row_loops *lobe_row_loops_in_use(void);

/* That of the model that lobe_surface_make would prepare above a plane of this tilt; -1: no loop has it. */
int lobe_row_kernel(const row_loops *loops, const lobe_model *asked, float metallic, float alpha,
                    float tilt_cosine);

#endif
