/* lib/dielectric_batch_template.h: the public batches of dielectrics over their loops, as batch_template.h has
 * them for reflection. Before including: BATCH_NAME and the binding of a precision. */
#include "lobe/dielectric_batch.h"

#include "batch_views.h"
#include "dielectric_rows.h"
#include "isa.h"

typedef BATCH_NAME(lobe_dielectric_sample_batch) sample_batch;
typedef BATCH_NAME(lobe_dielectric_eval_batch) eval_batch;
typedef BATCH_NAME(lobe_dielectric) model_type;

#define DECLARE_TABLE(ID, stem, name)                                                              \
    extern const dielectric_loops BATCH_NAME(lobe_dielectric_batch_##stem);
LOBE_ISAS(DECLARE_TABLE)
#undef DECLARE_TABLE

static const dielectric_loops *loops_in_use(void) {
    static const dielectric_loops *const tables[LOBE_ISA_COUNT] = {
#define TABLE(ID, stem, name) &BATCH_NAME(lobe_dielectric_batch_##stem),
        LOBE_ISAS(TABLE)
#undef TABLE
    };
    return tables[lobe_isa_in_use()];
}

typedef struct stand_in {
    real wi[3][BLOCK], alpha[2][BLOCK], ior[BLOCK], boost[BLOCK], u[3][BLOCK], to[3][BLOCK];
    real m[3][BLOCK], wo[3][BLOCK], cos_im[BLOCK], fresnel[BLOCK];
    real pdf_m[BLOCK], pdf[BLOCK], weight[BLOCK], is_point[BLOCK], f_cos[BLOCK];
} stand_in;

static dielectric_options kernel_options(lobe_dielectric_options options) {
    dielectric_options o;
    o.separable = k_flag(options.g2 == LOBE_G2_SEPARABLE);
    o.importance = k_flag(options.transport == LOBE_TRANSPORT_IMPORTANCE);
    o.thin = k_flag(options.thin != 0);
    o.compensate = k_flag(options.compensate != 0);
    return o;
}

/* The energy of a row comes from a table, which loops do not look into. */
static void find_boosts(const dielectric_block *b, int n, lobe_dielectric_options options,
                        real *boost) {
    for (int i = 0; i < whole_vectors(n); ++i) {
        boost[i] = 1;
        if (!options.compensate) continue;
        const BATCH_NAME(lobe_vec3) wi = {b->wi[0][i], b->wi[1][i], b->wi[2][i]};
        boost[i] = BATCH_NAME(lobe_dielectric_prepare)(options, wi, b->alpha[0][i], b->alpha[1][i],
                                                       b->ior[i])
                       .energy_factor;
    }
}

static void gather_points(const input wi[3], const input alpha[2], input ior, size_t first, int n,
                          lobe_dielectric_options options, dielectric_block *b, stand_in *s) {
    for (int k = 0; k < 3; ++k) b->wi[k] = gather(wi[k], first, n, s->wi[k]);
    for (int k = 0; k < 2; ++k) b->alpha[k] = gather(alpha[k], first, n, s->alpha[k]);
    b->ior = gather(ior, first, n, s->ior);
    find_boosts(b, n, options, s->boost);
    b->boost = s->boost;
}

static void place_draws(const sample_batch *batch, size_t first, int n, dielectric_block *b,
                        stand_in *s) {
    for (int k = 0; k < 3; ++k) {
        b->m[k] = place_of(batch->m[k], first, n, s->m[k]);
        b->wo[k] = place_of(batch->wo[k], first, n, s->wo[k]);
    }
    b->cos_im = place_of(batch->cos_im, first, n, s->cos_im);
    b->fresnel = place_of(batch->fresnel, first, n, s->fresnel);
    b->pdf_m = place_of(batch->pdf_m, first, n, s->pdf_m);
    b->pdf = place_of(batch->pdf, first, n, s->pdf);
    b->weight = place_of(batch->weight, first, n, s->weight);
    b->is_point = place_of(batch->is_point, first, n, s->is_point);
}

static void scatter_draws(const sample_batch *batch, size_t first, int n, const stand_in *s) {
    for (int k = 0; k < 3; ++k) {
        scatter(batch->m[k], first, n, s->m[k]);
        scatter(batch->wo[k], first, n, s->wo[k]);
    }
    scatter(batch->cos_im, first, n, s->cos_im);
    scatter(batch->fresnel, first, n, s->fresnel);
    scatter(batch->pdf_m, first, n, s->pdf_m);
    scatter(batch->pdf, first, n, s->pdf);
    scatter(batch->weight, first, n, s->weight);
    scatter(batch->is_point, first, n, s->is_point);
}

void BATCH_NAME(lobe_dielectric_sample_many)(const sample_batch *batch) {
    const dielectric_loops *loops = loops_in_use();
    const dielectric_options options = kernel_options(batch->options);
    dielectric_block b;
    stand_in s;
    for (size_t first = 0; first < batch->count; first += BLOCK) {
        int n = rows_at(batch->count, first);
        gather_numbers(batch->u, batch->seed, batch->offset, first, n, b.u, s.u);
        place_draws(batch, first, n, &b, &s);
        if (batch->prepared != NULL) {
            loops->sample_shared(&b, n, batch->prepared->prepared);
        } else {
            gather_points(batch->wi, batch->alpha, batch->ior, first, n, batch->options, &b, &s);
            loops->sample_each(&b, n, options);
        }
        scatter_draws(batch, first, n, &s);
    }
}

void BATCH_NAME(lobe_dielectric_eval_many)(const eval_batch *batch) {
    const dielectric_loops *loops = loops_in_use();
    const dielectric_options options = kernel_options(batch->options);
    dielectric_block b;
    stand_in s;
    for (size_t first = 0; first < batch->count; first += BLOCK) {
        int n = rows_at(batch->count, first);
        for (int k = 0; k < 3; ++k) b.to[k] = gather(batch->wo[k], first, n, s.to[k]);
        b.pdf = place_of(batch->pdf, first, n, s.pdf);
        b.f_cos = place_of(batch->f_cos, first, n, s.f_cos);
        b.fresnel = place_of(batch->fresnel, first, n, s.fresnel);
        b.cos_im = place_of(batch->cos_im, first, n, s.cos_im);
        if (batch->prepared != NULL) {
            loops->eval_shared(&b, n, batch->prepared->prepared);
        } else {
            gather_points(batch->wi, batch->alpha, batch->ior, first, n, batch->options, &b, &s);
            loops->eval_each(&b, n, options);
        }
        scatter(batch->pdf, first, n, s.pdf);
        scatter(batch->f_cos, first, n, s.f_cos);
        scatter(batch->fresnel, first, n, s.fresnel);
        scatter(batch->cos_im, first, n, s.cos_im);
    }
}
