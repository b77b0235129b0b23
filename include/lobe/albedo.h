/* lobe/albedo.h: how much a microsurface reflects after one scattering, and what is missing.
 *
 *     lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, 0.3, 0.3};
 *     double e = lobe_albedo(s, lobe_reflectance_one(), wi, LOBE_EFFORT_FINE);
 *
 * E(wi) = integral of f(wi,wo) wo.z over the directions wo above the surface: the albedo toward wi.
 * E_avg = 1/pi * integral of E(w) w.z over the directions above the surface. With F = 1 all that lacks
 * to 1 was scattered more than once. */
#ifndef LOBE_ALBEDO_H
#define LOBE_ALBEDO_H

#include "reflection.h"
#include "types.h"

LOBE_BEGIN_C

/* What a facet reflects: one law, with its parameters. */
typedef enum lobe_reflectance_law {
    LOBE_REFLECTANCE_ONE,
    LOBE_REFLECTANCE_SCHLICK,    /* a: f0 */
    LOBE_REFLECTANCE_F82,        /* a: f0, b: tint */
    LOBE_REFLECTANCE_DIELECTRIC, /* a: index */
    LOBE_REFLECTANCE_CONDUCTOR   /* a: n, b: k */
} lobe_reflectance_law;

typedef struct lobe_reflectance {
    lobe_reflectance_law law;
    double a, b;
} lobe_reflectance;

LOBE_API lobe_reflectance lobe_reflectance_one(void);
LOBE_API double lobe_reflectance_at(lobe_reflectance f, double cos_i);
/* 2 * integral of F(mu) mu dmu: closed forms; the conductor by quadrature, to 1e-9. */
LOBE_API double lobe_reflectance_average(lobe_reflectance f);

typedef struct lobe_microsurface {
    lobe_ndf ndf;
    lobe_masking masking;
    lobe_g2 g2;
    double alpha_x, alpha_y;
} lobe_microsurface;

/* By quadrature in double: the largest error seen for F = 1 over roughness 1e-3 to 1, cosines 1e-3 to
 * 1 and ratios of the roughness to 10:1. */
typedef enum lobe_effort {
    LOBE_EFFORT_COARSE, /* 3e-4 */
    LOBE_EFFORT_MEDIUM,
    LOBE_EFFORT_FINE
} lobe_effort;

/* wi: unit, on either side. Roughness as in lobe/reflection.h: any from 0 on; NaN where the
 * microsurface or wi is unusable. */
LOBE_API double lobe_albedo(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 wi,
                            lobe_effort effort);
LOBE_API double lobe_albedo_average(lobe_microsurface s, lobe_reflectance f, lobe_effort effort);

LOBE_END_C

#endif
