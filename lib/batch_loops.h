/* lib/batch_loops.h: the loops over a block, for one precision and one instruction set; the compiler
 * makes vectors of them (house.vectors looks). Before including:
 *   TARGET           the instruction set, as TARGET_AVX2 of target.h
 *   BATCH_TABLE      name of the table of loops, by the row of LOBE_MODELS
 * and the binding of the precision after target.h. */
#include "models.h"

#include "batch_rows.h"

K_FN void store_normal(const block *b, int i, facet_draw d) {
    b->m[0][i] = d.m.x;
    b->m[1][i] = d.m.y;
    b->m[2][i] = d.m.z;
    b->cos_im[i] = d.cos_im;
    b->pdf_m[i] = d.pdf_m;
}

K_FN void store_draw(const block *b, int i, facet_draw d) {
    store_normal(b, i, d);
    b->wo[0][i] = d.wo.x;
    b->wo[1][i] = d.wo.y;
    b->wo[2][i] = d.wo.z;
    b->pdf[i] = d.pdf;
    b->weight[i] = d.weight;
}

K_FN void store_eval(const block *b, int i, facet_pair pair, bool has_density, real f_cos,
                     real pdf) {
    b->cos_im[i] = k_select(has_density, pair.cos_im, R(0.0));
    b->f_cos[i] = k_select(has_density, f_cos, R(0.0));
    b->pdf[i] = k_select(k_and(has_density, pair.leaves), k_usable(pdf), R(0.0));
}

K_FN v3 load(const real *const arrays[3], int i) {
    return v3_of(arrays[0][i], arrays[1][i], arrays[2][i]);
}

/* A row of any model: what it draws, and what its density is. */
#define DEFINE_ROWS(NDF, MASKING, METHOD, kernel)                                                  \
    K_FN facet_draw kernel##_draw_row(FAMILY(NDF, MASKING, _base) g, kernel s, const block *b,     \
                                      int i) {                                                     \
        facet_draw d =                                                                             \
            kernel##_draw(s, k_unit(b->u[0][i]), k_unit(b->u[1][i]), k_unit(b->u[2][i]));          \
        return facet_draw_of(d, g.wi, g.plane, k_is(g.valid), k_is(g.mirror));                     \
    }                                                                                              \
    K_FN void kernel##_eval_row(FAMILY(NDF, MASKING, _base) g, kernel s, const block *b, int i,    \
                                bool has_density) {                                                \
        facet_pair pair = FAMILY(NDF, MASKING, _pair_of_wo)(g, load(b->to, i));                    \
        facet_eval known = FAMILY(NDF, MASKING, _eval)(g, pair);                                   \
        store_eval(b, i, pair, has_density, known.f_cos, kernel##_pdf(s, pair));                   \
    }
ALL_MODELS(DEFINE_ROWS)
#undef DEFINE_ROWS

/* A loop of a prepared model: `row` says what happens to row i of b, by the base g and the sampler s. */
#define SHARED_LOOP(NDF, MASKING, kernel, does, row)                                               \
    static void kernel##_##does##_shared(const block *b, int n, const void *state) {               \
        FAMILY(NDF, MASKING, _base) g;                                                             \
        kernel s;                                                                                  \
        memcpy(&g, state, sizeof g);                                                               \
        memcpy(&s, state, sizeof s);                                                               \
        INDEPENDENT_ROWS                                                                           \
        for (int i = 0, whole = whole_vectors(n); i < whole; ++i) row;                             \
    }
#define SAMPLE_SHARED(NDF, MASKING, METHOD, kernel)                                                \
    SHARED_LOOP(NDF, MASKING, kernel, sample, store_draw(b, i, kernel##_draw_row(g, s, b, i)))
#define NORMALS_SHARED(NDF, MASKING, METHOD, kernel)                                               \
    SHARED_LOOP(NDF, MASKING, kernel, normals, store_normal(b, i, kernel##_draw_row(g, s, b, i)))
#define EVAL_SHARED(NDF, MASKING, METHOD, kernel)                                                  \
    SHARED_LOOP(NDF, MASKING, kernel, eval, kernel##_eval_row(g, s, b, i, true))

/* A loop that prepares each row. The only plane is the shading plane: said here, the compiler leaves out the
 * other. */
#define EACH_LOOP(NDF, MASKING, kernel, does, row)                                                 \
    static void kernel##_##does##_each(const block *b, int n, facet_options options) {             \
        options.plane = v3_of(R(0.0), R(0.0), R(1.0));                                             \
        INDEPENDENT_ROWS                                                                           \
        for (int i = 0, whole = whole_vectors(n); i < whole; ++i) {                                \
            FAMILY(NDF, MASKING, _base)                                                            \
            g = FAMILY(NDF, MASKING, _base_of)(load(b->wi, i), b->alpha[0][i], b->alpha[1][i],     \
                                               options);                                           \
            kernel s = kernel##_prepare(g);                                                        \
            row;                                                                                   \
        }                                                                                          \
    }
#define SAMPLE_EACH(NDF, MASKING, METHOD, kernel)                                                  \
    EACH_LOOP(NDF, MASKING, kernel, sample, store_draw(b, i, kernel##_draw_row(g, s, b, i)))
#define NORMALS_EACH(NDF, MASKING, METHOD, kernel)                                                 \
    EACH_LOOP(NDF, MASKING, kernel, normals, store_normal(b, i, kernel##_draw_row(g, s, b, i)))
#define EVAL_EACH(NDF, MASKING, METHOD, kernel)                                                    \
    EACH_LOOP(NDF, MASKING, kernel, eval,                                                          \
              kernel##_eval_row(g, s, b, i, k_and(k_is(g.valid), !k_is(g.mirror))))

/* What stands in above a tilted plane is always prepared: rows that are not have no such plane. All that a
 * small build has is draws of prepared models. */
ALL_MODELS(SAMPLE_SHARED)
#if defined(LOBE_SMALL)
#define TABLE_ROW(NDF, MASKING, METHOD, kernel) {.sample_shared = kernel##_sample_shared},
#define TILTED_ROW TABLE_ROW
#else
ALL_MODELS(EVAL_SHARED)
LOBE_MODELS(NORMALS_SHARED)
LOBE_MODELS(SAMPLE_EACH)
LOBE_MODELS(NORMALS_EACH)
LOBE_MODELS(EVAL_EACH)
#define TABLE_ROW(NDF, MASKING, METHOD, kernel)                                                    \
    {kernel##_sample_each,    kernel##_sample_shared, kernel##_normals_each,                       \
     kernel##_normals_shared, kernel##_eval_each,     kernel##_eval_shared},
#define TILTED_ROW(NDF, MASKING, METHOD, kernel)                                                   \
    {.sample_shared = kernel##_sample_shared, .eval_shared = kernel##_eval_shared},
#endif
const batch_row BATCH_TABLE[ROW_COUNT] = {LOBE_MODELS(TABLE_ROW) TILTED_MODELS(TILTED_ROW)};
#undef TABLE_ROW
#undef TILTED_ROW
#undef EVAL_EACH
#undef NORMALS_EACH
#undef SAMPLE_EACH
#undef EACH_LOOP
#undef EVAL_SHARED
#undef NORMALS_SHARED
#undef SAMPLE_SHARED
#undef SHARED_LOOP
