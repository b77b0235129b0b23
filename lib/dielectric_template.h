/* lib/dielectric_template.h: the public functions of rough dielectrics over the kernels, once for each
 * precision. Before including: the binding of the precision, and
 *   LOBE_NAME(stem)   lobe_stem_f32 or lobe_stem_f64 */
#include "lobe/dielectric.h"

#include "../kernel/ggx_dielectric.h"
#include "dielectric_energy.h"
#include "dielectric_turned.h"

typedef LOBE_NAME(dielectric) model_type;
typedef LOBE_NAME(dielectric_draw) draw_type;
typedef LOBE_NAME(dielectric_eval) eval_type;
typedef LOBE_NAME(vec3) vec_type;

_Static_assert(sizeof(ggx_dielectric) <= sizeof(((model_type *)0)->prepared),
               "lobe_dielectric: `prepared` is too small");

static v3 in(vec_type v) {
    return v3_of(v.x, v.y, v.z);
}

static vec_type out(v3 v) {
    vec_type r = {v.x, v.y, v.z};
    return r;
}

static ggx_dielectric state_of(const model_type *model) {
    ggx_dielectric s;
    memcpy(&s, model->prepared, sizeof s);
    return s;
}

/* What a direction scatters once of even light. */
static real energy_once(ggx_dielectric s) {
    ggx_base g = s.caps.cap.g;
    float cosine = (float)g.wi.z, eta = (float)s.side.n.eta;
    int separable = k_is(g.separable);
    if (g.ax == g.ay) return (real)lobe_dielectric_energy(cosine, (float)g.ax, eta, separable);
    real plane = g.wi.x * g.wi.x + g.wi.y * g.wi.y;
    real along_x = k_select(plane > K_TINY, g.wi.x * g.wi.x / k_max(plane, K_TINY), R(0.5));
    real share = k_select(g.ax > g.ay, along_x, R(1.0) - along_x);
    real wide = k_max(g.ax, g.ay), narrow = k_min(g.ax, g.ay);
    real single = lobe_turned_single(wide, narrow, share, plane);
    return (real)(lobe_dielectric_energy(cosine, (float)single, eta, separable) *
                  lobe_dielectric_turned(cosine, (float)wide, (float)narrow, (float)share, eta,
                                         separable));
}

/* What makes up for the light that single scattering loses; thin walls and point masses lose none.
 * Next to the horizon, for an index next to 1, all of it is lost: there is a limit. */
static real energy_factor(ggx_dielectric s) {
    if (!k_is(s.side.valid) || k_is(s.side.straight) || k_is(s.side.mirror)) return 1;
    return R(1.0) / k_max(energy_once(s), R(1e-5));
}

model_type LOBE_NAME(dielectric_prepare)(lobe_dielectric_options options, vec_type wi, real alpha_x,
                                         real alpha_y, real ior) {
    dielectric_options choices;
    choices.separable = k_flag(options.g2 == LOBE_G2_SEPARABLE);
    choices.importance = k_flag(options.transport == LOBE_TRANSPORT_IMPORTANCE);
    choices.thin = k_flag(options.thin != 0);
    choices.compensate = k_flag(options.compensate != 0);
    ggx_dielectric s = ggx_dielectric_prepare(in(wi), alpha_x, alpha_y, ior, choices);
    if (options.compensate) s.side.boost = energy_factor(s);
    model_type model;
    memset(&model, 0, sizeof model);
    model.is_valid = k_is(s.side.valid);
    model.is_smooth = k_is(s.side.valid) && k_is(s.side.mirror);
    model.is_matched = k_is(s.side.valid) && k_is(s.side.matched);
    model.is_thin = k_is(s.side.thin);
    model.alpha_x = s.caps.cap.g.ax;
    model.alpha_y = s.caps.cap.g.ay;
    model.eta = s.side.n.eta;
    model.energy_factor = s.side.boost;
    memcpy(model.prepared, &s, sizeof s);
    return model;
}

draw_type LOBE_NAME(dielectric_sample)(const model_type *model, real u1, real u2, real u3) {
    dielectric_draw k = ggx_dielectric_draw(state_of(model), k_unit(u1), k_unit(u2), k_unit(u3));
    draw_type d;
    d.m = out(k.m);
    d.wo = out(k.wo);
    d.cos_im = k.cos_im;
    d.fresnel = k.fresnel;
    d.pdf_m = k.pdf_m;
    d.pdf = k.pdf;
    d.weight = k.weight;
    d.transmitted = k.transmitted;
    d.is_point = k.is_point;
    return d;
}

real LOBE_NAME(dielectric_pdf)(const model_type *model, vec_type wo) {
    return ggx_dielectric_pdf(state_of(model), in(wo));
}

eval_type LOBE_NAME(dielectric_eval_wo)(const model_type *model, vec_type wo) {
    ggx_dielectric_value k = ggx_dielectric_eval(state_of(model), in(wo));
    eval_type e;
    e.d = k.d;
    e.g1_i = k.g1_i;
    e.g1_o = k.g1_o;
    e.g2 = k.g2;
    e.pdf_m = k.value.pdf_m;
    e.pdf = k.value.pdf;
    e.f_cos = k.value.f_cos;
    e.fresnel = k.value.fresnel;
    e.cos_im = k.value.cos_im;
    e.transmitted = k.value.transmitted;
    return e;
}
