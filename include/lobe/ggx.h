/* lobe/ggx.h: Smith-GGX reflection: sampling, densities, values.
 *
 *     lobe_ggx_options options = lobe_ggx_default_options();
 *     lobe_ggx_f32 ggx = lobe_ggx_prepare_f32(options, wi, 0.3f, 0.6f);   // once a shading point
 *     lobe_ggx_draw_f32 s = lobe_ggx_sample_f32(&ggx, u1, u2, 0);        // as often as you like
 *     if (s.pdf > 0) colour *= s.weight * fresnel(s.cos_im);             // 0: rejected, count as 0
 *     float p = lobe_ggx_pdf_f32(&ggx, wo);                              // e.g. for an emitter
 *
 * The BRDF is f(wi,wo) = F D(m) G2(wi,wo) / (4 wi.z wo.z), m the normalised half vector; every value
 * here is without F: multiply by the Fresnel factor of lobe/fresnel.h at `cos_im`.
 * For wi.z <= 0 (a shading normal that faces away) D, the visible normals and their normaliser
 * (wi.z + t)/2 stay what they are (Tokuyoshi 2021): f cos = Dv(m)/(4 wi.m) * G2/G1 with
 * G2/G1 = 1 (height-correlated: its limit at wi.z -> 0) or G1(wo) (separable).
 *
 * Roughness: any alpha >= 0. Both below LOBE_GGX_ALPHA_MIN: an exact mirror, `is_mirror` is set, the
 * density is a point mass, lobe_ggx_sample gives pdf = 1 and weight = 1, lobe_ggx_pdf and
 * lobe_ggx_eval give 0. Only one below: it is raised to LOBE_GGX_ALPHA_MIN.
 * A negative, infinite or NaN roughness and a wi that is zero or not finite make an invalid model:
 * `is_valid` is 0 and every density and weight is 0.
 *
 * Error bounds are at the foot of each kernel file (kernel/ggx_<method>.h), with the input that
 * causes the worst case. */
#ifndef LOBE_GGX_H
#define LOBE_GGX_H

#include "methods.h"
#include "types.h"

LOBE_BEGIN_C

#define LOBE_GGX_ALPHA_MIN 1e-4

/* How to sample. LOBE_METHOD_COUNT is their number. */
typedef enum lobe_method {
#define LOBE_METHOD_ENUMERATOR(ID, name, text, about) LOBE_METHOD_##ID,
    LOBE_GGX_METHODS(LOBE_METHOD_ENUMERATOR)
#undef LOBE_METHOD_ENUMERATOR
        LOBE_METHOD_COUNT
} lobe_method;

/* Masking-shadowing: height-correlated G2 = 1/(1 + Lambda_i + Lambda_o), or separable G1(i) G1(o). */
typedef enum lobe_g2 { LOBE_G2_CORRELATED, LOBE_G2_SEPARABLE } lobe_g2;

/* Normaliser of the visible normals for wi.z < 0: the exact one, or 1/G1(|wi.z|) as before
 * Tokuyoshi 2021: biased (too bright), for comparison only. No effect for wi.z >= 0 or `ndf`. */
typedef enum lobe_normalization {
    LOBE_NORMALIZATION_UNBIASED,
    LOBE_NORMALIZATION_PREVIOUS
} lobe_normalization;

typedef struct lobe_ggx_options {
    lobe_method method;
    lobe_g2 g2;
    lobe_normalization normalization;
} lobe_ggx_options;

/* The best method known, height-correlated G2, unbiased normalisation. Start from it. */
LOBE_API lobe_ggx_options lobe_ggx_default_options(void);

/* "bounded" <-> LOBE_METHOD_BOUNDED. An unknown name gives LOBE_METHOD_COUNT; a value out of range
 * gives NULL. `about` is one line with the source of the method. */
LOBE_API lobe_method lobe_method_from_name(const char *name);
LOBE_API const char *lobe_method_name(lobe_method method);
LOBE_API const char *lobe_method_about(lobe_method method);

/* A model prepared for one (wi, alpha): what all draws and densities there share. A plain value,
 * copy it as you like; sampler and density read the same copy, so they cannot disagree. */
typedef struct lobe_ggx_f32 {
    int32_t method;    /* lobe_method */
    int32_t is_valid;  /* 0: roughness or wi unusable, everything is 0 */
    int32_t is_mirror; /* 1: roughness below LOBE_GGX_ALPHA_MIN, a point mass */
    float alpha_x;     /* as used, after the floor */
    float alpha_y;
    lobe_vec3_f32 wi;
    float prepared[48]; /* private */
} lobe_ggx_f32;

typedef struct lobe_ggx_f64 {
    int32_t method;
    int32_t is_valid;
    int32_t is_mirror;
    double alpha_x;
    double alpha_y;
    lobe_vec3_f64 wi;
    double prepared[48];
} lobe_ggx_f64;

/* One draw. A draw whose reflection does not leave the surface has pdf = 0 and weight = 0: count it
 * as black. Never draw again: that would make the picture too bright. */
typedef struct lobe_ggx_draw_f32 {
    lobe_vec3_f32 m;  /* microfacet normal, unit, z >= 0 */
    lobe_vec3_f32 wo; /* wi reflected about m */
    float cos_im;     /* wi . m = wo . m, the cosine for Fresnel */
    float pdf_m;      /* density of m over the sphere of normals, also of a rejected m */
    float pdf;        /* density of wo; 0: rejected */
    float weight;     /* f(wi,wo) |wo.z| / pdf without Fresnel; 0: rejected */
} lobe_ggx_draw_f32;

typedef struct lobe_ggx_draw_f64 {
    lobe_vec3_f64 m;
    lobe_vec3_f64 wo;
    double cos_im;
    double pdf_m;
    double pdf;
    double weight;
} lobe_ggx_draw_f64;

/* All there is to know about a pair of directions. */
typedef struct lobe_ggx_eval_f32 {
    float d;      /* D(m), per steradian */
    float g1_i;   /* G1(wi); for wi.z < 0 the normaliser 2|wi.z|/(wi.z + t), above 1 */
    float g1_o;   /* G1(wo); 0 for wo.z <= 0 */
    float g2;     /* G2(wi, wo) = g1_i * (G2/G1) */
    float pdf_m;  /* density of the method at m over the sphere of normals */
    float pdf;    /* density of the method at wo; 0 for wo.z <= 0 */
    float f_cos;  /* f(wi,wo) |wo.z| without Fresnel */
    float cos_im; /* wi . m */
} lobe_ggx_eval_f32;

typedef struct lobe_ggx_eval_f64 {
    double d;
    double g1_i;
    double g1_o;
    double g2;
    double pdf_m;
    double pdf;
    double f_cos;
    double cos_im;
} lobe_ggx_eval_f64;

/* Everything that depends on wi (unit) and the roughness only. */
LOBE_API lobe_ggx_f32 lobe_ggx_prepare_f32(lobe_ggx_options options, lobe_vec3_f32 wi,
                                           float alpha_x, float alpha_y);
LOBE_API lobe_ggx_f64 lobe_ggx_prepare_f64(lobe_ggx_options options, lobe_vec3_f64 wi,
                                           double alpha_x, double alpha_y);

/* Draw wo. u3 is read by methods that need a third number; none of the present ones does. */
LOBE_API lobe_ggx_draw_f32 lobe_ggx_sample_f32(const lobe_ggx_f32 *ggx, float u1, float u2,
                                               float u3);
LOBE_API lobe_ggx_draw_f64 lobe_ggx_sample_f64(const lobe_ggx_f64 *ggx, double u1, double u2,
                                               double u3);

/* Density of lobe_ggx_sample at wo, per steradian. Integrates over wo to lobe_ggx_acceptance. */
LOBE_API float lobe_ggx_pdf_f32(const lobe_ggx_f32 *ggx, lobe_vec3_f32 wo);
LOBE_API double lobe_ggx_pdf_f64(const lobe_ggx_f64 *ggx, lobe_vec3_f64 wo);

/* Values at wo, or at the microfacet normal m (then wo = wi reflected about m, which may lie below
 * the surface: pdf = 0, pdf_m not). */
LOBE_API lobe_ggx_eval_f32 lobe_ggx_eval_wo_f32(const lobe_ggx_f32 *ggx, lobe_vec3_f32 wo);
LOBE_API lobe_ggx_eval_f64 lobe_ggx_eval_wo_f64(const lobe_ggx_f64 *ggx, lobe_vec3_f64 wo);
LOBE_API lobe_ggx_eval_f32 lobe_ggx_eval_m_f32(const lobe_ggx_f32 *ggx, lobe_vec3_f32 m);
LOBE_API lobe_ggx_eval_f64 lobe_ggx_eval_m_f64(const lobe_ggx_f64 *ggx, lobe_vec3_f64 m);

/* The share of draws that is not rejected, in closed form (docs/optimal-caps.md): 2 a b nu/(1 - kappa).
 * Negative for `ndf`, where none is known. */
LOBE_API float lobe_ggx_acceptance_f32(const lobe_ggx_f32 *ggx);
LOBE_API double lobe_ggx_acceptance_f64(const lobe_ggx_f64 *ggx);

LOBE_END_C

#endif
