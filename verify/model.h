/* What the engine needs to know of a scattering model: three functions, and facts where they exist.
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
    unsigned char bytes[2048];
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

    /* The same draws as `sample`, bit for bit, many at a time, from three numbers each; NULL: one
     * call each. */
    void (*sample_many)(const lobe_verify_state *state, size_t count, const double *u,
                        lobe_verify_draw *draws);
    /* `density` and `value` of many directions, bit for bit; NULL: one call each. */
    void (*evaluate_many)(const lobe_verify_state *state, size_t count, const double *wo,
                          double *density, double *value);
    lobe_verify_chart chart;              /* where the lobe is spread out */
    lobe_verify_chart below;              /* directions below the surface; all NULL: none */
    int pilot_draws;                      /* that find the lobe on charts that do not know it */
    const struct lobe_verify_model *twin; /* the same in f64 */
    double weight_bound;                  /* promised; INFINITY: none */
    double accepted;                      /* closed form by the model: integral of the density */
    double accepted_oracle;               /* the same, known independently */
    double density_oracle;                /* the density, where it is constant */
    double albedo_oracle;                 /* integral of the value */
    int is_reciprocal;
    double passing;       /* f(wi, wo)/f(wo, wi) for wi above and wo below; 0: unknown */
    int covers_sphere;    /* its one chart reaches below the surface too, where its draws go */
    int has_jumps;        /* or kinks: the integrals of the density converge slowly */
    int is_mirror;        /* a point mass, not a density */
    int takes_legal_only; /* promises nothing for NaN, infinities and vectors without unit length */
    const char *known_bias; /* names of tests that a published error makes fail: "chi2 furnace" */
    int is_bias_due;        /* 10^8 draws show it in this configuration */
    /* Prepares the model with the index-th pair of special parameters; 0 when there are no more. */
    int (*prepare_special)(const void *self, const double wi[3], size_t index,
                           lobe_verify_state *state);
} lobe_verify_model;

/* A model without facts on the hemisphere chart; the caller fills in the first block. */
lobe_verify_model lobe_verify_plain_model(void);

/* Whether it scatters to both sides of the surface. */
int lobe_verify_is_sphere(const lobe_verify_model *model);

/* The chart of a direction. */
const lobe_verify_chart *lobe_verify_chart_of(const lobe_verify_model *model, const double wo[3]);

#endif
