#include "dielectric.h"

static bool is_dielectric(const lobe_app_model_values *values) {
    return values->bsdf == LOBE_APP_DIELECTRIC;
}

/* What only reflection has. */
static lobe_app_status check_given(const lobe_app_arguments *arguments) {
    static const struct {
        const char *name, *hint;
    } others[] = {
        {"--geometric-normal", "leave it out"},
        {"--floor", "leave it out"},
        {"--normalization", "leave it out"},
    };
    for (size_t k = 0; k < sizeof others / sizeof others[0]; k++)
        if (lobe_app_is_given(arguments, others[k].name))
            return lobe_app_reject(others[k].name, others[k].hint,
                                   "does not go with --bsdf dielectric");
    return LOBE_APP_DONE;
}

lobe_app_status lobe_app_check_bsdf(const lobe_app_model_values *values,
                                    const lobe_app_arguments *arguments) {
    if (!is_dielectric(values)) {
        if (!lobe_app_is_given(arguments, "--transport")) return LOBE_APP_DONE;
        return lobe_app_reject("--transport", "add --bsdf dielectric or leave it out",
                               "reflection is the same for both");
    }
    if (values->ndf != LOBE_NDF_GGX || values->masking != LOBE_MASKING_SMITH)
        return lobe_app_reject("--bsdf", "take --ndf ggx --masking smith",
                               "dielectric does not exist for --ndf %s --masking %s",
                               lobe_ndf_name((lobe_ndf)values->ndf),
                               lobe_masking_name((lobe_masking)values->masking));
    if (values->method != LOBE_METHOD_COUNT && values->method != LOBE_METHOD_CAPS)
        return lobe_app_reject("--method", "leave it out or take caps",
                               "%s does not exist for --bsdf dielectric",
                               lobe_method_name((lobe_method)values->method));
    return check_given(arguments);
}

static lobe_app_status reject_fresnel(void) {
    return lobe_app_reject("--fresnel",
                           "give the index of the inside over the outside, as in dielectric:1.5",
                           "--bsdf dielectric needs dielectric:IOR");
}

lobe_app_status lobe_app_prepare_dielectric(const lobe_app_model_values *values,
                                            lobe_app_model *model) {
    if (values->fresnel.kind != LOBE_APP_FRESNEL_DIELECTRIC) return reject_fresnel();
    lobe_dielectric_options options = lobe_dielectric_default_options();
    options.g2 = (lobe_g2)values->g2;
    options.transport = (lobe_transport)values->transport;
    const double ax = values->alpha[0], ay = values->alpha[1], ior = values->fresnel.parameter[0];
    const lobe_vec3_f64 wi = values->wi;
    const lobe_vec3_f32 narrow = {(float)wi.x, (float)wi.y, (float)wi.z};
    model->dielectric_f32 =
        lobe_dielectric_prepare_f32(options, narrow, (float)ax, (float)ay, (float)ior);
    model->dielectric_f64 = lobe_dielectric_prepare_f64(options, wi, ax, ay, ior);
    const bool is_valid = model->precision == LOBE_APP_F32 ? model->dielectric_f32.is_valid
                                                           : model->dielectric_f64.is_valid;
    if (is_valid) return LOBE_APP_DONE;
    return lobe_app_reject("--alpha", "give a smaller roughness",
                           "%g,%g is too large for the precision", ax, ay);
}

lobe_reflection_draw_f64 lobe_app_draw_dielectric(const lobe_app_model *model, const double u[3]) {
    if (model->precision == LOBE_APP_F64) {
        const lobe_dielectric_draw_f64 d =
            lobe_dielectric_sample_f64(&model->dielectric_f64, u[0], u[1], u[2]);
        return (lobe_reflection_draw_f64){d.m, d.wo, d.cos_im, d.pdf_m, d.pdf, d.weight};
    }
    const lobe_dielectric_draw_f32 d =
        lobe_dielectric_sample_f32(&model->dielectric_f32, (float)u[0], (float)u[1], (float)u[2]);
    return (lobe_reflection_draw_f64){
        {d.m.x, d.m.y, d.m.z}, {d.wo.x, d.wo.y, d.wo.z}, d.cos_im, d.pdf_m, d.pdf, d.weight};
}

lobe_reflection_eval_f64 lobe_app_eval_dielectric(const lobe_app_model *model, lobe_vec3_f64 wo) {
    if (model->precision == LOBE_APP_F64) {
        const lobe_dielectric_eval_f64 e = lobe_dielectric_eval_wo_f64(&model->dielectric_f64, wo);
        return (lobe_reflection_eval_f64){e.d,     e.g1_i, e.g1_o,  e.g2,
                                          e.pdf_m, e.pdf,  e.f_cos, e.cos_im};
    }
    const lobe_vec3_f32 narrow = {(float)wo.x, (float)wo.y, (float)wo.z};
    const lobe_dielectric_eval_f32 e = lobe_dielectric_eval_wo_f32(&model->dielectric_f32, narrow);
    return (lobe_reflection_eval_f64){e.d, e.g1_i, e.g1_o, e.g2, e.pdf_m, e.pdf, e.f_cos, e.cos_im};
}
