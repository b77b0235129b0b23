/* lobe/verify.h: statistical proof that samplers, densities and values of scattering models agree:
 * those of the library, or one of anybody's through lobe/plugin.h.
 *
 *     lobe_verify_options options = lobe_verify_default_options();
 *     options.level = LOBE_VERIFY_FULL;
 *     options.on_test = print_row;
 *     lobe_verify_summary summary;
 *     lobe_verify_result result = lobe_verify_run(&options, &summary);
 *
 * A case is one model (sampling method and precision) at one configuration (roughness, incidence,
 * masking). Every method of LOBE_METHODS is in the list of cases, in f32 and f64, and the rough
 * dielectrics of lobe/dielectric.h: over the whole sphere, seen from outside (theta below 90) and from
 * inside. Draws that are point masses count as rejected. The tests:
 *
 *   chi2           p      draws in bins of about equal expected count against integrals of the density
 *   rejected       p      count of rejected draws against 1 - integral of the density
 *   furnace        p      mean weight of the draws against the integral of f |cos|
 *   sound          error  number of draws that are NaN, infinite or negative
 *   normalization  error  integral of the density against the closed form of the accepted share
 *   share          error  the same closed form against independent ones (normal incidence, alpha = 1)
 *   uniform        error  density against 1/(2 pi) where the method is uniform (alpha = 1)
 *   coverage       error  share of the integral of f |cos| where the density is 0
 *   albedo         error  integral of f |cos| against closed forms (normal incidence, alpha = 1)
 *   density        error  pdf of a draw against the density at its direction
 *   weight         error  weight of a draw against f |cos| / density there
 *   bound          error  largest weight, where the method promises a bound
 *   reciprocity    error  f(wi, wo) against f(wo, wi), through the surface with the square of the index
 *   precision      error  density and value against the f64 twin (f32 only)
 *   length         error  | |wo|^2 - 1 | of a draw, in rounding units
 *   support        error  share of directions below the surface with a density or a value
 *   mirror         error  direction and weight below LOBE_ALPHA_MIN
 *   extreme        error  number of results that are not finite, negative, or a weight without a pdf,
 *                         for special numbers (0, -0, denormal, huge, inf, NaN) in every argument
 *   known bias     error  1 where a published error, given the draws of `full`, does not show
 *   survival       error  1 where a plugin crashed, exited or ran out of time (plugins only)
 *
 * p: a p-value, the test passes at or above the limit. The limit is such that a full list of right
 * models fails with probability LOBE_VERIFY_SIGNIFICANCE (Sidak); seeds are fixed, so a result is
 * the same every time. error: passes at or below the limit. Errors of density, weight, reciprocity
 * and precision are in units of the rounding unit of the precision times the condition of the
 * compared function at that direction: 1 is what rounding the direction alone may do.
 *
 * A method that is published with an error is kept for comparison and says which tests see it. Their
 * failures are known: reported, counted apart, and no failure of the run. */
#ifndef LOBE_VERIFY_H
#define LOBE_VERIFY_H

#include <stddef.h>

#include "types.h"

LOBE_BEGIN_C

/* Probability that a full list of right models has a failure: chosen once, at a fixed seed. */
#define LOBE_VERIFY_SIGNIFICANCE 1e-3

/* quick: about 10^5 draws a case, seconds in all. full: 10^8 draws a case and finer bins. Without
 * `only`, full runs every k-th case of each model, the first one shifted from model to model, so
 * that the two precisions of a method share out its configurations (those of the dielectrics, whose
 * only models they are, at least once each): about as many cases as LOBE_VERIFY_FULL_CASES allow, which
 * bounds the time whatever the length of the list. */
#define LOBE_VERIFY_FULL_CASES 400
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
    LOBE_VERIFY_NO_MEMORY,
    LOBE_VERIFY_BAD_PLUGIN, /* not there, not a plugin, of another version, dies at once */
    LOBE_VERIFY_BAD_STATE,  /* the state is of another run, damaged, or of another version */
    LOBE_VERIFY_NOT_SAVED   /* the state could not be written */
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
    int32_t is_known; /* failed as documented */
} lobe_verify_test;

/* The white furnace at one angle of incidence: what is reflected and transmitted of 1. */
typedef struct lobe_verify_furnace {
    double theta;    /* of wi, degrees */
    double integral; /* of f |cos|, by cubature */
    double sampled;  /* mean weight of draws */
    double error;    /* one standard deviation of the mean */
} lobe_verify_furnace;

typedef enum lobe_verify_pictures {
    LOBE_VERIFY_PICTURES_NONE,
    LOBE_VERIFY_PICTURES_FAILED, /* of cases with a failed test, also a known one */
    LOBE_VERIFY_PICTURES_ALL
} lobe_verify_pictures;

/* Draws of a case on the disk on which the model's lobe is spread out, and what was expected there.
 * Without a chart of its own, as for a plugin: the hemisphere seen from above. */
typedef struct lobe_verify_picture {
    const char *model;
    const char *configuration;
    int32_t sheets;           /* 2: the second one is the side below the surface */
    int32_t size;             /* pixels in each direction, rows from the top, y up */
    const float *observed[2]; /* draws per area in units of their mean, NAN outside the disk */
    const float *expected[2];
    const float *difference[2]; /* of the bin, in standard deviations */
    const lobe_verify_furnace *curve;
    int32_t curve_points;
} lobe_verify_picture;

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
    /* Called after the tests of a case that has a picture; how on_test is called. NULL: none. */
    void (*on_picture)(void *user, const lobe_verify_picture *picture);
    void *user; /* handed to all */
    lobe_verify_pictures pictures;
    /* A shared library (lobe/plugin.h) that is tested instead of the library's own models, each
     * case in a process of its own. Do not have other threads at that time. NULL: none. */
    const char *plugin;
    double case_seconds; /* time of a case of a plugin; 0: 20 s for quick, 1800 s for full */
    /* A file with the cases that have finished: written after each, read at the start if it is there
     * and of the same options and versions. Pictures are not in it. NULL: none. */
    const char *state;
} lobe_verify_options;

typedef struct lobe_verify_summary {
    uint64_t cases; /* finished */
    uint64_t tests_passed;
    uint64_t tests_failed; /* without the known ones */
    uint64_t tests_known;  /* failed as documented */
    uint64_t draws;        /* those of this run */
    uint64_t resumed;      /* cases that the state had */
    char message[512];     /* "WHAT; HINT" for a result other than OK and FAILED, else empty */
} lobe_verify_summary;

/* quick, seed 1, everything, all processors, no callbacks. */
LOBE_API lobe_verify_options lobe_verify_default_options(void);

/* Calls on_case for every case that lobe_verify_run would run, in order, and returns their number;
 * 0 also for a plugin that cannot be loaded. on_case may be NULL. */
LOBE_API size_t lobe_verify_list(const lobe_verify_options *options,
                                 void (*on_case)(void *user, const lobe_verify_case *verify_case),
                                 void *user);

/* Runs the chosen cases. `summary` is always filled. */
LOBE_API lobe_verify_result lobe_verify_run(const lobe_verify_options *options,
                                            lobe_verify_summary *summary);

LOBE_END_C

#endif
