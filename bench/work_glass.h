/* bench/work_glass.h: loops over rough glass of index 1.5, both of its sides as the inputs have them, in the
 * precision of REAL and NAME. */
#define KIND(stem) NAME(glass_##stem)
#define LIBRARY(does) NAME(lobe_dielectric##does)
#define MODEL NAME(lobe_dielectric)
#define SAMPLE_BATCH NAME(lobe_dielectric_sample_batch)
#define EVAL_BATCH NAME(lobe_dielectric_eval_batch)
#define SAMPLE_ROWS NAME(lobe_dielectric_sample_many)
#define EVAL_ROWS NAME(lobe_dielectric_eval_many)
#define REST(w) .options = lobe_dielectric_default_options(), .ior = {&NAME(glass_ior), 0}

static const REAL NAME(glass_ior) = (REAL)1.5;

static MODEL KIND(prepare)(const work *w, const NAME(inputs) * in, int i) {
    (void)w;
    NAME(lobe_vec3) wi = {in->wi[0][i], in->wi[1][i], in->wi[2][i]};
    return NAME(lobe_dielectric_prepare)(lobe_dielectric_default_options(), wi, in->alpha[0][i],
                                         in->alpha[1][i], NAME(glass_ior));
}

#include "work_template.h"
