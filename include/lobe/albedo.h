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
/* 2 * integral of F(mu) mu dmu: closed forms; the conductor by quadrature, to 1e-9 for n from 1.2 or k from 1, 3e-8
 * from a k of 0.5. Below both F may have a kink: 4e-3. */
LOBE_API double lobe_reflectance_average(lobe_reflectance f);

typedef struct lobe_microsurface {
    lobe_ndf ndf;
    lobe_masking masking;
    lobe_g2 g2;
    double alpha_x, alpha_y;
} lobe_microsurface;

/* By quadrature in double, for every distribution, masking and G2 there is. The largest error seen for
 * roughness and |cosine| from 1e-3 to 1 and ratios of the roughness to 10:1, wi above, and on one core,
 * for Smith-GGX. Beckmann above the surface: the same, 6 times as long; below 3e-2, 1.4e-4. V-cavities,
 * integrated between the creases of G2: 2e-3, 4e-5, 1e-6 (Beckmann below as with Smith), 10 times as long. */
typedef enum lobe_effort {
    LOBE_EFFORT_COARSE, /* 4e-3 with F = 1, 6e-4 with a dielectric; 0.03 ms */
    LOBE_EFFORT_MEDIUM, /* 3e-5, equal roughnesses 6e-6; 0.2 ms, 0.06 ms */
    LOBE_EFFORT_FINE    /* 2e-7, equal roughnesses 3e-9; 1 ms, 0.2 ms */
} lobe_effort;

/* wi: unit, on either side. Roughness as in lobe/reflection.h: any from 0 on; NaN where the
 * microsurface or wi is unusable. */
LOBE_API double lobe_albedo(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 wi,
                            lobe_effort effort);
LOBE_API double lobe_albedo_average(lobe_microsurface s, lobe_reflectance f, lobe_effort effort);

/* The same over the directions that also lie above a geometric surface: its normal (unit), in the shading
 * frame. NaN too where wi lies below it. As long
 * as lobe_albedo; largest differences to LOBE_EFFORT_FINE seen, of normals up to 73 degrees apart and roughness
 * from 1e-3: medium 8e-6 (Smith-GGX), 2e-4 (the others), coarse 4e-4, 2e-3. */
LOBE_API double lobe_albedo_above(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 wi,
                                  lobe_vec3_f64 geometric_normal, lobe_effort effort);

/* ---- Tables ----------------------------------------------------------------------------------
 *
 * For F = 1 in single precision, a microsecond's tenth a direction:
 *
 *     lobe_albedo_f32 a = lobe_albedo_prepare_f32(LOBE_NDF_GGX, LOBE_MASKING_SMITH,
 *                                                 LOBE_G2_CORRELATED, 0.3f, 0.3f);
 *     float missing = lobe_albedo_missing_f32(&a, wo);     // 1 - E(wo); on average a.missing_average
 *
 * Largest errors for alpha and mu from 1e-3 to 1: equal roughnesses 1.5e-4, relative to E 3e-4; unequal
 * ones 2e-3 up to a ratio of 10:1, 3e-3 of E (docs/multiple-scattering.md).
 * A direction below the surface is taken for one in it. */
typedef struct lobe_albedo_f32 {
    int32_t is_valid;      /* 0: no such microsurface, or a roughness not in [0, 2] */
    int32_t is_mirror;     /* both roughnesses below LOBE_ALPHA_MIN: nothing is missing */
    float missing_average; /* 1 - E_avg, to all its digits however small */
    float alpha_x, alpha_y;
    int32_t table; /* from here on private */
    float narrow, wide, row, ratio;
} lobe_albedo_f32;

LOBE_API lobe_albedo_f32 lobe_albedo_prepare_f32(lobe_ndf ndf, lobe_masking masking, lobe_g2 g2,
                                                 float alpha_x, float alpha_y);
LOBE_API float lobe_albedo_missing_f32(const lobe_albedo_f32 *a, lobe_vec3_f32 w);

/* ---- Closed forms ----------------------------------------------------------------------------
 *
 * 1 - E and 1 - E_avg of Smith, F = 1, equal roughnesses, no table. alpha is taken into [1e-4, 1],
 * mu into [0, 1]. Largest errors: GGX correlated 9.4e-4 (0.28 % of E), separable 5.1e-4 (0.17 %), in float
 * 1.2e-3; Beckmann 7.7e-4 (0.17 %), 8.6e-4 (0.18 %); the averages 2.5e-4 and for alpha from 1e-3 0.2 % of
 * what is missing. */
LOBE_API float lobe_albedo_fit_missing_f32(lobe_ndf ndf, lobe_g2 g2, float alpha, float mu);
LOBE_API double lobe_albedo_fit_missing_f64(lobe_ndf ndf, lobe_g2 g2, double alpha, double mu);
LOBE_API float lobe_albedo_fit_missing_average_f32(lobe_ndf ndf, lobe_g2 g2, float alpha);
LOBE_API double lobe_albedo_fit_missing_average_f64(lobe_ndf ndf, lobe_g2 g2, double alpha);

/* ---- Multiple scattering ----------------------------------------------------------------------
 *
 * Two approximations for conductors of what the scatterings after the first reflect. missing_i is
 * 1 - E(wi), missing_o 1 - E(wo), missing_avg 1 - E_avg, all for F = 1; f_avg is
 * lobe_reflectance_average. With F = 1 both make the sum of all scatterings 1, as exactly as E is known.
 *
 * Kulla & Conty 2017: a second lobe, added to f; reciprocal. Its albedo is f_ms missing_i: let that
 * share of the samples come from it, drawn by the cosine. f_ms after Hill 2018:
 * F_avg^2 E_avg/(1 - F_avg (1 - E_avg)). */
LOBE_API float lobe_multiscatter_fms_f32(float f_avg, float missing_avg);
LOBE_API double lobe_multiscatter_fms_f64(double f_avg, double missing_avg);
LOBE_API float lobe_multiscatter_kulla_conty_f32(float f_ms, float missing_i, float missing_o,
                                                 float missing_avg);
LOBE_API double lobe_multiscatter_kulla_conty_f64(double f_ms, double missing_i, double missing_o,
                                                  double missing_avg);

/* Turquin 2019: a factor on f, 1 + f0 (1 - E(wi))/E(wi) with f0 the reflectance at normal incidence; the
 * samples stay as they are; not reciprocal. */
LOBE_API float lobe_multiscatter_turquin_f32(float f0, float missing_i);
LOBE_API double lobe_multiscatter_turquin_f64(double f0, double missing_i);

LOBE_END_C

#endif
