/* bench/work_template.h: the loops over one kind of model in one precision. Before including:
 *   REAL, NAME(stem)          float or double; stem_f32 or stem_f64
 *   KIND(stem)                the name of a function here; KIND(prepare) exists
 *   LIBRARY(does)             lobe_reflection##does or lobe_dielectric##does of the precision
 *   SAMPLE_BATCH, EVAL_BATCH  its batches, and SAMPLE_ROWS, EVAL_ROWS, which work on them
 *   REST(w)                   what a batch takes beside rows, as designated initialisers */

static double KIND(one_draw)(const MODEL *model, const NAME(inputs) * in, int i) {
    LIBRARY(_draw) d = LIBRARY(_sample)(model, in->u[0][i], in->u[1][i], in->u[2][i]);
    return d.wo.x + d.pdf + d.weight;
}

static double KIND(one_pdf)(const MODEL *model, const NAME(inputs) * in, int i) {
    NAME(lobe_vec3) wo = {in->wo[0][i], in->wo[1][i], in->wo[2][i]};
    return LIBRARY(_pdf)(model, wo);
}

static double KIND(calls)(const work *w, const NAME(inputs) * in,
                          double (*one)(const MODEL *, const NAME(inputs) *, int)) {
    double sum = 0;
    if (w->is_shared) {
        const MODEL model = KIND(prepare)(w, in, 0);
        for (int i = 0; i < INPUTS; ++i) sum += one(&model, in, i);
        return sum;
    }
    for (int i = 0; i < INPUTS; ++i) {
        const MODEL model = KIND(prepare)(w, in, i);
        sum += one(&model, in, i);
    }
    return sum;
}

/* A batch of draws that writes nothing yet. */
static SAMPLE_BATCH KIND(draws)(const work *w, const NAME(inputs) * in, const MODEL *model) {
    SAMPLE_BATCH b = {.count = INPUTS, REST(w)};
    if (w->is_shared) b.prepared = model;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (NAME(lobe_in)){in->wi[k], 1};
        b.u[k] = (NAME(lobe_in)){in->u[k], 1};
    }
    for (int k = 0; k < 2; ++k) b.alpha[k] = (NAME(lobe_in)){in->alpha[k], 1};
    return b;
}

static double KIND(batch_draw)(const work *w, NAME(inputs) * in) {
    const MODEL model = KIND(prepare)(w, in, 0);
    SAMPLE_BATCH b = KIND(draws)(w, in, &model);
    for (int k = 0; k < 3; ++k) b.wo[k] = (NAME(lobe_out)){in->out_wo[k], 1};
    b.pdf = (NAME(lobe_out)){in->out_pdf, 1};
    b.weight = (NAME(lobe_out)){in->out_weight, 1};
    SAMPLE_ROWS(&b);
    return in->out_pdf[INPUTS / 2];
}

static double KIND(batch_normal)(const work *w, NAME(inputs) * in) {
    const MODEL model = KIND(prepare)(w, in, 0);
    SAMPLE_BATCH b = KIND(draws)(w, in, &model);
    for (int k = 0; k < 3; ++k) b.m[k] = (NAME(lobe_out)){in->out_wo[k], 1};
    b.pdf_m = (NAME(lobe_out)){in->out_pdf, 1};
    SAMPLE_ROWS(&b);
    return in->out_pdf[INPUTS / 2];
}

static double KIND(batch_pdf)(const work *w, NAME(inputs) * in) {
    const MODEL model = KIND(prepare)(w, in, 0);
    EVAL_BATCH b = {.count = INPUTS, REST(w)};
    if (w->is_shared) b.prepared = &model;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (NAME(lobe_in)){in->wi[k], 1};
        b.wo[k] = (NAME(lobe_in)){in->wo[k], 1};
    }
    for (int k = 0; k < 2; ++k) b.alpha[k] = (NAME(lobe_in)){in->alpha[k], 1};
    b.pdf = (NAME(lobe_out)){in->out_pdf, 1};
    EVAL_ROWS(&b);
    return in->out_pdf[INPUTS / 2];
}

static double KIND(draw)(const work *w, NAME(inputs) * in) {
    return w->isa ? KIND(batch_draw)(w, in) : KIND(calls)(w, in, KIND(one_draw));
}

static double KIND(pdf)(const work *w, NAME(inputs) * in) {
    return w->isa ? KIND(batch_pdf)(w, in) : KIND(calls)(w, in, KIND(one_pdf));
}

#undef KIND
#undef LIBRARY
#undef MODEL
#undef SAMPLE_BATCH
#undef EVAL_BATCH
#undef SAMPLE_ROWS
#undef EVAL_ROWS
#undef REST
