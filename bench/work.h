/* bench/work.h: the loops that are timed. Each goes once over the inputs and returns a number made of
 * what it computed, so that no compiler may leave anything out. */
#ifndef LOBE_BENCH_WORK_H
#define LOBE_BENCH_WORK_H

#include <lobe/reflection.h>

#include "inputs.h"
#include "listings.h"

typedef enum precision { PRECISION_F32, PRECISION_F64, PRECISIONS } precision;

/* What is timed: draws or densities of one model. */
typedef struct work {
    lobe_reflection_options options;
    int is_glass; /* instead of options: a rough dielectric of index 1.5 */
    precision precision;
    int is_shared;       /* prepared once */
    const char *isa;     /* of the batches; NULL: one call a row */
    lobe_vec3_f64 plane; /* geometric normal */
} work;

double work_draw(const work *w, inputs *in);
/* A normal and its density, of batches only. */
double work_normal(const work *w, inputs *in);
double work_pdf(const work *w, inputs *in);
double work_listing(listing *published, const inputs *in);

/* Bytes that a draw reads and writes: directions, roughness and random numbers in; direction, density
 * and weight out. */
double work_bytes(const work *w);

#endif
