/* bench/work_template.h: the loops over the library, once for each precision. Before including:
 *   REAL        float or double
 *   NAME(stem)  stem_f32 or stem_f64 */

static NAME(lobe_reflection) NAME(prepare)(const work *w, const inputs *in, int i) {
    NAME(lobe_vec3) wi = {(REAL)in->wi[i].x, (REAL)in->wi[i].y, (REAL)in->wi[i].z};
    return NAME(lobe_reflection_prepare)(w->options, wi, (REAL)in->alpha_x[i],
                                         (REAL)in->alpha_y[i]);
}

static double NAME(one_draw)(const NAME(lobe_reflection) * model, const inputs *in, int i) {
    NAME(lobe_reflection_draw)
    d = NAME(lobe_reflection_sample)(model, (REAL)in->u1[i], (REAL)in->u2[i], (REAL)in->u3[i]);
    return d.wo.x + d.pdf + d.weight;
}

static double NAME(one_pdf)(const NAME(lobe_reflection) * model, const inputs *in, int i) {
    NAME(lobe_vec3) wo = {(REAL)in->wo[i].x, (REAL)in->wo[i].y, (REAL)in->wo[i].z};
    return NAME(lobe_reflection_pdf)(model, wo);
}

static double NAME(draw)(const work *w, const inputs *in) {
    double sum = 0;
    if (w->is_shared) {
        const NAME(lobe_reflection) model = NAME(prepare)(w, in, 0);
        for (int i = 0; i < INPUTS; ++i) sum += NAME(one_draw)(&model, in, i);
        return sum;
    }
    for (int i = 0; i < INPUTS; ++i) {
        const NAME(lobe_reflection) model = NAME(prepare)(w, in, i);
        sum += NAME(one_draw)(&model, in, i);
    }
    return sum;
}

static double NAME(pdf)(const work *w, const inputs *in) {
    double sum = 0;
    if (w->is_shared) {
        const NAME(lobe_reflection) model = NAME(prepare)(w, in, 0);
        for (int i = 0; i < INPUTS; ++i) sum += NAME(one_pdf)(&model, in, i);
        return sum;
    }
    for (int i = 0; i < INPUTS; ++i) {
        const NAME(lobe_reflection) model = NAME(prepare)(w, in, i);
        sum += NAME(one_pdf)(&model, in, i);
    }
    return sum;
}

#undef REAL
#undef NAME
