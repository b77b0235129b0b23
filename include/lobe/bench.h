/* lobe/bench.h: what a draw costs, against what a user would otherwise run. liblobe_bench.
 *
 * Times every model of LOBE_MODELS and the rough dielectric in nanoseconds a draw, in one run with what it is compared to: the
 * published listing of the same method in plain C with libm, and the time in which this machine copies
 * the bytes that a draw reads and writes. The rounds go over all rows again and again, so that a slow
 * moment of the machine meets every row alike; what is reported is the median over the rounds. */
#ifndef LOBE_BENCH_H
#define LOBE_BENCH_H

#include "reflection.h"

#include <stddef.h>

LOBE_BEGIN_C

/* One row. Ratios are 0 where there is nothing to compare with. */
typedef struct lobe_bench_row {
    const char *ndf, *masking; /* as lobe_ndf_name and lobe_masking_name have them */
    const char *method;    /* as lobe_method_name; "dielectric": a rough dielectric of index 1.5 */
    const char *isa;       /* of lobe/batch.h: "scalar", "avx2", ...; "call": one call a draw */
    const char *precision; /* "f32", "f64" */
    const char *prepared;  /* "shared": once for all draws; "each": for every draw */
    double ns;             /* a draw with its density and weight */
    double ns_normal; /* a normal with its density alone; 0: no such loop (calls, dielectric) */
    double ns_pdf;    /* the density of a given direction, prepared alike */
    double spread;    /* (upper - lower quartile) / median of ns over the rounds */
    double listing;   /* how many times faster than the published listing */
    double stream;    /* ns / time to copy the bytes of a draw through memory */
} lobe_bench_row;

typedef struct lobe_bench_machine {
    char cpu[96]; /* as the system calls it */
    double copy;  /* bytes a second: read and written, arrays far larger than the caches */
} lobe_bench_machine;

typedef struct lobe_bench_options {
    const char *only; /* shell pattern that occurs in "NDF MASKING METHOD ISA PRECISION PREPARED" */
    int quick;        /* fewer and shorter rounds */
    double floor;     /* of GGX `horizon`, in [0, 1]; negative: the library's */
    /* Unit, in the shading frame; all 0: none. Above one no batch prepares for every draw: those rows
     * are left out. */
    lobe_vec3_f64 geometric_normal;
    void *user;
    void (*on_row)(
        void *user,
        const lobe_bench_row *row); /* in the order of LOBE_MODELS, the dielectric last */
    int (*on_progress)(void *user, double share); /* not 0: stop */
} lobe_bench_options;

typedef enum lobe_bench_result {
    LOBE_BENCH_OK,
    LOBE_BENCH_NO_ROWS,   /* `only` matches nothing */
    LOBE_BENCH_NO_MEMORY, /* 256 MB are needed */
    LOBE_BENCH_CANCELLED
} lobe_bench_result;

/* `machine` may be NULL. */
LOBE_API lobe_bench_result lobe_bench_run(const lobe_bench_options *options,
                                          lobe_bench_machine *machine);

LOBE_END_C

#endif
