/* lib/reflection_template.h: the public reflection functions over the kernels, once for each precision.
 *
 * Before including: the binding of the precision, and
 *   LOBE_NAME(stem)   lobe_stem_f32 or lobe_stem_f64
 * The models come from LOBE_MODELS. Each is a kernel of five functions (prepare, draw, pdf, pdf_m,
 * acceptance) over a family of five (base_of, pair_of_wo, pair_of_m, eval, vndf_integral;
 * kernel/facet.h). */
#include "models.h"

typedef LOBE_NAME(reflection) model_type;
typedef LOBE_NAME(reflection_draw) draw_type;
typedef LOBE_NAME(reflection_eval) eval_type;
typedef LOBE_NAME(vec3) vec_type;

static v3 in(vec_type v) {
    return v3_of(v.x, v.y, v.z);
}

static vec_type out(v3 v) {
    vec_type r = {v.x, v.y, v.z};
    return r;
}

/* What a row of the list can do. A kernel's state lies in the private part of the public value. */
typedef struct row {
    void (*prepare_at)(model_type *model, v3 wi, real ax, real ay, const facet_options *options);
    model_type (*prepare)(v3 wi, real ax, real ay, const facet_options *options);
    facet_draw (*draw)(const model_type *model, real u1, real u2, real u3);
    real (*pdf)(const model_type *model, v3 wo);
    eval_type (*eval_wo)(const model_type *model, v3 wo);
    eval_type (*eval_m)(const model_type *model, v3 m);
    real (*acceptance)(const model_type *model);
    real (*vndf_integral)(const model_type *model);
} row;

static eval_type eval_of(facet_pair pair, facet_eval known, real pdf_m, real pdf) {
    eval_type e;
    e.d = known.d;
    e.g1_i = known.g1_i;
    e.g1_o = known.g1_o;
    e.g2 = known.g2;
    e.pdf_m = known.d > 0 ? k_usable(pdf_m) : R(0.0);
    e.pdf = pair.leaves ? k_usable(pdf) : R(0.0);
    e.f_cos = known.f_cos;
    e.cos_im = pair.cos_im;
    return e;
}

#define LOAD(type, value)                                                                          \
    type value;                                                                                    \
    memcpy(&value, model->prepared, sizeof value)

/* Every kernel state begins with the base of its family. */
#define DEFINE_ROW(NDF, MASKING, METHOD, kernel)                                                   \
    _Static_assert(sizeof(kernel) <= sizeof(((model_type *)0)->prepared),                          \
                   #kernel " is too large");                                                       \
    K_FN void kernel##_row_prepare_at(model_type *model, v3 wi, real ax, real ay,                  \
                                      const facet_options *options) {                              \
        FAMILY(NDF, MASKING, _base) g = FAMILY(NDF, MASKING, _base_of)(wi, ax, ay, *options);      \
        kernel s = kernel##_prepare(g);                                                            \
        model->row = INDEX_##kernel;                                                               \
        model->is_valid = g.valid;                                                                 \
        model->is_mirror = g.valid && g.mirror;                                                    \
        model->alpha_x = g.ax;                                                                     \
        model->alpha_y = g.ay;                                                                     \
        model->wi = out(g.wi);                                                                     \
        memcpy(model->prepared, &s, sizeof s);                                                     \
    }                                                                                              \
    static model_type kernel##_row_prepare(v3 wi, real ax, real ay,                                \
                                           const facet_options *options) {                         \
        model_type model;                                                                          \
        kernel##_row_prepare_at(&model, wi, ax, ay, options);                                      \
        return model;                                                                              \
    }                                                                                              \
    static facet_draw kernel##_row_draw(const model_type *model, real u1, real u2, real u3) {      \
        LOAD(FAMILY(NDF, MASKING, _base), g);                                                      \
        LOAD(kernel, s);                                                                           \
        facet_draw d = kernel##_draw(s, u1, u2, u3);                                               \
        return facet_draw_of(d, g.wi, g.plane, g.valid, g.mirror);                                 \
    }                                                                                              \
    static real kernel##_row_pdf(const model_type *model, v3 wo) {                                 \
        LOAD(FAMILY(NDF, MASKING, _base), g);                                                      \
        LOAD(kernel, s);                                                                           \
        facet_pair pair = FAMILY(NDF, MASKING, _pair_of_wo)(g, wo);                                \
        return pair.leaves ? k_usable(kernel##_pdf(s, pair)) : R(0.0);                             \
    }                                                                                              \
    static eval_type kernel##_row_eval_wo(const model_type *model, v3 wo) {                        \
        LOAD(FAMILY(NDF, MASKING, _base), g);                                                      \
        LOAD(kernel, s);                                                                           \
        facet_pair pair = FAMILY(NDF, MASKING, _pair_of_wo)(g, wo);                                \
        facet_eval known = FAMILY(NDF, MASKING, _eval)(g, pair);                                   \
        return eval_of(pair, known, kernel##_pdf_m(s, pair), kernel##_pdf(s, pair));               \
    }                                                                                              \
    static eval_type kernel##_row_eval_m(const model_type *model, v3 m) {                          \
        LOAD(FAMILY(NDF, MASKING, _base), g);                                                      \
        LOAD(kernel, s);                                                                           \
        facet_pair pair = FAMILY(NDF, MASKING, _pair_of_m)(g, m);                                  \
        facet_eval known = FAMILY(NDF, MASKING, _eval)(g, pair);                                   \
        return eval_of(pair, known, kernel##_pdf_m(s, pair), kernel##_pdf(s, pair));               \
    }                                                                                              \
    static real kernel##_row_acceptance(const model_type *model) {                                 \
        LOAD(FAMILY(NDF, MASKING, _base), g);                                                      \
        LOAD(kernel, s);                                                                           \
        return g.mirror ? facet_mirror_draw(g.wi, g.plane).pdf : kernel##_acceptance(s);           \
    }                                                                                              \
    static real kernel##_row_vndf_integral(const model_type *model) {                              \
        LOAD(FAMILY(NDF, MASKING, _base), g);                                                      \
        return g.mirror ? R(1.0) : FAMILY(NDF, MASKING, _vndf_integral)(g);                        \
    }
ALL_MODELS(DEFINE_ROW)
#undef DEFINE_ROW
#undef LOAD

#define TABLE_ROW(NDF, MASKING, METHOD, kernel)                                                    \
    {kernel##_row_prepare_at, kernel##_row_prepare,      kernel##_row_draw,                        \
     kernel##_row_pdf,        kernel##_row_eval_wo,      kernel##_row_eval_m,                      \
     kernel##_row_acceptance, kernel##_row_vndf_integral},
static const row rows[ROW_COUNT] = {ALL_MODELS(TABLE_ROW)};
#undef TABLE_ROW

/* One more than the index of a model's row; 0 where the combination does not exist. */
#define FIND_ROW(NDF, MASKING, METHOD, kernel)                                                     \
    [LOBE_NDF_##NDF][LOBE_MASKING_##MASKING][LOBE_METHOD_##METHOD] = INDEX_##kernel + 1,
static const unsigned char row_of[LOBE_NDF_COUNT][LOBE_MASKING_COUNT][LOBE_METHOD_COUNT] = {
    LOBE_MODELS(FIND_ROW)};
static const unsigned char tilted_row_of[LOBE_NDF_COUNT][LOBE_MASKING_COUNT][LOBE_METHOD_COUNT] = {
    TILTED_MODELS(FIND_ROW)};
#undef FIND_ROW

int LOBE_NAME(find_row)(lobe_model m) {
    bool known = (unsigned)m.ndf < LOBE_NDF_COUNT && (unsigned)m.masking < LOBE_MASKING_COUNT &&
                 (unsigned)m.method < LOBE_METHOD_COUNT;
    return known ? row_of[m.ndf][m.masking][m.method] - 1 : -1;
}

/* The row of a model that exists, above a plane. Preparing for two planes costs several times as much:
 * below this tilt, rejecting by the second plane is cheaper than sampling without it
 * (docs/horizon-planes.md). One rule for sampler and density: they share the prepared row. */
static int row_above(lobe_model m, v3 plane) {
    unsigned char tilted = tilted_row_of[m.ndf][m.masking][m.method];
    bool is_table = m.method == LOBE_METHOD_HORIZON;
    bool is_steep = plane.z < (is_table ? FACET_TABLE_TILT_COSINE : FACET_ELLIPSE_TILT_COSINE);
    return is_steep && tilted ? tilted - 1 : LOBE_NAME(find_row)(m);
}

static facet_options choices_of(const lobe_reflection_options *options, vec_type plane) {
    facet_options choices = facet_options_of(options->g2 == LOBE_G2_SEPARABLE,
                                             options->normalization == LOBE_NORMALIZATION_PREVIOUS);
    choices.plane = in(plane);
    choices.floor_share = (real)options->floor;
    return choices;
}

void LOBE_NAME(reflection_prepare_at)(model_type *model, const lobe_reflection_options *options,
                                      vec_type wi, real alpha_x, real alpha_y,
                                      vec_type geometric_normal) {
    const facet_options choices = choices_of(options, geometric_normal);
    if (LOBE_NAME(find_row)(options->model) < 0) {
        memset(model, 0, sizeof *model);
        return;
    }
    const int index = row_above(options->model, choices.plane);
    rows[index].prepare_at(model, in(wi), alpha_x, alpha_y, &choices);
}

static model_type no_model(void) {
    model_type model;
    memset(&model, 0, sizeof model);
    return model;
}

/* Not by reflection_prepare_at: the model would be copied once more, a quarter of the time. */
model_type LOBE_NAME(reflection_prepare_above)(lobe_reflection_options options, vec_type wi,
                                               real alpha_x, real alpha_y,
                                               vec_type geometric_normal) {
    const facet_options choices = choices_of(&options, geometric_normal);
    if (LOBE_NAME(find_row)(options.model) < 0) return no_model();
    const int index = row_above(options.model, choices.plane);
    return rows[index].prepare(in(wi), alpha_x, alpha_y, &choices);
}

model_type LOBE_NAME(reflection_prepare)(lobe_reflection_options options, vec_type wi, real alpha_x,
                                         real alpha_y) {
    vec_type z = {0, 0, 1};
    return LOBE_NAME(reflection_prepare_above)(options, wi, alpha_x, alpha_y, z);
}

draw_type LOBE_NAME(reflection_sample)(const model_type *model, real u1, real u2, real u3) {
    draw_type d;
    memset(&d, 0, sizeof d);
    if (!model->is_valid) return d;
    facet_draw k = rows[model->row].draw(model, k_unit(u1), k_unit(u2), k_unit(u3));
    d.m = out(k.m);
    d.wo = out(k.wo);
    d.cos_im = k.cos_im;
    d.pdf_m = k.pdf_m;
    d.pdf = k.pdf;
    d.weight = k.weight;
    return d;
}

static bool has_density(const model_type *model) {
    return model->is_valid && !model->is_mirror;
}

real LOBE_NAME(reflection_pdf)(const model_type *model, vec_type wo) {
    return has_density(model) ? rows[model->row].pdf(model, in(wo)) : R(0.0);
}

eval_type LOBE_NAME(reflection_eval_wo)(const model_type *model, vec_type wo) {
    eval_type nothing;
    memset(&nothing, 0, sizeof nothing);
    return has_density(model) ? rows[model->row].eval_wo(model, in(wo)) : nothing;
}

eval_type LOBE_NAME(reflection_eval_m)(const model_type *model, vec_type m) {
    eval_type nothing;
    memset(&nothing, 0, sizeof nothing);
    return has_density(model) ? rows[model->row].eval_m(model, in(m)) : nothing;
}

real LOBE_NAME(reflection_acceptance)(const model_type *model) {
    return model->is_valid ? rows[model->row].acceptance(model) : R(0.0);
}

real LOBE_NAME(reflection_vndf_integral)(const model_type *model) {
    return model->is_valid ? rows[model->row].vndf_integral(model) : R(0.0);
}
