/* lobe/dielectric.h: rough dielectrics: reflection and transmission by Smith-GGX facets.
 *
 *     lobe_dielectric_options options = lobe_dielectric_default_options();
 *     lobe_dielectric_f32 glass = lobe_dielectric_prepare_f32(options, wi, 0.3f, 0.3f, 1.5f);
 *     lobe_dielectric_draw_f32 s = lobe_dielectric_sample_f32(&glass, u1, u2, u3);
 *     if (s.pdf > 0) throughput *= s.weight;                       // 0: rejected, count as 0
 *     lobe_dielectric_eval_f32 e = lobe_dielectric_eval_wo_f32(&glass, wo);   // e.g. for an emitter
 *
 * The surface lies at z = 0 of the local frame; the outside is above, the inside below. `ior` is the
 * index of the inside over the outside. A wi below the surface is inside the material, and what it
 * sees there is the same surface from its other side. (A shading normal that faces away from a
 * viewer outside is another matter: turn it first.) Values contain Fresnel's factor, exact and
 * unpolarised, F where light is reflected, 1 - F where it is transmitted:
 *
 *     f_cos = F       Dv(m)/(4 wi.m) G2/G1(wi)        m: wi + wo, normalised
 *     f_cos = (1 - F) Dv(m) dm/dwo   G2/G1(wi) S      m: the half vector of refraction
 *
 * (Walter et al. 2007). S is (index on the side of wi / index on the side of wo)^2 for radiance,
 * where light travels from wo to wi, and 1 for importance, where it travels from wi to wo.
 * Reciprocity: with n_v the index on the side of v and f = f_cos/|wo.z|,
 * f(wi,wo)/n_o^2 = f(wo,wi)/n_i^2 for importance, f(wi,wo)/n_i^2 = f(wo,wi)/n_o^2 for radiance.
 *
 * Shadowing: `correlated` is 1/(1 + L_i + L_o) on one side and B(1 + L_i, 1 + L_o), the beta function,
 * through the surface (Heitz et al. 2016); `separable` is G1 G1.
 *
 * A draw takes a visible normal by u1 and u2, then reflects or transmits by u3 with the chances F and
 * 1 - F. Where only one of the two leaves on its proper side, that one is taken with certainty and
 * the density says so. From the side of the lower index no draw is rejected; from the other only
 * those where neither leaves. Weights without compensation are at most 1 (times S).
 *
 * Point masses. Such a draw has is_point = 1 and pdf = its chance, and lobe_dielectric_pdf and
 * lobe_dielectric_eval are 0 there:
 *   - both roughnesses below LOBE_ALPHA_MIN: a smooth surface, is_smooth is set. (Only one of them
 *     below: it is raised.)
 *   - an index within 16 rounding units of 1 on a rough surface: all light passes straight, R = 0,
 *     is_matched is set. Farther from 1 everything is spread, and finite.
 *   - what passes a thin wall.
 *
 * Thin walls: an infinitely thin sheet, the same from both sides. Each facet is a pair of parallel
 * interfaces; all orders of reflection between them add up to F' = 2F/(1 + F) (Stokes 1862). What is
 * not reflected passes straight, a point mass of weight 1.
 *
 * `compensate` makes up for the light that single scattering loses, R + T = 1 (for radiance: before S).
 * A wall passes what its reflection loses, exactly. Else every value and weight is multiplied by
 * 1/E(wi.z, alpha, ior), E what is scattered once, by table (after Turquin 2019): R + T is 1 +- 0.01 for
 * indices from 1.1 to 3 (or inverse), isotropic alpha up to 1 and |wi.z| >= 0.001. Unequal roughnesses: root
 * mean square 0.002 at 2:1, 0.003 at 4:1, 0.007 at 10:1, at worst 0.015, 0.048, 0.105 (docs/departures.md).
 * Shadowing of what is refracted is then separable whatever `g2`
 * says: near the horizon the beta function leaves nothing that a factor could make up for. The
 * factor depends on wi: the reciprocity above no longer holds, and weights reach 1/E.
 *
 * Roughness: any alpha >= 0, as in lobe/reflection.h. ior: 1e-3 to 1e3. Anything else makes an invalid model:
 * is_valid is 0 and every density and weight is 0. */
#ifndef LOBE_DIELECTRIC_H
#define LOBE_DIELECTRIC_H

#include "reflection.h"
#include "types.h"

LOBE_BEGIN_C

#define LOBE_DIELECTRIC_IOR_MIN 1e-3
#define LOBE_DIELECTRIC_IOR_MAX 1e3

typedef enum lobe_transport { LOBE_TRANSPORT_RADIANCE, LOBE_TRANSPORT_IMPORTANCE } lobe_transport;

typedef struct lobe_dielectric_options {
    lobe_g2 g2;
    lobe_transport transport;
    int32_t thin;       /* 1: an infinitely thin wall */
    int32_t compensate; /* 1: R + T = 1 */
} lobe_dielectric_options;

/* Correlated heights, radiance, a solid, no compensation. Start from it. */
LOBE_API lobe_dielectric_options lobe_dielectric_default_options(void);

/* What all draws and values for one (wi, alpha, ior) share. A plain value, copy it as you like. */
typedef struct lobe_dielectric_f32 {
    int32_t is_valid;   /* 0: roughness, ior or wi unusable, everything is 0 */
    int32_t is_smooth;  /* 1: all draws are point masses */
    int32_t is_matched; /* 1: equal indices on a rough surface: all light passes straight */
    int32_t is_thin;
    float alpha_x; /* as used, after the floor */
    float alpha_y;
    float eta;           /* index of the far side over the near side, seen from wi */
    float energy_factor; /* by which `compensate` multiplies every value */
    float prepared[64];  /* private */
} lobe_dielectric_f32;

typedef struct lobe_dielectric_f64 {
    int32_t is_valid;
    int32_t is_smooth;
    int32_t is_matched;
    int32_t is_thin;
    double alpha_x;
    double alpha_y;
    double eta;
    double energy_factor; /* by which `compensate` multiplies every value */
    double prepared[64];
} lobe_dielectric_f64;

typedef struct lobe_dielectric_draw_f32 {
    lobe_vec3_f32 m;  /* microfacet normal, unit, on the side of wi */
    lobe_vec3_f32 wo; /* wi reflected about m, or refracted */
    float cos_im;     /* wi . m */
    float fresnel; /* share that the facet reflects; 0.5 and 0.5 say nothing of what was chosen */
    float pdf_m;   /* density of m over the sphere of normals, also of a rejected m; smooth: 1 */
    float pdf;     /* density of wo, of a point mass its chance; 0: rejected */
    float weight;  /* f_cos/pdf; 0: rejected */
    int32_t transmitted; /* 1: wo is on the other side of the surface than wi */
    int32_t is_point;    /* 1: wo is a point mass */
} lobe_dielectric_draw_f32;

typedef struct lobe_dielectric_draw_f64 {
    lobe_vec3_f64 m;
    lobe_vec3_f64 wo;
    double cos_im;
    double fresnel;
    double pdf_m;
    double pdf;
    double weight;
    int32_t transmitted;
    int32_t is_point;
} lobe_dielectric_draw_f64;

/* All there is to know about a pair of directions. The facet is the one that scatters wi to wo; where
 * there is none, and of point masses, everything of it is 0. */
typedef struct lobe_dielectric_eval_f32 {
    float d;       /* D of the facet, per steradian */
    float g1_i;    /* masking of wi, from its own side */
    float g1_o;    /* and of wo */
    float g2;      /* G2(wi, wo), of one side or through the surface */
    float pdf_m;   /* density of the facet's normal among those drawn */
    float pdf;     /* density of lobe_dielectric_sample at wo, per steradian */
    float f_cos;   /* f(wi,wo) |wo.z|, Fresnel's factor and S in it */
    float fresnel; /* share reflected by the facet that scatters wi to wo; 0 where there is none */
    float cos_im;
    int32_t transmitted; /* 1: wo is on the other side of the surface than wi */
} lobe_dielectric_eval_f32;

typedef struct lobe_dielectric_eval_f64 {
    double d;
    double g1_i;
    double g1_o;
    double g2;
    double pdf_m;
    double pdf;
    double f_cos;
    double fresnel;
    double cos_im;
    int32_t transmitted;
} lobe_dielectric_eval_f64;

/* Everything that depends on wi (unit, either side), roughness and index only. */
LOBE_API lobe_dielectric_f32 lobe_dielectric_prepare_f32(lobe_dielectric_options options,
                                                         lobe_vec3_f32 wi, float alpha_x,
                                                         float alpha_y, float ior);
LOBE_API lobe_dielectric_f64 lobe_dielectric_prepare_f64(lobe_dielectric_options options,
                                                         lobe_vec3_f64 wi, double alpha_x,
                                                         double alpha_y, double ior);

/* Draw wo: u1 and u2 choose the microfacet normal, u3 chooses between reflection and transmission. */
LOBE_API lobe_dielectric_draw_f32 lobe_dielectric_sample_f32(const lobe_dielectric_f32 *dielectric,
                                                             float u1, float u2, float u3);
LOBE_API lobe_dielectric_draw_f64 lobe_dielectric_sample_f64(const lobe_dielectric_f64 *dielectric,
                                                             double u1, double u2, double u3);

/* Density of lobe_dielectric_sample at wo. Integrates over the sphere to 1 less the share of draws
 * that are rejected or point masses. */
LOBE_API float lobe_dielectric_pdf_f32(const lobe_dielectric_f32 *dielectric, lobe_vec3_f32 wo);
LOBE_API double lobe_dielectric_pdf_f64(const lobe_dielectric_f64 *dielectric, lobe_vec3_f64 wo);

LOBE_API lobe_dielectric_eval_f32 lobe_dielectric_eval_wo_f32(const lobe_dielectric_f32 *dielectric,
                                                              lobe_vec3_f32 wo);
LOBE_API lobe_dielectric_eval_f64 lobe_dielectric_eval_wo_f64(const lobe_dielectric_f64 *dielectric,
                                                              lobe_vec3_f64 wo);

/* Shares of even light: the integrals of f_cos over the side of wi and over the other one. */
typedef struct lobe_dielectric_albedo {
    double reflected;
    double transmitted;
} lobe_dielectric_albedo;

/* By quadrature over so many visible normals, the choice by u3 integrated; point masses are in it. Error
 * below 2e-5 with 262144 points (a thirtieth of a second), roughness from 0.01 to 1, indices from 0.4 to
 * 2.5. */
LOBE_API lobe_dielectric_albedo lobe_dielectric_integrate(const lobe_dielectric_f64 *dielectric,
                                                          int32_t points);

LOBE_END_C

#endif
