/* bench/work_template.h: the loops over the library, once for each precision. Before including:
 *   REAL        float or double
 *   NAME(stem)  stem_f32 or stem_f64 */

#define INPUTS_TYPE NAME(inputs)
#define MODEL NAME(lobe_reflection)

static MODEL NAME(prepare)(const work *w, const INPUTS_TYPE *in, int i) {
    NAME(lobe_vec3) wi = {in->wi[0][i], in->wi[1][i], in->wi[2][i]};
    NAME(lobe_vec3) plane = {(REAL)w->plane.x, (REAL)w->plane.y, (REAL)w->plane.z};
    return NAME(lobe_reflection_prepare_above)(w->options, wi, in->alpha[0][i], in->alpha[1][i],
                                               plane);
}

static double NAME(one_draw)(const MODEL *model, const INPUTS_TYPE *in, int i) {
    NAME(lobe_reflection_draw)
    d = NAME(lobe_reflection_sample)(model, in->u[0][i], in->u[1][i], in->u[2][i]);
    return d.wo.x + d.pdf + d.weight;
}

static double NAME(one_pdf)(const MODEL *model, const INPUTS_TYPE *in, int i) {
    NAME(lobe_vec3) wo = {in->wo[0][i], in->wo[1][i], in->wo[2][i]};
    return NAME(lobe_reflection_pdf)(model, wo);
}

static double NAME(calls)(const work *w, const INPUTS_TYPE *in,
                          double (*one)(const MODEL *, const INPUTS_TYPE *, int)) {
    double sum = 0;
    if (w->is_shared) {
        const MODEL model = NAME(prepare)(w, in, 0);
        for (int i = 0; i < INPUTS; ++i) sum += one(&model, in, i);
        return sum;
    }
    for (int i = 0; i < INPUTS; ++i) {
        const MODEL model = NAME(prepare)(w, in, i);
        sum += one(&model, in, i);
    }
    return sum;
}

static double NAME(batch_draw)(const work *w, INPUTS_TYPE *in) {
    const MODEL model = NAME(prepare)(w, in, 0);
    NAME(lobe_sample_batch) b = {.count = INPUTS, .options = w->options};
    if (w->is_shared) b.prepared = &model;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (NAME(lobe_in)){in->wi[k], 1};
        b.u[k] = (NAME(lobe_in)){in->u[k], 1};
        b.wo[k] = (NAME(lobe_out)){in->out_wo[k], 1};
    }
    for (int k = 0; k < 2; ++k) b.alpha[k] = (NAME(lobe_in)){in->alpha[k], 1};
    b.pdf = (NAME(lobe_out)){in->out_pdf, 1};
    b.weight = (NAME(lobe_out)){in->out_weight, 1};
    NAME(lobe_reflection_sample_batch)(&b);
    return in->out_pdf[INPUTS / 2];
}

static double NAME(batch_pdf)(const work *w, INPUTS_TYPE *in) {
    const MODEL model = NAME(prepare)(w, in, 0);
    NAME(lobe_eval_batch) b = {.count = INPUTS, .options = w->options};
    if (w->is_shared) b.prepared = &model;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (NAME(lobe_in)){in->wi[k], 1};
        b.wo[k] = (NAME(lobe_in)){in->wo[k], 1};
    }
    for (int k = 0; k < 2; ++k) b.alpha[k] = (NAME(lobe_in)){in->alpha[k], 1};
    b.pdf = (NAME(lobe_out)){in->out_pdf, 1};
    NAME(lobe_reflection_eval_batch)(&b);
    return in->out_pdf[INPUTS / 2];
}

static double NAME(draw)(const work *w, INPUTS_TYPE *in) {
    return w->isa ? NAME(batch_draw)(w, in) : NAME(calls)(w, in, NAME(one_draw));
}

static double NAME(pdf)(const work *w, INPUTS_TYPE *in) {
    return w->isa ? NAME(batch_pdf)(w, in) : NAME(calls)(w, in, NAME(one_pdf));
}

#undef INPUTS_TYPE
#undef MODEL
#undef REAL
#undef NAME
