/* lib/batch_loops.h: the loops over a block, for one precision and one instruction set; the compiler
 * makes vectors of them (house.vectors looks). Before including:
 *   TARGET           the instruction set, as TARGET_AVX2 of target.h
 *   BATCH_TABLE      name of the table of loops, by the row of LOBE_MODELS
 * and the binding of the precision after target.h. */
#include "models.h"

#include "batch_rows.h"

K_FN void store_draw(const block *b, int i, facet_draw d) {
    b->m[0][i] = d.m.x;
    b->m[1][i] = d.m.y;
    b->m[2][i] = d.m.z;
    b->wo[0][i] = d.wo.x;
    b->wo[1][i] = d.wo.y;
    b->wo[2][i] = d.wo.z;
    b->cos_im[i] = d.cos_im;
    b->pdf_m[i] = d.pdf_m;
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

#define DEFINE_SHARED(NDF, MASKING, METHOD, kernel)                                                \
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
    }                                                                                              \
    static void kernel##_sample_shared(const block *b, int n, const void *state) {                 \
        FAMILY(NDF, MASKING, _base) g;                                                             \
        kernel s;                                                                                  \
        memcpy(&g, state, sizeof g);                                                               \
        memcpy(&s, state, sizeof s);                                                               \
        INDEPENDENT_ROWS                                                                           \
        for (int i = 0, whole = whole_vectors(n); i < whole; ++i)                                  \
            store_draw(b, i, kernel##_draw_row(g, s, b, i));                                       \
    }                                                                                              \
    static void kernel##_eval_shared(const block *b, int n, const void *state) {                   \
        FAMILY(NDF, MASKING, _base) g;                                                             \
        kernel s;                                                                                  \
        memcpy(&g, state, sizeof g);                                                               \
        memcpy(&s, state, sizeof s);                                                               \
        INDEPENDENT_ROWS                                                                           \
        for (int i = 0, whole = whole_vectors(n); i < whole; ++i)                                  \
            kernel##_eval_row(g, s, b, i, true);                                                   \
    }
ALL_MODELS(DEFINE_SHARED)
#undef DEFINE_SHARED

/* Each row is prepared. The only plane is the shading plane: said here, the compiler leaves out the other. */
#define DEFINE_EACH(NDF, MASKING, METHOD, kernel)                                                  \
    static void kernel##_sample_each(const block *b, int n, facet_options options) {               \
        options.plane = v3_of(R(0.0), R(0.0), R(1.0));                                             \
        INDEPENDENT_ROWS                                                                           \
        for (int i = 0, whole = whole_vectors(n); i < whole; ++i) {                                \
            FAMILY(NDF, MASKING, _base)                                                            \
            g = FAMILY(NDF, MASKING, _base_of)(load(b->wi, i), b->alpha[0][i], b->alpha[1][i],     \
                                               options);                                           \
            store_draw(b, i, kernel##_draw_row(g, kernel##_prepare(g), b, i));                     \
        }                                                                                          \
    }                                                                                              \
    static void kernel##_eval_each(const block *b, int n, facet_options options) {                 \
        options.plane = v3_of(R(0.0), R(0.0), R(1.0));                                             \
        INDEPENDENT_ROWS                                                                           \
        for (int i = 0, whole = whole_vectors(n); i < whole; ++i) {                                \
            FAMILY(NDF, MASKING, _base)                                                            \
            g = FAMILY(NDF, MASKING, _base_of)(load(b->wi, i), b->alpha[0][i], b->alpha[1][i],     \
                                               options);                                           \
            kernel##_eval_row(g, kernel##_prepare(g), b, i,                                        \
                              k_and(k_is(g.valid), !k_is(g.mirror)));                              \
        }                                                                                          \
    }
LOBE_MODELS(DEFINE_EACH)
#undef DEFINE_EACH

/* All that a small build has is draws of prepared models. */
#if defined(LOBE_SMALL)
#define UNLESS_SMALL(function) NULL
#else
#define UNLESS_SMALL(function) function
#endif

/* What stands in above a tilted plane is always prepared: rows that are not have no such plane. */
#define TABLE_ROW(NDF, MASKING, METHOD, kernel)                                                    \
    {UNLESS_SMALL(kernel##_sample_each), kernel##_sample_shared, UNLESS_SMALL(kernel##_eval_each), \
     UNLESS_SMALL(kernel##_eval_shared)},
#define TILTED_ROW(NDF, MASKING, METHOD, kernel)                                                   \
    {NULL, kernel##_sample_shared, NULL, UNLESS_SMALL(kernel##_eval_shared)},
const batch_row BATCH_TABLE[ROW_COUNT] = {LOBE_MODELS(TABLE_ROW) TILTED_MODELS(TILTED_ROW)};
#undef TABLE_ROW
#undef TILTED_ROW
#undef UNLESS_SMALL
