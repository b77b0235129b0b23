/* What the engine needs to know of a reflection model: three functions, and facts where they exist.
 *
 * Everything is double at this interface; a model in single precision is wrapped and says so by
 * `rounding`. Directions and conventions are those of lobe/types.h. */
#ifndef LOBE_VERIFY_MODEL_H
#define LOBE_VERIFY_MODEL_H

#include <stddef.h>

#include "chart.h"

typedef struct lobe_verify_draw {
    double wo[3];
    double pdf; /* 0: rejected */
    double weight;
} lobe_verify_draw;

/* Room for what a model prepares for one wi. */
typedef union lobe_verify_state {
    unsigned char bytes[1024];
    long double align;
} lobe_verify_state;

/* The first block is needed, the rest are facts: NAN, NULL or 0 where a model has none. */
typedef struct lobe_verify_model {
    const char *name;
    const char *configuration;
    const void *self;
    double wi[3];
    double rounding; /* rounding unit: FLT_EPSILON, DBL_EPSILON */
    int random_bits; /* of the random numbers that the model is given: 24 or 53 */
    void (*prepare)(const void *self, const double wi[3], lobe_verify_state *state);
    lobe_verify_draw (*sample)(const lobe_verify_state *state, const double u[3]);
    double (*density)(const lobe_verify_state *state, const double wo[3]);
    double (*value)(const lobe_verify_state *state, const double wo[3]); /* f |cos| */

    lobe_verify_chart chart;              /* where the lobe is spread out */
    const struct lobe_verify_model *twin; /* the same in f64 */
    double weight_bound;                  /* promised; INFINITY: none */
    double accepted;                      /* closed form by the model: integral of the density */
    double accepted_oracle;               /* the same, known independently */
    double density_oracle;                /* the density, where it is constant */
    double albedo_oracle;                 /* integral of the value */
    int is_reciprocal;
    int is_mirror;     /* a point mass, not a density */
    int covers_sphere; /* transmits: its chart and draws go below the surface too */
    int has_jumps;     /* the density has; 0: its integrals converge fast */
    /* Prepares the model with the index-th pair of special parameters; 0 when there are no more. */
    int (*prepare_special)(const void *self, const double wi[3], size_t index,
                           lobe_verify_state *state);
} lobe_verify_model;

/* A model without facts on the hemisphere chart; the caller fills in the first block. */
lobe_verify_model lobe_verify_plain_model(void);

#endif
