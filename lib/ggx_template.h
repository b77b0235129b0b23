/* lib/ggx_template.h: the public GGX functions over the kernels, once for each precision.
 *
 * Before including: the binding of the precision, and
 *   LOBE_NAME(stem)   lobe_stem_f32 or lobe_stem_f64
 * The methods come from LOBE_GGX_METHODS; each is a kernel of the same five functions: prepare,
 * draw, pdf, pdf_m, acceptance. */
#include "lobe/ggx.h"

#include "../kernel/ggx_bounded.h"
#include "../kernel/ggx_caps.h"
#include "../kernel/ggx_ellipsoid.h"
#include "../kernel/ggx_ndf.h"
#include "../kernel/ggx_optimal.h"
#include "../kernel/ggx_slope.h"
#include "../kernel/ggx_slope_published.h"

typedef LOBE_NAME(ggx) model_type;
typedef LOBE_NAME(ggx_draw) draw_type;
typedef LOBE_NAME(ggx_eval) eval_type;
typedef LOBE_NAME(vec3) vec_type;

/* The kernel's state lies in the private part of the public value. */
#define CHECK_ROOM(ID, name, text, about)                                                          \
    _Static_assert(sizeof(ggx_##name) <= sizeof(((model_type *)0)->prepared),                      \
                   "lobe_ggx: `prepared` is too small for " text);
LOBE_GGX_METHODS(CHECK_ROOM)
#undef CHECK_ROOM

/* The kernel state of a method, as `s`. */
#define LOAD(name)                                                                                 \
    ggx_##name s;                                                                                  \
    memcpy(&s, model->prepared, sizeof s)

static v3 in(vec_type v) {
    return v3_of(v.x, v.y, v.z);
}

static vec_type out(v3 v) {
    vec_type r = {v.x, v.y, v.z};
    return r;
}

/* Every kernel state begins with the same base. */
static ggx_base base_of(const model_type *model) {
    ggx_base g;
    memcpy(&g, model->prepared, sizeof g);
    return g;
}

static void prepare_method(model_type *model, ggx_base g) {
    switch ((lobe_method)model->method) {
#define CASE(ID, name, text, about)                                                                \
    case LOBE_METHOD_##ID: {                                                                       \
        ggx_##name s = ggx_##name##_prepare(g);                                                    \
        memcpy(model->prepared, &s, sizeof s);                                                     \
        break;                                                                                     \
    }
        LOBE_GGX_METHODS(CASE)
#undef CASE
    case LOBE_METHOD_COUNT:
        break;
    }
}

model_type LOBE_NAME(ggx_prepare)(lobe_ggx_options options, vec_type wi, real alpha_x,
                                  real alpha_y) {
    facet_options choices = facet_options_of(options.g2 == LOBE_G2_SEPARABLE,
                                             options.normalization == LOBE_NORMALIZATION_PREVIOUS);
    ggx_base g = ggx_base_of(in(wi), alpha_x, alpha_y, choices);
    bool known = (unsigned)options.method < LOBE_METHOD_COUNT;
    g.valid = g.valid && known;
    model_type model;
    memset(&model, 0, sizeof model);
    model.method = known ? (int32_t)options.method : (int32_t)LOBE_METHOD_CAPS;
    model.is_valid = g.valid;
    model.is_mirror = g.valid && g.mirror;
    model.alpha_x = g.ax;
    model.alpha_y = g.ay;
    model.wi = out(g.wi);
    prepare_method(&model, g);
    return model;
}

static facet_draw draw_method(const model_type *model, real u1, real u2, real u3) {
    switch ((lobe_method)model->method) {
#define CASE(ID, name, text, about)                                                                \
    case LOBE_METHOD_##ID: {                                                                       \
        LOAD(name);                                                                                \
        return ggx_##name##_draw(s, u1, u2, u3);                                                   \
    }
        LOBE_GGX_METHODS(CASE)
#undef CASE
    case LOBE_METHOD_COUNT:
        break;
    }
    facet_draw none;
    memset(&none, 0, sizeof none);
    return none;
}

static real pdf_method(const model_type *model, facet_pair pair) {
    switch ((lobe_method)model->method) {
#define CASE(ID, name, text, about)                                                                \
    case LOBE_METHOD_##ID: {                                                                       \
        LOAD(name);                                                                                \
        return ggx_##name##_pdf(s, pair);                                                          \
    }
        LOBE_GGX_METHODS(CASE)
#undef CASE
    case LOBE_METHOD_COUNT:
        break;
    }
    return 0;
}

static real pdf_m_method(const model_type *model, facet_pair pair) {
    switch ((lobe_method)model->method) {
#define CASE(ID, name, text, about)                                                                \
    case LOBE_METHOD_##ID: {                                                                       \
        LOAD(name);                                                                                \
        return ggx_##name##_pdf_m(s, pair);                                                        \
    }
        LOBE_GGX_METHODS(CASE)
#undef CASE
    case LOBE_METHOD_COUNT:
        break;
    }
    return 0;
}

real LOBE_NAME(ggx_acceptance)(const model_type *model) {
    if (!model->is_valid) return 0;
    if (model->is_mirror) return model->wi.z > 0 ? R(1.0) : R(0.0);
    switch ((lobe_method)model->method) {
#define CASE(ID, name, text, about)                                                                \
    case LOBE_METHOD_##ID: {                                                                       \
        LOAD(name);                                                                                \
        return ggx_##name##_acceptance(s);                                                         \
    }
        LOBE_GGX_METHODS(CASE)
#undef CASE
    case LOBE_METHOD_COUNT:
        break;
    }
    return 0;
}

/* The mirror: all of the light goes one way. */
static draw_type mirror_draw(const model_type *model) {
    draw_type d;
    memset(&d, 0, sizeof d);
    bool leaves = model->is_valid && model->wi.z > 0;
    d.m.z = 1;
    d.wo.x = -model->wi.x;
    d.wo.y = -model->wi.y;
    d.wo.z = model->wi.z;
    d.cos_im = model->wi.z;
    d.pdf_m = d.pdf = d.weight = leaves ? R(1.0) : R(0.0);
    return d;
}

draw_type LOBE_NAME(ggx_sample)(const model_type *model, real u1, real u2, real u3) {
    if (model->is_mirror) return mirror_draw(model);
    facet_draw k = draw_method(model, k_unit(u1), k_unit(u2), k_unit(u3));
    draw_type d;
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

real LOBE_NAME(ggx_pdf)(const model_type *model, vec_type wo) {
    facet_pair pair = ggx_pair_of_wo(base_of(model), in(wo));
    return has_density(model) && pair.leaves ? k_usable(pdf_method(model, pair)) : R(0.0);
}

static eval_type eval_pair(const model_type *model, facet_pair pair) {
    eval_type e;
    memset(&e, 0, sizeof e);
    if (!has_density(model)) return e;
    ggx_base g = base_of(model);
    facet_eval known = ggx_eval(g, pair);
    e.d = known.d;
    e.g1_i = known.g1_i;
    e.g1_o = known.g1_o;
    e.g2 = known.g2;
    e.f_cos = known.f_cos;
    e.pdf_m = k_usable(e.d > 0 ? pdf_m_method(model, pair) : R(0.0));
    e.pdf = pair.leaves ? k_usable(pdf_method(model, pair)) : R(0.0);
    e.cos_im = pair.cos_im;
    return e;
}

eval_type LOBE_NAME(ggx_eval_wo)(const model_type *model, vec_type wo) {
    return eval_pair(model, ggx_pair_of_wo(base_of(model), in(wo)));
}

eval_type LOBE_NAME(ggx_eval_m)(const model_type *model, vec_type m) {
    return eval_pair(model, ggx_pair_of_m(base_of(model), in(m)));
}
