/* lib/dielectric_rows.h: what the loops over dielectrics of one instruction set offer. Before including: the
 * binding of a precision and batch_rows.h. */
#include "../kernel/ggx_dielectric.h"

/* As `block`: the loops read and write nothing else. boost: what makes up for lost energy. */
typedef struct dielectric_block {
    const real *wi[3], *alpha[2], *ior, *boost, *u[3], *to[3];
    real *m[3], *wo[3], *cos_im, *fresnel, *pdf_m, *pdf, *weight, *is_point, *f_cos;
} dielectric_block;

typedef struct dielectric_loops {
    void (*sample_each)(const dielectric_block *b, int n, dielectric_options options);
    void (*sample_shared)(const dielectric_block *b, int n, const void *state);
    void (*eval_each)(const dielectric_block *b, int n, dielectric_options options);
    void (*eval_shared)(const dielectric_block *b, int n, const void *state);
} dielectric_loops;
