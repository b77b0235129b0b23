/* The functions of the library's rough dielectric, once for each precision. Before including:
 *   REAL        float or double
 *   NAME(stem)  stem_f32 or stem_f64 */

#define VECTOR NAME(lobe_vec3)
#define MODEL NAME(lobe_dielectric)
#define DRAW NAME(lobe_dielectric_draw)

static VECTOR NAME(vector)(const double v[3]) {
    VECTOR r = {(REAL)v[0], (REAL)v[1], (REAL)v[2]};
    return r;
}

/* Written by memcpy only, and aligned for every type. */
static const MODEL *NAME(view)(const lobe_verify_state *state) {
    return (const void *)state->bytes;
}

static void NAME(prepare_with)(const lobe_dielectric_parameters *p, const double wi[3],
                               double alpha_x, double alpha_y, double ior,
                               lobe_verify_state *state) {
    MODEL dielectric = NAME(lobe_dielectric_prepare)(p->options, NAME(vector)(wi), (REAL)alpha_x,
                                                     (REAL)alpha_y, (REAL)ior);
    _Static_assert(sizeof dielectric <= sizeof state->bytes, "lobe_verify_state is too small");
    memcpy(state->bytes, &dielectric, sizeof dielectric);
}

static void NAME(prepare)(const void *self, const double wi[3], lobe_verify_state *state) {
    const lobe_dielectric_parameters *p = self;
    NAME(prepare_with)(p, wi, p->alpha_x, p->alpha_y, p->ior, state);
}

static int NAME(prepare_special)(const void *self, const double wi[3], size_t index,
                                 lobe_verify_state *state) {
    if (index >= SPECIALS * SPECIALS * SPECIALS) return 0;
    double alpha_x = SPECIAL[index % SPECIALS];
    double alpha_y = SPECIAL[index / SPECIALS % SPECIALS];
    NAME(prepare_with)(self, wi, alpha_x, alpha_y, SPECIAL[index / SPECIALS / SPECIALS], state);
    return 1;
}

static lobe_verify_draw NAME(sample)(const lobe_verify_state *state, const double u[3]) {
    DRAW s = NAME(lobe_dielectric_sample)(NAME(view)(state), (REAL)u[0], (REAL)u[1], (REAL)u[2]);
    lobe_verify_draw draw = {{s.wo.x, s.wo.y, s.wo.z}, s.pdf, s.weight};
    if (s.is_point) draw.pdf = draw.weight = 0;
    return draw;
}

#include "pages_template.h"

static double NAME(density)(const lobe_verify_state *state, const double wo[3]) {
    return NAME(lobe_dielectric_pdf)(NAME(view)(state), NAME(vector)(wo));
}

static double NAME(value)(const lobe_verify_state *state, const double wo[3]) {
    return NAME(lobe_dielectric_eval_wo)(NAME(view)(state), NAME(vector)(wo)).f_cos;
}

static void NAME(set_functions)(lobe_verify_model *model) {
    model->prepare = NAME(prepare);
    model->prepare_special = NAME(prepare_special);
    model->sample = NAME(sample);
    model->sample_many = NAME(sample_many);
    model->evaluate_many = NAME(evaluate_many);
    model->density = NAME(density);
    model->value = NAME(value);
}

#undef VECTOR
#undef MODEL
#undef DRAW
#undef REAL
#undef NAME
