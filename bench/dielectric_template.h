/* bench/dielectric_template.h: the loops over rough dielectrics, once for each precision: glass, both of its sides as
 * the inputs have them. Before including:
 *   REAL        float or double
 *   NAME(stem)  stem_f32 or stem_f64 */

#define INPUTS_TYPE NAME(inputs)
#define MODEL NAME(lobe_dielectric)

static MODEL NAME(prepare_glass)(const INPUTS_TYPE *in, int i) {
    NAME(lobe_vec3) wi = {in->wi[0][i], in->wi[1][i], in->wi[2][i]};
    return NAME(lobe_dielectric_prepare)(lobe_dielectric_default_options(), wi, in->alpha[0][i],
                                         in->alpha[1][i], (REAL)GLASS);
}

static double NAME(one_glass_draw)(const MODEL *model, const INPUTS_TYPE *in, int i) {
    NAME(lobe_dielectric_draw)
    d = NAME(lobe_dielectric_sample)(model, in->u[0][i], in->u[1][i], in->u[2][i]);
    return d.wo.x + d.pdf + d.weight;
}

static double NAME(one_glass_pdf)(const MODEL *model, const INPUTS_TYPE *in, int i) {
    NAME(lobe_vec3) wo = {in->wo[0][i], in->wo[1][i], in->wo[2][i]};
    return NAME(lobe_dielectric_pdf)(model, wo);
}

static double NAME(glass_calls)(const work *w, const INPUTS_TYPE *in,
                                double (*one)(const MODEL *, const INPUTS_TYPE *, int)) {
    double sum = 0;
    const MODEL shared = NAME(prepare_glass)(in, 0);
    for (int i = 0; i < INPUTS; ++i) {
        if (w->is_shared) {
            sum += one(&shared, in, i);
        } else {
            const MODEL model = NAME(prepare_glass)(in, i);
            sum += one(&model, in, i);
        }
    }
    return sum;
}

static double NAME(glass_batch_draw)(const work *w, INPUTS_TYPE *in) {
    const MODEL model = NAME(prepare_glass)(in, 0);
    const REAL ior = (REAL)GLASS;
    NAME(lobe_dielectric_sample_batch)
    b = {.count = INPUTS, .options = lobe_dielectric_default_options(), .ior = {&ior, 0}};
    if (w->is_shared) b.prepared = &model;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (NAME(lobe_in)){in->wi[k], 1};
        b.u[k] = (NAME(lobe_in)){in->u[k], 1};
        b.wo[k] = (NAME(lobe_out)){in->out_wo[k], 1};
    }
    for (int k = 0; k < 2; ++k) b.alpha[k] = (NAME(lobe_in)){in->alpha[k], 1};
    b.pdf = (NAME(lobe_out)){in->out_pdf, 1};
    b.weight = (NAME(lobe_out)){in->out_weight, 1};
    NAME(lobe_dielectric_sample_many)(&b);
    return in->out_pdf[INPUTS / 2];
}

static double NAME(glass_batch_pdf)(const work *w, INPUTS_TYPE *in) {
    const MODEL model = NAME(prepare_glass)(in, 0);
    const REAL ior = (REAL)GLASS;
    NAME(lobe_dielectric_eval_batch)
    b = {.count = INPUTS, .options = lobe_dielectric_default_options(), .ior = {&ior, 0}};
    if (w->is_shared) b.prepared = &model;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (NAME(lobe_in)){in->wi[k], 1};
        b.wo[k] = (NAME(lobe_in)){in->wo[k], 1};
    }
    for (int k = 0; k < 2; ++k) b.alpha[k] = (NAME(lobe_in)){in->alpha[k], 1};
    b.pdf = (NAME(lobe_out)){in->out_pdf, 1};
    NAME(lobe_dielectric_eval_many)(&b);
    return in->out_pdf[INPUTS / 2];
}

static double NAME(glass_draw)(const work *w, INPUTS_TYPE *in) {
    return w->isa ? NAME(glass_batch_draw)(w, in) : NAME(glass_calls)(w, in, NAME(one_glass_draw));
}

static double NAME(glass_pdf)(const work *w, INPUTS_TYPE *in) {
    return w->isa ? NAME(glass_batch_pdf)(w, in) : NAME(glass_calls)(w, in, NAME(one_glass_pdf));
}

#undef INPUTS_TYPE
#undef MODEL
#undef REAL
#undef NAME
