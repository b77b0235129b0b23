/* The three functions of the library's GGX, once for each precision. Before including:
 *   REAL        float or double
 *   NAME(stem)  stem_f32 or stem_f64 */

#define VECTOR NAME(lobe_vec3)
#define MODEL NAME(lobe_reflection)
#define DRAW NAME(lobe_reflection_draw)

static VECTOR NAME(vector)(const double v[3]) {
    VECTOR r = {(REAL)v[0], (REAL)v[1], (REAL)v[2]};
    return r;
}

/* A copy would cost as much as a draw. The bytes are written by memcpy only, so no compiler may take
 * this for another object; the state is aligned for every type. */
static const MODEL *NAME(view)(const lobe_verify_state *state) {
    return (const void *)state->bytes;
}

static void NAME(prepare_with)(const lobe_reflection_parameters *p, const double wi[3],
                               double alpha_x, double alpha_y, lobe_verify_state *state) {
    double plane[3];
    direction_at(p->tilt, p->tilt_azimuth, plane);
    MODEL ggx = NAME(lobe_reflection_prepare_above)(p->options, NAME(vector)(wi), (REAL)alpha_x,
                                                    (REAL)alpha_y, NAME(vector)(plane));
    _Static_assert(sizeof ggx <= sizeof state->bytes, "lobe_verify_state is too small");
    memcpy(state->bytes, &ggx, sizeof ggx);
}

static void NAME(prepare)(const void *self, const double wi[3], lobe_verify_state *state) {
    const lobe_reflection_parameters *p = self;
    NAME(prepare_with)(p, wi, p->alpha_x, p->alpha_y, state);
}

static int NAME(prepare_special)(const void *self, const double wi[3], size_t index,
                                 lobe_verify_state *state) {
    if (index >= SPECIAL_ALPHAS * SPECIAL_ALPHAS) return 0;
    const double alpha_x = SPECIAL_ALPHA[index % SPECIAL_ALPHAS];
    NAME(prepare_with)(self, wi, alpha_x, SPECIAL_ALPHA[index / SPECIAL_ALPHAS], state);
    return 1;
}

static lobe_verify_draw NAME(sample)(const lobe_verify_state *state, const double u[3]) {
    DRAW s = NAME(lobe_reflection_sample)(NAME(view)(state), (REAL)u[0], (REAL)u[1], (REAL)u[2]);
    return (lobe_verify_draw){{s.wo.x, s.wo.y, s.wo.z}, s.pdf, s.weight};
}

#include "pages_template.h"

static double NAME(density)(const lobe_verify_state *state, const double wo[3]) {
    return NAME(lobe_reflection_pdf)(NAME(view)(state), NAME(vector)(wo));
}

static double NAME(value)(const lobe_verify_state *state, const double wo[3]) {
    return NAME(lobe_reflection_eval_wo)(NAME(view)(state), NAME(vector)(wo)).f_cos;
}

static double NAME(acceptance)(const lobe_verify_state *state) {
    return NAME(lobe_reflection_acceptance)(NAME(view)(state));
}

static void NAME(set_functions)(lobe_verify_model *model) {
    model->prepare = NAME(prepare);
    model->prepare_special = NAME(prepare_special);
    model->sample = NAME(sample);
    model->sample_many = NAME(sample_many);
    model->evaluate_many = NAME(evaluate_many);
    model->density = NAME(density);
    model->value = NAME(value);
    lobe_verify_state state;
    NAME(prepare)(model->self, model->wi, &state);
    double share = NAME(acceptance)(&state);
    model->accepted = share >= 0 ? share : NAN;
}

#undef VECTOR
#undef MODEL
#undef DRAW
#undef REAL
#undef NAME
