/* lib/batch_rows.h: what the loops of one instruction set offer, and the rows they work on. Before
 * including: the binding of a precision. */

#include "../kernel/facet.h"

/* Rows are worked on in blocks that stay in the first-level cache. A multiple of every width. */
enum { BLOCK = 128 };

/* n rounded up to whole vectors of every set: the rows between are copies of the last one. A loop that
 * is known to end with a whole vector needs no second text for its end. */
static inline int whole_vectors(int n) {
    return (n + 15) & ~15;
}

/* One array a number: the loops read and write nothing else. A row of an output may be the same row of an
 * input. */
typedef struct block {
    const real *wi[3], *alpha[2], *u[3], *to[3]; /* to: the directions whose density is asked for */
    real *m[3], *wo[3], *cos_im;
    real *pdf_m, *pdf, *weight, *f_cos;
} block;

/* Each works on the first n <= BLOCK rows. `state` is the kernel's, prepared once. `normals` are the samples' m,
 * cos_im and pdf_m: reflections, their densities and weights take a third of the time and more. NULL where a small
 * build, or a model above a tilted plane, has the samples alone. */
typedef struct batch_row {
    void (*sample_each)(const block *b, int n, facet_options options);
    void (*sample_shared)(const block *b, int n, const void *state);
    void (*normals_each)(const block *b, int n, facet_options options);
    void (*normals_shared)(const block *b, int n, const void *state);
    void (*eval_each)(const block *b, int n, facet_options options);
    void (*eval_shared)(const block *b, int n, const void *state); /* valid, and no mirror */
} batch_row;
