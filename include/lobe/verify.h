/* lobe/verify.h: statistical proof that samplers, densities and values of reflection models agree.
 *
 *     lobe_verify_options options = lobe_verify_default_options();
 *     options.level = LOBE_VERIFY_FULL;
 *     options.on_test = print_row;
 *     lobe_verify_summary summary;
 *     lobe_verify_result result = lobe_verify_run(&options, &summary);
 *
 * A case is one model (sampling method and precision) at one configuration (roughness, incidence,
 * masking). Every method of LOBE_METHODS is in the list of cases, in f32 and f64. The tests:
 *
 *   chi2           p      draws in bins of about equal expected count against integrals of the density
 *   rejected       p      count of rejected draws against 1 - integral of the density
 *   furnace        p      mean weight of the draws against the integral of f |cos|
 *   normalization  error  integral of the density against the closed form of the accepted share
 *   share          error  the same closed form against independent ones (normal incidence, alpha = 1)
 *   uniform        error  density against 1/(2 pi) where the method is uniform (alpha = 1)
 *   albedo         error  integral of f |cos| against closed forms (normal incidence, alpha = 1)
 *   density        error  pdf of a draw against the density at its direction
 *   weight         error  weight of a draw against f |cos| / density there
 *   bound          error  largest weight, where the method promises a bound
 *   reciprocity    error  f(wi, wo) against f(wo, wi)
 *   precision      error  density and value against the f64 twin (f32 only)
 *   support        error  share of directions below the surface with a density or a value
 *   mirror         error  direction and weight below LOBE_ALPHA_MIN
 *   extreme        error  number of results that are not finite, negative, or a weight without a pdf,
 *                         for special numbers (0, -0, denormal, huge, inf, NaN) in every argument
 *
 * p: a p-value, the test passes at or above the limit. The limit is such that a full list of right
 * models fails with probability LOBE_VERIFY_SIGNIFICANCE (Sidak); seeds are fixed, so a result is
 * the same every time. error: passes at or below the limit. Errors of density, weight, reciprocity
 * and precision are in units of the rounding unit of the precision times the condition of the
 * compared function at that direction: 1 is what rounding the direction alone may do. */
#ifndef LOBE_VERIFY_H
#define LOBE_VERIFY_H

#include <stddef.h>

#include "types.h"

LOBE_BEGIN_C

/* Probability that a full list of right models has a failure: chosen once, at a fixed seed. */
#define LOBE_VERIFY_SIGNIFICANCE 1e-3

/* quick: about 10^5 draws a case, seconds in all. full: 10^8 draws a case, finer bins, about an
 * hour on two cores. */
typedef enum lobe_verify_level { LOBE_VERIFY_QUICK, LOBE_VERIFY_FULL } lobe_verify_level;

typedef enum lobe_verify_kind {
    LOBE_VERIFY_P_VALUE, /* passed: value >= limit */
    LOBE_VERIFY_ERROR    /* passed: value <= limit; a NaN never passes */
} lobe_verify_kind;

typedef enum lobe_verify_result {
    LOBE_VERIFY_OK,         /* everything ran and passed */
    LOBE_VERIFY_FAILED,     /* everything ran, at least one test failed */
    LOBE_VERIFY_CANCELLED,  /* on_progress asked for it; what is counted had finished */
    LOBE_VERIFY_NO_CASES,   /* `only` matches nothing */
    LOBE_VERIFY_BAD_OPTION, /* a number out of range */
    LOBE_VERIFY_NO_MEMORY
} lobe_verify_result;

/* Strings live as long as the callback runs. */
typedef struct lobe_verify_case {
    const char *model;         /* "bounded f32" */
    const char *configuration; /* "alpha=0.5,0.2 theta=40 phi=30 g2=correlated" */
} lobe_verify_case;

typedef struct lobe_verify_test {
    const char *model;
    const char *configuration;
    const char *test;   /* a name of the list above */
    const char *detail; /* what was compared, one short line: "255 bins, dof 254" */
    lobe_verify_kind kind;
    double statistic; /* chi^2, z score, or the same as value for an error */
    double value;     /* p-value or error */
    double limit;
    int32_t passed;
} lobe_verify_test;

typedef struct lobe_verify_options {
    lobe_verify_level level;
    uint64_t seed;
    /* A shell pattern (* ? [...]) that must occur in "MODEL CONFIGURATION", as in "bounded",
     * "caps f32", "f64*theta=88". NULL: everything. A case has the same draws and limits however
     * it was chosen. */
    const char *only;
    uint64_t draws;  /* draws a case; 0: those of the level. 1000 to 10^12 */
    int32_t threads; /* 0: one for every processor. Results do not depend on it. At most 1024 */
    /* Called when a test has finished, in the order of the list, one call at a time, from any of
     * the threads. NULL: none. */
    void (*on_test)(void *user, const lobe_verify_test *test);
    /* Called now and then with the share done in [0, 1], one call at a time, from any of the
     * threads. A result other than 0 cancels the run within a fraction of a second. NULL: none. */
    int (*on_progress)(void *user, double share);
    void *user; /* handed to both */
} lobe_verify_options;

typedef struct lobe_verify_summary {
    uint64_t cases; /* finished */
    uint64_t tests_passed;
    uint64_t tests_failed;
    uint64_t draws;
    char message[160]; /* "WHAT; HINT" for a result other than OK and FAILED, else empty */
} lobe_verify_summary;

/* quick, seed 1, everything, all processors, no callbacks. */
LOBE_API lobe_verify_options lobe_verify_default_options(void);

/* Calls on_case for every case that `only` chooses, in order, and returns their number. on_case may
 * be NULL. */
LOBE_API size_t lobe_verify_list(const lobe_verify_options *options,
                                 void (*on_case)(void *user, const lobe_verify_case *verify_case),
                                 void *user);

/* Runs the chosen cases. `summary` is always filled. */
LOBE_API lobe_verify_result lobe_verify_run(const lobe_verify_options *options,
                                            lobe_verify_summary *summary);

LOBE_END_C

#endif
