/* lobe/batch.h: many draws, densities and values in one call, by the widest vectors of the processor.
 *
 *     lobe_sample_batch_f32 b = {.count = n, .prepared = &model};   // one model for all, or
 *     b.options = options; b.wi[0].data = x; ...                    // one a row: wi, alpha
 *     b.seed = 1;                                                   // u1, u2, u3 made on the way
 *     b.wo[0] = (lobe_out_f32){ox, 1}; ... b.pdf = (lobe_out_f32){pdf, 1};
 *     lobe_reflection_sample_batch_f32(&b);
 *
 * Row i gives the bits of lobe_reflection_prepare, _sample, _pdf and _eval_wo of its inputs, on every
 * processor and by every compiler. Arrays may have any alignment and any stride, count may be 0, and
 * an output may be an input of the same place and stride (rows are read before they are written).
 * No allocation, no threads; may be called from any thread. */
#ifndef LOBE_BATCH_H
#define LOBE_BATCH_H

#include "reflection.h"

#include <stddef.h>

LOBE_BEGIN_C

/* Element i is data[i * stride]; stride 0: one value for all rows. */
typedef struct lobe_in_f32 {
    const float *data;
    ptrdiff_t stride;
} lobe_in_f32;

typedef struct lobe_in_f64 {
    const double *data;
    ptrdiff_t stride;
} lobe_in_f64;

/* data NULL: not wanted. */
typedef struct lobe_out_f32 {
    float *data;
    ptrdiff_t stride;
} lobe_out_f32;

typedef struct lobe_out_f64 {
    double *data;
    ptrdiff_t stride;
} lobe_out_f64;

/* `prepared` for all rows, or NULL: then options, wi and alpha, prepared for each row.
 * u[0].data NULL: row i draws with the numbers (seed, offset + i) of lobe_draw_numbers; otherwise
 * u[0] and u[1] are read, and u[2] if it has data. Outputs are those of lobe_reflection_draw. Without wo, pdf and
 * weight (all NULL) the normals are drawn alone, in about two thirds of the time. */
typedef struct lobe_sample_batch_f32 {
    size_t count;
    const lobe_reflection_f32 *prepared;
    lobe_reflection_options options;
    lobe_in_f32 wi[3], alpha[2];
    lobe_in_f32 u[3];
    uint64_t seed, offset;
    lobe_out_f32 m[3], wo[3], cos_im, pdf_m, pdf, weight;
} lobe_sample_batch_f32;

typedef struct lobe_sample_batch_f64 {
    size_t count;
    const lobe_reflection_f64 *prepared;
    lobe_reflection_options options;
    lobe_in_f64 wi[3], alpha[2];
    lobe_in_f64 u[3];
    uint64_t seed, offset;
    lobe_out_f64 m[3], wo[3], cos_im, pdf_m, pdf, weight;
} lobe_sample_batch_f64;

/* Densities and values of given directions. */
typedef struct lobe_eval_batch_f32 {
    size_t count;
    const lobe_reflection_f32 *prepared;
    lobe_reflection_options options;
    lobe_in_f32 wi[3], alpha[2];
    lobe_in_f32 wo[3];
    lobe_out_f32 pdf, f_cos, cos_im;
} lobe_eval_batch_f32;

typedef struct lobe_eval_batch_f64 {
    size_t count;
    const lobe_reflection_f64 *prepared;
    lobe_reflection_options options;
    lobe_in_f64 wi[3], alpha[2];
    lobe_in_f64 wo[3];
    lobe_out_f64 pdf, f_cos, cos_im;
} lobe_eval_batch_f64;

LOBE_API void lobe_reflection_sample_batch_f32(const lobe_sample_batch_f32 *batch);
LOBE_API void lobe_reflection_sample_batch_f64(const lobe_sample_batch_f64 *batch);
LOBE_API void lobe_reflection_eval_batch_f32(const lobe_eval_batch_f32 *batch);
LOBE_API void lobe_reflection_eval_batch_f64(const lobe_eval_batch_f64 *batch);

/* The random numbers of a row: u1, u2, u3 in [0, 1). f32 takes the leading bits of f64's. */
LOBE_API void lobe_draw_numbers_f32(uint64_t seed, uint64_t row, float u[3]);
LOBE_API void lobe_draw_numbers_f64(uint64_t seed, uint64_t row, double u[3]);

/* The rows that were not rejected (pdf > 0), in order: writes their numbers to `rows`, which has room
 * for count of them, and returns how many there are. */
LOBE_API size_t lobe_accepted_rows_f32(size_t count, lobe_in_f32 pdf, uint32_t *rows);
LOBE_API size_t lobe_accepted_rows_f64(size_t count, lobe_in_f64 pdf, uint32_t *rows);

/* Instruction sets, from the plainest: "scalar", then those of the processor's family ("sse4.1",
 * "avx2", "avx512"; "neon"). The batches use the last one that the processor has, unless the
 * environment variable LOBE_ISA names one, or this: NULL or "" lifts the restriction. Returns 0 and
 * changes nothing for a name that is unknown or that this processor cannot run. */
LOBE_API int lobe_restrict_isa(const char *name);
/* The set in use. */
LOBE_API const char *lobe_isa(void);
/* The index-th set that this processor can run; NULL after the last. */
LOBE_API const char *lobe_isa_at(int index);

LOBE_END_C

#endif
