/* lobe/reflection.h: reflection from a microsurface: sampling, densities, values.
 *
 *     lobe_reflection_options options = lobe_reflection_default_options();
 *     lobe_reflection_f32 r = lobe_reflection_prepare_f32(options, wi, 0.3f, 0.6f);  // once a point
 *     lobe_reflection_draw_f32 s = lobe_reflection_sample_f32(&r, u1, u2, 0);        // many times
 *     if (s.pdf > 0) colour *= s.weight * fresnel(s.cos_im);       // 0: rejected, count as 0
 *     float p = lobe_reflection_pdf_f32(&r, wo);                   // e.g. for an emitter
 *
 * The BRDF is f(wi,wo) = F D(m) G2(wi,wo) / (4 wi.z wo.z), m the normalised half vector; every value
 * here is without F: multiply by the Fresnel factor of lobe/fresnel.h at `cos_im`.
 * For wi.z <= 0 (a shading normal that faces away) D, the visible normals and their normaliser
 * stay what they are (Tokuyoshi 2021): f cos = Dv(m)/(4 wi.m) * G2/G1 with
 * G2/G1 = 1 (height-correlated: its limit at wi.z -> 0) or G1(wo) (separable).
 *
 * Roughness: any alpha >= 0. Both below LOBE_ALPHA_MIN: an exact mirror, `is_mirror` is set, the
 * density is a point mass, lobe_reflection_sample gives pdf = 1 and weight = 1, lobe_reflection_pdf
 * and lobe_reflection_eval give 0. Only one below: it is raised to LOBE_ALPHA_MIN.
 * A negative, infinite or NaN roughness, a wi that is zero or not finite, and a combination of
 * distribution, masking and method that does not exist make an invalid model: `is_valid` is 0 and
 * every density and weight is 0.
 *
 * Geometric normal: directions below the plane of a geometric normal are invalid too (density 0,
 * weight 0, value 0), and a wi below it makes an invalid model. Without one: prepare_f32, _f64.
 *
 * Error bounds are at the foot of each kernel file (kernel/<kernel>.h of lobe/methods.h), with the
 * input that causes the worst case. */
#ifndef LOBE_REFLECTION_H
#define LOBE_REFLECTION_H

#include "methods.h"
#include "types.h"

LOBE_BEGIN_C

#define LOBE_ALPHA_MIN 1e-4

/* Distribution of the normals. */
typedef enum lobe_ndf {
#define LOBE_NDF_ENUMERATOR(ID, name) LOBE_NDF_##ID,
    LOBE_NDFS(LOBE_NDF_ENUMERATOR)
#undef LOBE_NDF_ENUMERATOR
        LOBE_NDF_COUNT
} lobe_ndf;

/* Shape of the microsurface: which normals hide which. */
typedef enum lobe_masking {
#define LOBE_MASKING_ENUMERATOR(ID, name) LOBE_MASKING_##ID,
    LOBE_MASKINGS(LOBE_MASKING_ENUMERATOR)
#undef LOBE_MASKING_ENUMERATOR
        LOBE_MASKING_COUNT
} lobe_masking;

/* How to sample. */
typedef enum lobe_method {
#define LOBE_METHOD_ENUMERATOR(ID, name, about) LOBE_METHOD_##ID,
    LOBE_METHODS(LOBE_METHOD_ENUMERATOR)
#undef LOBE_METHOD_ENUMERATOR
        LOBE_METHOD_COUNT
} lobe_method;

/* A row of LOBE_MODELS. */
typedef struct lobe_model {
    lobe_ndf ndf;
    lobe_masking masking;
    lobe_method method;
} lobe_model;

/* Masking-shadowing: height-correlated G2 = 1/(1 + Lambda_i + Lambda_o), of V-cavities min(G1(i), G1(o));
 * or separable G1(i) G1(o). */
typedef enum lobe_g2 { LOBE_G2_CORRELATED, LOBE_G2_SEPARABLE } lobe_g2;

/* Normaliser of the visible normals for wi.z < 0: the exact one, or 1/G1(|wi.z|) as before
 * Tokuyoshi 2021 (V-cavities: without the hit probability): biased (too bright), for comparison only. No effect for wi.z >= 0 or `ndf`. */
typedef enum lobe_normalization {
    LOBE_NORMALIZATION_UNBIASED,
    LOBE_NORMALIZATION_PREVIOUS
} lobe_normalization;

typedef struct lobe_reflection_options {
    lobe_model model;
    lobe_g2 g2;
    lobe_normalization normalization;
    double
        floor; /* GGX `horizon` only, in [0, 1]: how much of its density ignores shadowing; 0.25 */
} lobe_reflection_options;

/* Smith-GGX by its best method, height-correlated G2, unbiased normalisation. Start from it. */
LOBE_API lobe_reflection_options lobe_reflection_default_options(void);

/* Names as on the command line, "bounded" <-> LOBE_METHOD_BOUNDED. An unknown name gives
 * LOBE_METHOD_COUNT; a value out of range gives NULL. `about` is one line with the source. */
LOBE_API const char *lobe_ndf_name(lobe_ndf ndf);
LOBE_API const char *lobe_masking_name(lobe_masking masking);
LOBE_API lobe_method lobe_method_from_name(const char *name);
LOBE_API const char *lobe_method_name(lobe_method method);
LOBE_API const char *lobe_method_about(lobe_method method);

/* The rows of LOBE_MODELS; out of range: a model of the three _COUNTs, which does not exist. */
LOBE_API int lobe_model_count(void);
LOBE_API lobe_model lobe_model_at(int index);
LOBE_API int lobe_model_exists(lobe_model model);
/* The method to take where nothing speaks for another; LOBE_METHOD_COUNT where there is none. */
LOBE_API lobe_method lobe_best_method(lobe_ndf ndf, lobe_masking masking);

/* A model prepared for one (wi, alpha): what all draws and densities there share. A plain value,
 * copy it as you like; sampler and density read the same copy, so they cannot disagree. */
typedef struct lobe_reflection_f32 {
    int32_t row;       /* private */
    int32_t is_valid;  /* 0: nothing can be sampled, everything is 0 */
    int32_t is_mirror; /* 1: roughness below LOBE_ALPHA_MIN, a point mass */
    float alpha_x;     /* as used, after the floor */
    float alpha_y;
    lobe_vec3_f32 wi;
    float prepared[128]; /* private */
} lobe_reflection_f32;

typedef struct lobe_reflection_f64 {
    int32_t row;
    int32_t is_valid;
    int32_t is_mirror;
    double alpha_x;
    double alpha_y;
    lobe_vec3_f64 wi;
    double prepared[128];
} lobe_reflection_f64;

/* One draw. A draw whose reflection does not leave the surface has pdf = 0 and weight = 0: count it
 * as black. Never draw again: that would make the picture too bright. */
typedef struct lobe_reflection_draw_f32 {
    lobe_vec3_f32 m;  /* microfacet normal, unit, z >= 0 */
    lobe_vec3_f32 wo; /* wi reflected about m */
    float cos_im;     /* wi . m = wo . m, the cosine for Fresnel */
    float pdf_m;      /* density of m over the sphere of normals, also of a rejected m */
    float pdf;        /* density of wo; 0: rejected */
    float weight;     /* f(wi,wo) |wo.z| / pdf without Fresnel; 0: rejected */
} lobe_reflection_draw_f32;

typedef struct lobe_reflection_draw_f64 {
    lobe_vec3_f64 m;
    lobe_vec3_f64 wo;
    double cos_im;
    double pdf_m;
    double pdf;
    double weight;
} lobe_reflection_draw_f64;

/* All there is to know about a pair of directions. */
typedef struct lobe_reflection_eval_f32 {
    float d; /* D(m), per steradian */
    float
        g1_i; /* G1(wi); Smith for wi.z < 0 the normaliser |wi.z|/(visible area), above 1; V-cavity G1/H */
    float g1_o;   /* G1(wo); 0 for wo.z <= 0 */
    float g2;     /* G2(wi, wo) = g1_i * (G2/G1) */
    float pdf_m;  /* density of the method at m over the sphere of normals */
    float pdf;    /* density of the method at wo; 0 for wo.z <= 0 */
    float f_cos;  /* f(wi,wo) |wo.z| without Fresnel */
    float cos_im; /* wi . m */
} lobe_reflection_eval_f32;

typedef struct lobe_reflection_eval_f64 {
    double d;
    double g1_i;
    double g1_o;
    double g2;
    double pdf_m;
    double pdf;
    double f_cos;
    double cos_im;
} lobe_reflection_eval_f64;

/* Everything that depends on wi (unit) and the roughness only. */
LOBE_API lobe_reflection_f32 lobe_reflection_prepare_f32(lobe_reflection_options options,
                                                         lobe_vec3_f32 wi, float alpha_x,
                                                         float alpha_y);
LOBE_API lobe_reflection_f64 lobe_reflection_prepare_f64(lobe_reflection_options options,
                                                         lobe_vec3_f64 wi, double alpha_x,
                                                         double alpha_y);

/* The same above a geometric surface: its normal (unit), in the shading frame. */
LOBE_API lobe_reflection_f32 lobe_reflection_prepare_above_f32(lobe_reflection_options options,
                                                               lobe_vec3_f32 wi, float alpha_x,
                                                               float alpha_y,
                                                               lobe_vec3_f32 geometric_normal);
LOBE_API lobe_reflection_f64 lobe_reflection_prepare_above_f64(lobe_reflection_options options,
                                                               lobe_vec3_f64 wi, double alpha_x,
                                                               double alpha_y,
                                                               lobe_vec3_f64 geometric_normal);

/* The same, written where the model stays: a model is more than 500 bytes, and a renderer that prepares one at
 * every hit need not copy them. */
LOBE_API void lobe_reflection_prepare_at_f32(lobe_reflection_f32 *model,
                                             const lobe_reflection_options *options,
                                             lobe_vec3_f32 wi, float alpha_x, float alpha_y,
                                             lobe_vec3_f32 geometric_normal);
LOBE_API void lobe_reflection_prepare_at_f64(lobe_reflection_f64 *model,
                                             const lobe_reflection_options *options,
                                             lobe_vec3_f64 wi, double alpha_x, double alpha_y,
                                             lobe_vec3_f64 geometric_normal);

/* Draw wo. u3 is read by `horizon-mirror` and V-cavities only, and must be random there. */
LOBE_API lobe_reflection_draw_f32 lobe_reflection_sample_f32(const lobe_reflection_f32 *model,
                                                             float u1, float u2, float u3);
LOBE_API lobe_reflection_draw_f64 lobe_reflection_sample_f64(const lobe_reflection_f64 *model,
                                                             double u1, double u2, double u3);

/* Density of lobe_reflection_sample at wo, per steradian. Integrates over wo to lobe_reflection_acceptance. */
LOBE_API float lobe_reflection_pdf_f32(const lobe_reflection_f32 *model, lobe_vec3_f32 wo);
LOBE_API double lobe_reflection_pdf_f64(const lobe_reflection_f64 *model, lobe_vec3_f64 wo);

/* Values at wo, or at the microfacet normal m (then wo = wi reflected about m, which may lie below
 * the surface: pdf = 0, pdf_m not). */
LOBE_API lobe_reflection_eval_f32 lobe_reflection_eval_wo_f32(const lobe_reflection_f32 *model,
                                                              lobe_vec3_f32 wo);
LOBE_API lobe_reflection_eval_f64 lobe_reflection_eval_wo_f64(const lobe_reflection_f64 *model,
                                                              lobe_vec3_f64 wo);
LOBE_API lobe_reflection_eval_f32 lobe_reflection_eval_m_f32(const lobe_reflection_f32 *model,
                                                             lobe_vec3_f32 m);
LOBE_API lobe_reflection_eval_f64 lobe_reflection_eval_m_f64(const lobe_reflection_f64 *model,
                                                             lobe_vec3_f64 m);

/* The share of draws that is not rejected, in closed form (docs/optimal-caps.md): 2 a b nu/(1 - kappa)
 * for Smith-GGX. Negative where none is known: `ndf`, a tilted geometric normal, from above Beckmann (but
 * `horizon`, which rejects nothing) and V-cavities. */
LOBE_API float lobe_reflection_acceptance_f32(const lobe_reflection_f32 *model);
LOBE_API double lobe_reflection_acceptance_f64(const lobe_reflection_f64 *model);

/* What the density of visible normals integrates to with the model's normalization, in closed form: 1,
 * and for LOBE_NORMALIZATION_PREVIOUS with wi.z < 0 the smaller the farther wi lies behind the surface
 * (Tokuyoshi 2021, equations 4 and 9). pdf_m of every method but `ndf` integrates to it. A picture that
 * divides by that density is too bright by as much. 0: an invalid model. */
LOBE_API float lobe_reflection_vndf_integral_f32(const lobe_reflection_f32 *model);
LOBE_API double lobe_reflection_vndf_integral_f64(const lobe_reflection_f64 *model);

LOBE_END_C

#endif
