/* bench/work_reflection.h: loops over the reflection models, in the precision of REAL and NAME. */
#define KIND(stem) NAME(stem)
#define LIBRARY(does) NAME(lobe_reflection##does)
#define MODEL NAME(lobe_reflection)
#define SAMPLE_BATCH NAME(lobe_sample_batch)
#define EVAL_BATCH NAME(lobe_eval_batch)
#define SAMPLE_ROWS NAME(lobe_reflection_sample_batch)
#define EVAL_ROWS NAME(lobe_reflection_eval_batch)
#define REST(w) .options = (w)->options

static MODEL KIND(prepare)(const work *w, const NAME(inputs) * in, int i) {
    NAME(lobe_vec3) wi = {in->wi[0][i], in->wi[1][i], in->wi[2][i]};
    NAME(lobe_vec3) plane = {(REAL)w->plane.x, (REAL)w->plane.y, (REAL)w->plane.z};
    return NAME(lobe_reflection_prepare_above)(w->options, wi, in->alpha[0][i], in->alpha[1][i],
                                               plane);
}

#include "work_template.h"
