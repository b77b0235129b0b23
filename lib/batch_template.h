/* lib/batch_template.h: the public batches over the loops, once for each precision. Before including:
 *   BATCH_NAME(stem)   stem_f32 or stem_f64
 * and the binding of the precision. The loops work on blocks of whole vectors: where they are, or in arrays
 * that stand in, which makes strides and tails nobody's business but that of two copying loops. */
#include "batch_views.h"
#include "isa.h"
#include "models.h"

typedef BATCH_NAME(lobe_sample_batch) sample_batch;
typedef BATCH_NAME(lobe_eval_batch) eval_batch;
typedef BATCH_NAME(lobe_reflection) model_type;

#define DECLARE_TABLE(ID, stem, name)                                                              \
    extern const batch_row BATCH_NAME(lobe_batch_##stem)[ROW_COUNT];
LOBE_ISAS(DECLARE_TABLE)
#undef DECLARE_TABLE

/* The loops of the instruction set in use. */
static const batch_row *loops_of(int row) {
    static const batch_row *const tables[LOBE_ISA_COUNT] = {
#define TABLE(ID, stem, name) BATCH_NAME(lobe_batch_##stem),
        LOBE_ISAS(TABLE)
#undef TABLE
    };
    return &tables[lobe_isa_in_use()][row];
}

/* Arrays that stand in for those of a batch: where rows are not side by side, or end before a vector does,
 * and for outputs that nobody wants. */
typedef struct stand_in {
    real wi[3][BLOCK], alpha[2][BLOCK], u[3][BLOCK], to[3][BLOCK];
    real m[3][BLOCK], wo[3][BLOCK], cos_im[BLOCK];
    real pdf_m[BLOCK], pdf[BLOCK], weight[BLOCK], f_cos[BLOCK];
} stand_in;

static void gather_points(const input wi[3], const input alpha[2], size_t first, int n, block *b,
                          stand_in *s) {
    for (int k = 0; k < 3; ++k) b->wi[k] = gather(wi[k], first, n, s->wi[k]);
    for (int k = 0; k < 2; ++k) b->alpha[k] = gather(alpha[k], first, n, s->alpha[k]);
}

static void place_draws(const sample_batch *batch, size_t first, int n, block *b, stand_in *s) {
    for (int k = 0; k < 3; ++k) {
        b->m[k] = place_of(batch->m[k], first, n, s->m[k]);
        b->wo[k] = place_of(batch->wo[k], first, n, s->wo[k]);
    }
    b->cos_im = place_of(batch->cos_im, first, n, s->cos_im);
    b->pdf_m = place_of(batch->pdf_m, first, n, s->pdf_m);
    b->pdf = place_of(batch->pdf, first, n, s->pdf);
    b->weight = place_of(batch->weight, first, n, s->weight);
}

static void scatter_draws(const sample_batch *batch, size_t first, int n, const stand_in *s) {
    for (int k = 0; k < 3; ++k) {
        scatter(batch->m[k], first, n, s->m[k]);
        scatter(batch->wo[k], first, n, s->wo[k]);
    }
    scatter(batch->cos_im, first, n, s->cos_im);
    scatter(batch->pdf_m, first, n, s->pdf_m);
    scatter(batch->pdf, first, n, s->pdf);
    scatter(batch->weight, first, n, s->weight);
}

/* What all rows of a batch share: the loops, and what they are prepared from. */
typedef struct shared {
    const batch_row *loops;
    facet_options options;
    const void *state; /* NULL: each row is prepared */
    bool is_known;     /* else: every result is 0 */
} shared;

static shared shared_of(const model_type *prepared, const lobe_reflection_options *options) {
    shared s = {NULL,
                facet_options_of(options->g2 == LOBE_G2_SEPARABLE,
                                 options->normalization == LOBE_NORMALIZATION_PREVIOUS),
                NULL, true};
    s.options.floor_share = (real)options->floor;
    int row = prepared ? prepared->row : BATCH_NAME(lobe_find_row)(options->model);
    s.is_known = prepared ? prepared->is_valid : row >= 0;
    if (prepared) s.state = prepared->prepared;
    if (s.is_known) s.loops = loops_of(row);
    return s;
}

/* Of a model that does not exist all results are 0. */
static void clear(output out, size_t count) {
    for (size_t i = 0; out.data != NULL && i < count; ++i) out.data[(ptrdiff_t)i * out.stride] = 0;
}

static void clear_draws(const sample_batch *batch) {
    for (int k = 0; k < 3; ++k) {
        clear(batch->m[k], batch->count);
        clear(batch->wo[k], batch->count);
    }
    clear(batch->cos_im, batch->count);
    clear(batch->pdf_m, batch->count);
    clear(batch->pdf, batch->count);
    clear(batch->weight, batch->count);
}

static void clear_evals(const eval_batch *batch) {
    clear(batch->pdf, batch->count);
    clear(batch->f_cos, batch->count);
    clear(batch->cos_im, batch->count);
}

/* Nobody asks for reflections. */
static bool wants_normals_only(const sample_batch *batch) {
    return batch->wo[0].data == NULL && batch->wo[1].data == NULL && batch->wo[2].data == NULL &&
           batch->pdf.data == NULL && batch->weight.data == NULL;
}

static void sample_prepared(const shared *of_all, bool only_normals, const block *b, int n) {
    const batch_row *loops = of_all->loops;
    if (only_normals && loops->normals_shared != NULL)
        loops->normals_shared(b, n, of_all->state);
    else
        loops->sample_shared(b, n, of_all->state);
}

static void sample_unprepared(const shared *of_all, bool only_normals, const block *b, int n) {
    const batch_row *loops = of_all->loops;
    if (only_normals)
        loops->normals_each(b, n, of_all->options);
    else
        loops->sample_each(b, n, of_all->options);
}

void BATCH_NAME(lobe_reflection_sample_batch)(const sample_batch *batch) {
    const shared of_all = shared_of(batch->prepared, &batch->options);
    if (!of_all.is_known) {
        clear_draws(batch);
        return;
    }
    const bool only_normals = wants_normals_only(batch);
    block b;
    stand_in s;
    for (size_t first = 0; first < batch->count; first += BLOCK) {
        int n = rows_at(batch->count, first);
        gather_numbers(batch->u, batch->seed, batch->offset, first, n, b.u, s.u);
        place_draws(batch, first, n, &b, &s);
        if (of_all.state != NULL) {
            sample_prepared(&of_all, only_normals, &b, n);
        } else {
            gather_points(batch->wi, batch->alpha, first, n, &b, &s);
            sample_unprepared(&of_all, only_normals, &b, n);
        }
        scatter_draws(batch, first, n, &s);
    }
}

void BATCH_NAME(lobe_reflection_eval_batch)(const eval_batch *batch) {
    const shared of_all = shared_of(batch->prepared, &batch->options);
    const bool is_mirror = batch->prepared && batch->prepared->is_mirror; /* a point mass */
    if (!of_all.is_known || is_mirror) {
        clear_evals(batch);
        return;
    }
    block b;
    stand_in s;
    for (size_t first = 0; first < batch->count; first += BLOCK) {
        int n = rows_at(batch->count, first);
        for (int k = 0; k < 3; ++k) b.to[k] = gather(batch->wo[k], first, n, s.to[k]);
        b.pdf = place_of(batch->pdf, first, n, s.pdf);
        b.f_cos = place_of(batch->f_cos, first, n, s.f_cos);
        b.cos_im = place_of(batch->cos_im, first, n, s.cos_im);
        if (of_all.state != NULL) {
            of_all.loops->eval_shared(&b, n, of_all.state);
        } else {
            gather_points(batch->wi, batch->alpha, first, n, &b, &s);
            of_all.loops->eval_each(&b, n, of_all.options);
        }
        scatter(batch->pdf, first, n, s.pdf);
        scatter(batch->f_cos, first, n, s.f_cos);
        scatter(batch->cos_im, first, n, s.cos_im);
    }
}

size_t BATCH_NAME(lobe_accepted_rows)(size_t count, input pdf, uint32_t *rows) {
    size_t accepted = 0;
    for (size_t i = 0; i < count; ++i) {
        rows[accepted] = (uint32_t)i; /* overwritten if this row is rejected: no branch */
        accepted += pdf.data[(ptrdiff_t)i * pdf.stride] > 0;
    }
    return accepted;
}
