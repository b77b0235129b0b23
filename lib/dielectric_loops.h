/* lib/dielectric_loops.h: the loops over rough dielectrics, for one precision and one instruction set, as
 * batch_loops.h has them for reflection. Before including: TARGET, BATCH_TABLE and the binding, as there. */
#include "batch_rows.h"

#include "dielectric_rows.h"

K_FN v3 load(const real *const arrays[3], int i) {
    return v3_of(arrays[0][i], arrays[1][i], arrays[2][i]);
}

K_FN ggx_dielectric prepared(const dielectric_block *b, int i, dielectric_options options) {
    ggx_dielectric s =
        ggx_dielectric_prepare(load(b->wi, i), b->alpha[0][i], b->alpha[1][i], b->ior[i], options);
    s.side.boost = b->boost[i];
    return s;
}

K_FN void draw_row(const dielectric_block *b, int i, ggx_dielectric s) {
    dielectric_draw d =
        ggx_dielectric_draw(s, k_unit(b->u[0][i]), k_unit(b->u[1][i]), k_unit(b->u[2][i]));
    b->m[0][i] = d.m.x;
    b->m[1][i] = d.m.y;
    b->m[2][i] = d.m.z;
    b->wo[0][i] = d.wo.x;
    b->wo[1][i] = d.wo.y;
    b->wo[2][i] = d.wo.z;
    b->cos_im[i] = d.cos_im;
    b->fresnel[i] = d.fresnel;
    b->pdf_m[i] = d.pdf_m;
    b->pdf[i] = d.pdf;
    b->weight[i] = d.weight;
    b->is_point[i] = k_select(d.is_point, R(1.0), R(0.0));
}

K_FN void eval_row(const dielectric_block *b, int i, ggx_dielectric s) {
    dielectric_value v = ggx_dielectric_eval(s, load(b->to, i)).value;
    b->pdf[i] = v.pdf;
    b->f_cos[i] = v.f_cos;
    b->fresnel[i] = v.fresnel;
    b->cos_im[i] = v.cos_im;
}

static void ggx_dielectric_sample_each(const dielectric_block *b, int n,
                                       dielectric_options options) {
    INDEPENDENT_ROWS
    for (int i = 0, whole = whole_vectors(n); i < whole; ++i)
        draw_row(b, i, prepared(b, i, options));
}

static void ggx_dielectric_sample_shared(const dielectric_block *b, int n, const void *state) {
    ggx_dielectric s;
    memcpy(&s, state, sizeof s);
    INDEPENDENT_ROWS
    for (int i = 0, whole = whole_vectors(n); i < whole; ++i) draw_row(b, i, s);
}

static void ggx_dielectric_eval_each(const dielectric_block *b, int n, dielectric_options options) {
    INDEPENDENT_ROWS
    for (int i = 0, whole = whole_vectors(n); i < whole; ++i)
        eval_row(b, i, prepared(b, i, options));
}

static void ggx_dielectric_eval_shared(const dielectric_block *b, int n, const void *state) {
    ggx_dielectric s;
    memcpy(&s, state, sizeof s);
    INDEPENDENT_ROWS
    for (int i = 0, whole = whole_vectors(n); i < whole; ++i) eval_row(b, i, s);
}

const dielectric_loops BATCH_TABLE = {ggx_dielectric_sample_each, ggx_dielectric_sample_shared,
                                      ggx_dielectric_eval_each, ggx_dielectric_eval_shared};
