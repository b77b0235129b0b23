/* lib/batch_rows.h: what the loops of one instruction set offer, and the block they work on. Before
 * including: the binding of a precision. */

#include "../kernel/facet.h"

/* Rows are worked on in blocks that stay in the first-level cache. A multiple of every width. */
enum { BLOCK = 128 };

/* n rounded up to whole vectors of every set: the rows between are copies of the last one. A loop that
 * is known to end with a whole vector needs no second text for its end. */
static inline int whole_vectors(int n) {
    return (n + 15) & ~15;
}

/* One array a number: the loops read and write nothing else. */
typedef struct block {
    real wi[3][BLOCK], alpha[2][BLOCK], u[3][BLOCK];
    real m[3][BLOCK], wo[3][BLOCK], cos_im[BLOCK];
    real pdf_m[BLOCK], pdf[BLOCK], weight[BLOCK], f_cos[BLOCK];
} block;

/* Each works on the first n <= BLOCK rows. `state` is the kernel's, prepared once. */
typedef struct batch_row {
    void (*sample_each)(block *b, int n, facet_options options);
    void (*sample_shared)(block *b, int n, const void *state);
    void (*eval_each)(block *b, int n, facet_options options);
    void (*eval_shared)(block *b, int n, const void *state); /* valid, and no mirror */
} batch_row;
