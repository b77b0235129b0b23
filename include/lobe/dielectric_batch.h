/* lobe/dielectric_batch.h: rough dielectrics (lobe/dielectric.h), many rows in one call, as lobe/batch.h does for
 * reflection. Row i gives the bits of lobe_dielectric_prepare, _sample and _eval_wo of its inputs.
 *
 *     lobe_dielectric_sample_batch_f32 b = {.count = n, .prepared = &glass};    // one for all, or
 *     b.options = options; b.wi[0].data = x; ...                                // a row: wi, alpha, ior
 *     b.seed = 1;
 *     b.wo[0] = (lobe_out_f32){ox, 1}; ... b.weight = (lobe_out_f32){w, 1};
 *     lobe_dielectric_sample_many_f32(&b);
 *
 * Rows that are prepared each with `compensate` look up their energy one by one. */
#ifndef LOBE_DIELECTRIC_BATCH_H
#define LOBE_DIELECTRIC_BATCH_H

#include "batch.h"
#include "dielectric.h"

LOBE_BEGIN_C

/* `prepared` for all rows, or NULL: then options, wi, alpha and ior, prepared for each row. Random numbers as in
 * lobe_sample_batch. wo lies on the other side of the surface than wi where light is transmitted;
 * is_point is 0 or 1. */
typedef struct lobe_dielectric_sample_batch_f32 {
    size_t count;
    const lobe_dielectric_f32 *prepared;
    lobe_dielectric_options options;
    lobe_in_f32 wi[3], alpha[2], ior;
    lobe_in_f32 u[3];
    uint64_t seed, offset;
    lobe_out_f32 m[3], wo[3], cos_im, fresnel, pdf_m, pdf, weight, is_point;
} lobe_dielectric_sample_batch_f32;

typedef struct lobe_dielectric_sample_batch_f64 {
    size_t count;
    const lobe_dielectric_f64 *prepared;
    lobe_dielectric_options options;
    lobe_in_f64 wi[3], alpha[2], ior;
    lobe_in_f64 u[3];
    uint64_t seed, offset;
    lobe_out_f64 m[3], wo[3], cos_im, fresnel, pdf_m, pdf, weight, is_point;
} lobe_dielectric_sample_batch_f64;

/* Densities and values of given directions. */
typedef struct lobe_dielectric_eval_batch_f32 {
    size_t count;
    const lobe_dielectric_f32 *prepared;
    lobe_dielectric_options options;
    lobe_in_f32 wi[3], alpha[2], ior;
    lobe_in_f32 wo[3];
    lobe_out_f32 pdf, f_cos, fresnel, cos_im;
} lobe_dielectric_eval_batch_f32;

typedef struct lobe_dielectric_eval_batch_f64 {
    size_t count;
    const lobe_dielectric_f64 *prepared;
    lobe_dielectric_options options;
    lobe_in_f64 wi[3], alpha[2], ior;
    lobe_in_f64 wo[3];
    lobe_out_f64 pdf, f_cos, fresnel, cos_im;
} lobe_dielectric_eval_batch_f64;

LOBE_API void lobe_dielectric_sample_many_f32(const lobe_dielectric_sample_batch_f32 *batch);
LOBE_API void lobe_dielectric_sample_many_f64(const lobe_dielectric_sample_batch_f64 *batch);
LOBE_API void lobe_dielectric_eval_many_f32(const lobe_dielectric_eval_batch_f32 *batch);
LOBE_API void lobe_dielectric_eval_many_f64(const lobe_dielectric_eval_batch_f64 *batch);

LOBE_END_C

#endif
