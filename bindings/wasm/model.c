/* What can be sampled, and the two models that are. */
#include "page.h"

#include <stddef.h>
#include <string.h>

scene page_scene[METHODS];
lobe_reflection_f32 page_model[METHODS];

/* ---- Names: addresses of text that ends with 0 */

EXPORT(method_count) int page_method_count(void);
int page_method_count(void) {
    return LOBE_METHOD_COUNT;
}

EXPORT(method_name) const char *page_method_name(int method);
const char *page_method_name(int method) {
    return lobe_method_name((lobe_method)method);
}

EXPORT(method_about) const char *page_method_about(int method);
const char *page_method_about(int method) {
    return lobe_method_about((lobe_method)method);
}

EXPORT(ndf_name) const char *page_ndf_name(int ndf);
const char *page_ndf_name(int ndf) {
    return lobe_ndf_name((lobe_ndf)ndf);
}

EXPORT(masking_name) const char *page_masking_name(int masking);
const char *page_masking_name(int masking) {
    return lobe_masking_name((lobe_masking)masking);
}

static lobe_model model_of(int ndf, int masking, int method) {
    return (lobe_model){(lobe_ndf)ndf, (lobe_masking)masking, (lobe_method)method};
}

/* The stem of the kernel file, "ggx_bounded"; NULL where the combination does not exist. */
EXPORT(kernel_name) const char *page_kernel_name(int ndf, int masking, int method);
const char *page_kernel_name(int ndf, int masking, int method) {
#define KERNEL_NAME(NDF, MASKING, METHOD, kernel)                                                  \
    if (ndf == LOBE_NDF_##NDF && masking == LOBE_MASKING_##MASKING &&                              \
        method == LOBE_METHOD_##METHOD)                                                            \
        return #kernel;
    LOBE_MODELS(KERNEL_NAME)
#undef KERNEL_NAME
    return NULL;
}

EXPORT(version) const char *page_version(void);
const char *page_version(void) {
    return LOBE_VERSION_STRING;
}

EXPORT(best_method) int page_best_method(int ndf, int masking);
int page_best_method(int ndf, int masking) {
    return (int)lobe_best_method((lobe_ndf)ndf, (lobe_masking)masking);
}

/* ---- The two models */

enum { MODEL_VALID = 1, MODEL_MIRROR = 2 };

/* Which of the two is what. The plane is the geometric normal. Returns bits: 1 valid, 2 mirror. */
EXPORT(prepare)
int page_prepare(int which, int ndf, int masking, int method, float alpha_x, float alpha_y,
                 float wi_x, float wi_y, float wi_z, float plane_x, float plane_y, float plane_z);
int page_prepare(int which, int ndf, int masking, int method, float alpha_x, float alpha_y,
                 float wi_x, float wi_y, float wi_z, float plane_x, float plane_y, float plane_z) {
    scene *s = &page_scene[which];
    s->options = lobe_reflection_default_options();
    s->options.model = model_of(ndf, masking, method);
    s->wi = (lobe_vec3_f32){wi_x, wi_y, wi_z};
    s->plane = (lobe_vec3_f32){plane_x, plane_y, plane_z};
    s->alpha[0] = alpha_x;
    s->alpha[1] = alpha_y;
    lobe_reflection_f32 *model = &page_model[which];
    *model = lobe_reflection_prepare_above_f32(s->options, s->wi, alpha_x, alpha_y, s->plane);
    return (model->is_valid ? MODEL_VALID : 0) | (model->is_mirror ? MODEL_MIRROR : 0);
}

/* The accepted share in closed form; negative where none is known. */
EXPORT(acceptance) double page_acceptance(int which);
double page_acceptance(int which) {
    return (double)lobe_reflection_acceptance_f32(&page_model[which]);
}
