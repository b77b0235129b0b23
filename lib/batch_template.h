/* lib/batch_template.h: the public batches over the loops, once for each precision. Before including:
 *   BATCH_NAME(stem)   stem_f32 or stem_f64
 * and the binding of the precision. Rows go through a block of arrays: that is what makes strides,
 * alignment, arrays used twice and tails nobody's business but that of two copying loops. */
#include "lobe/batch.h"
#include "lobe/random.h"

#include "batch_rows.h"
#include "isa.h"
#include "models.h"

typedef BATCH_NAME(lobe_sample_batch) sample_batch;
typedef BATCH_NAME(lobe_eval_batch) eval_batch;
typedef BATCH_NAME(lobe_in) input;
typedef BATCH_NAME(lobe_out) output;
typedef BATCH_NAME(lobe_reflection) model_type;

#define DECLARE_TABLE(ID, stem) extern const batch_row BATCH_NAME(lobe_batch_##stem)[ROW_COUNT];
LOBE_ISAS(DECLARE_TABLE)
#undef DECLARE_TABLE

/* The loops of the instruction set in use. */
static const batch_row *loops_of(int row) {
    static const batch_row *const tables[LOBE_ISA_COUNT] = {
#define TABLE(ID, stem) BATCH_NAME(lobe_batch_##stem),
        LOBE_ISAS(TABLE)
#undef TABLE
    };
    return &tables[lobe_isa_in_use()][row];
}

/* And copies of the last row up to whole vectors. */
static void gather(input in, size_t first, int n, real *to) {
    const real *from = in.data + (ptrdiff_t)first * in.stride;
    if (in.stride == 1) {
        memcpy(to, from, (size_t)n * sizeof(real));
    } else {
        for (int i = 0; i < n; ++i) to[i] = from[i * in.stride];
    }
    for (int i = n; i < whole_vectors(n); ++i) to[i] = to[n - 1];
}

static void scatter(output out, size_t first, int n, const real *from) {
    if (out.data == NULL) return;
    real *to = out.data + (ptrdiff_t)first * out.stride;
    if (out.stride == 1) {
        memcpy(to, from, (size_t)n * sizeof(real));
        return;
    }
    for (int i = 0; i < n; ++i) to[i * out.stride] = from[i];
}

static void gather_numbers(const sample_batch *batch, size_t first, int n, block *b) {
    if (batch->u[0].data != NULL) {
        for (int k = 0; k < 3; ++k) {
            if (batch->u[k].data != NULL)
                gather(batch->u[k], first, n, b->u[k]);
            else
                memset(b->u[k], 0, (size_t)whole_vectors(n) * sizeof(real));
        }
        return;
    }
    for (int i = 0; i < whole_vectors(n); ++i) {
        real u[3];
        BATCH_NAME(lobe_draw_numbers)(batch->seed, batch->offset + first + (uint64_t)i, u);
        for (int k = 0; k < 3; ++k) b->u[k][i] = u[k];
    }
}

static void gather_points(const input wi[3], const input alpha[2], size_t first, int n, block *b) {
    for (int k = 0; k < 3; ++k) gather(wi[k], first, n, b->wi[k]);
    for (int k = 0; k < 2; ++k) gather(alpha[k], first, n, b->alpha[k]);
}

static void scatter_draws(const sample_batch *batch, size_t first, int n, const block *b) {
    for (int k = 0; k < 3; ++k) {
        scatter(batch->m[k], first, n, b->m[k]);
        scatter(batch->wo[k], first, n, b->wo[k]);
    }
    scatter(batch->cos_im, first, n, b->cos_im);
    scatter(batch->pdf_m, first, n, b->pdf_m);
    scatter(batch->pdf, first, n, b->pdf);
    scatter(batch->weight, first, n, b->weight);
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

static int rows_at(size_t count, size_t first) {
    return count - first < BLOCK ? (int)(count - first) : BLOCK;
}

void BATCH_NAME(lobe_reflection_sample_batch)(const sample_batch *batch) {
    shared s = shared_of(batch->prepared, &batch->options);
    block b;
    if (!s.is_known) memset(&b, 0, sizeof b);
    for (size_t first = 0; first < batch->count; first += BLOCK) {
        int n = rows_at(batch->count, first);
        if (s.is_known) {
            gather_numbers(batch, first, n, &b);
            if (s.state != NULL) {
                s.loops->sample_shared(&b, n, s.state);
            } else {
                gather_points(batch->wi, batch->alpha, first, n, &b);
                s.loops->sample_each(&b, n, s.options);
            }
        }
        scatter_draws(batch, first, n, &b);
    }
}

void BATCH_NAME(lobe_reflection_eval_batch)(const eval_batch *batch) {
    shared s = shared_of(batch->prepared, &batch->options);
    if (batch->prepared && batch->prepared->is_mirror) s.is_known = false; /* a point mass */
    block b;
    if (!s.is_known) memset(&b, 0, sizeof b);
    for (size_t first = 0; first < batch->count; first += BLOCK) {
        int n = rows_at(batch->count, first);
        if (s.is_known) {
            for (int k = 0; k < 3; ++k) gather(batch->wo[k], first, n, b.wo[k]);
            if (s.state != NULL) {
                s.loops->eval_shared(&b, n, s.state);
            } else {
                gather_points(batch->wi, batch->alpha, first, n, &b);
                s.loops->eval_each(&b, n, s.options);
            }
        }
        scatter(batch->pdf, first, n, b.pdf);
        scatter(batch->f_cos, first, n, b.f_cos);
        scatter(batch->cos_im, first, n, b.cos_im);
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
