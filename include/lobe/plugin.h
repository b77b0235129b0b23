/* lobe/plugin.h: test your own BSDF with `lobe verify --plugin FILE.so`.
 *
 * A plugin is a shared library that exports one function, lobe_plugin_describe. It returns a
 * description: three functions (draw a direction, its density, the value of the BSDF) and facts about
 * them, most of them optional. This header needs nothing but itself, in C99 or C++:
 *
 *     cc -O2 -fPIC -shared -I include mine.c -o mine.so -lm
 *     lobe verify --plugin ./mine.so
 *
 * Frame: local, z is the shading normal. `wi` points toward the viewer, `wo` is the sampled direction;
 * both point away from the surface and have unit length, either may lie below it (z < 0).
 * Densities are per steradian of wo. Random numbers lie in [0, 1).
 *
 * A plugin runs in a process of its own: it may crash, loop for ever or return NaN, and the report
 * says so. Worked examples: examples/plugin/. The manual: docs/verifying-your-bsdf.md. */
#ifndef LOBE_PLUGIN_H
#define LOBE_PLUGIN_H

/* Compared for equality: a plugin of another version is refused, never misread. */
#define LOBE_PLUGIN_VERSION 1

/* Parameters of a plugin at most, and special values of each at most. */
#define LOBE_PLUGIN_PARAMETERS 8
#define LOBE_PLUGIN_SPECIALS 8

/* What the three functions are asked about: one incidence on one surface. */
typedef struct lobe_plugin_block {
    double wi[3];
    double parameter[LOBE_PLUGIN_PARAMETERS]; /* in the order of the description */
} lobe_plugin_block;

/* One draw. pdf = 0: nothing was drawn (rejected, absorbed), weight is 0 then too. */
typedef struct lobe_plugin_draw {
    double wo[3];
    double pdf;
    double weight; /* f(wi, wo) |wo.z| / pdf */
} lobe_plugin_draw;

typedef struct lobe_plugin_parameter {
    const char *name;   /* letters, digits and _, at most 15 */
    double least, most; /* cases are taken from this range, both ends among them */
    double typical;     /* the value of the first cases */
    int is_logarithmic; /* spread evenly in the logarithm; least > 0 */
    int special_count;  /* values outside the range for which results shall be finite */
    double special[LOBE_PLUGIN_SPECIALS];
} lobe_plugin_parameter;

/* Bits of `flags`. */
enum {
    LOBE_PLUGIN_SPHERE =
        1, /* transmits too: wo and wi also below the surface. Without: f = 0 there */
    LOBE_PLUGIN_RECIPROCAL = 2, /* f(wi, wo) = f(wo, wi) for both on one side of the surface */
    LOBE_PLUGIN_ANY_INPUT = 4   /* finite for NaN, infinities, u = 1, vectors without unit length */
};

typedef struct lobe_plugin {
    int version;      /* LOBE_PLUGIN_VERSION */
    const char *name; /* letters, digits, _ and -, at most 31 */

    /* The three functions. They may be called in any order, from one thread. */
    void (*sample)(const lobe_plugin_block *block, const double u[3], lobe_plugin_draw *draw);
    double (*density)(const lobe_plugin_block *block, const double wo[3]);
    double (*value)(const lobe_plugin_block *block, const double wo[3]); /* f(wi, wo) |wo.z| */

    /* Facts; all may be left 0. */
    int parameter_count;
    lobe_plugin_parameter parameter[LOBE_PLUGIN_PARAMETERS];
    int flags;
    double rounding;     /* of the arithmetic behind: FLT_EPSILON, DBL_EPSILON (0: this one) */
    double weight_bound; /* no weight is above it; 0: no promise */
    /* The integral of the density over wo (the share of draws that is not rejected) and the integral
     * of f |wo.z| (the albedo) in closed form; NaN where unknown. NULL: unknown. */
    double (*accepted)(const lobe_plugin_block *block);
    double (*albedo)(const lobe_plugin_block *block);
} lobe_plugin;

#ifdef __cplusplus
#define LOBE_PLUGIN_C extern "C"
#else
#define LOBE_PLUGIN_C
#endif

/* Put this before the definition. */
#if defined(_WIN32)
#define LOBE_PLUGIN_EXPORT LOBE_PLUGIN_C __declspec(dllexport)
#elif defined(__GNUC__)
#define LOBE_PLUGIN_EXPORT LOBE_PLUGIN_C __attribute__((visibility("default")))
#else
#define LOBE_PLUGIN_EXPORT LOBE_PLUGIN_C
#endif

/* The only symbol that is looked up. The description stays valid while the plugin is loaded. */
LOBE_PLUGIN_C const lobe_plugin *lobe_plugin_describe(void);

#endif
