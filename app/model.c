#include "model.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#include <lobe/batch.h>

#include "dielectric.h"
#include "number.h"

/* ---- Options --------------------------------------------------------------------------------- */

static const char *const precisions[] = {"f32", "f64", NULL};
static const char *const bsdfs[] = {"reflection", "dielectric", NULL};
static const char *const transports[] = {"radiance", "importance", NULL};

#define NAME(ID, name) name,
#define METHOD_NAME(ID, name, about) name,
const char *const lobe_app_ndfs[] = {LOBE_NDFS(NAME) NULL};
const char *const lobe_app_maskings[] = {LOBE_MASKINGS(NAME) NULL};
const char *const lobe_app_methods[] = {LOBE_METHODS(METHOD_NAME) NULL};
#undef NAME
#undef METHOD_NAME
const char *const lobe_app_g2s[] = {"correlated", "separable", NULL};
const char *const lobe_app_normalizations[] = {"unbiased", "previous", NULL};

static bool read_alpha(const lobe_app_option *option, const char *text, void *value) {
    double *alpha = value;
    const int count = lobe_app_read_numbers(text, 1, 2, alpha);
    if (count == 1) alpha[1] = alpha[0];
    if (count && alpha[0] >= 0 && alpha[1] >= 0) return true;
    lobe_app_report(option->name, "give A or AX,AY, finite numbers from 0 on",
                    "'%.60s' is no roughness", text);
    return false;
}

bool lobe_app_read_floor(const lobe_app_option *option, const char *text, void *value) {
    double floor;
    if (lobe_app_read_numbers(text, 1, 1, &floor) && floor >= 0 && floor <= 1) {
        *(double *)value = floor;
        return true;
    }
    lobe_app_report(option->name, "give a number in [0, 1]", "'%.60s' is no share", text);
    return false;
}

bool lobe_app_read_direction(const lobe_app_option *option, const char *text, void *value) {
    double v[3];
    if (lobe_app_read_numbers(text, 3, 3, v)) {
        lobe_vec3_f64 direction = {v[0], v[1], v[2]};
        if (lobe_app_normalize(LOBE_APP_F64, &direction)) {
            *(lobe_vec3_f64 *)value = direction;
            return true;
        }
    }
    lobe_app_report(option->name, "give X,Y,Z, finite numbers that are not all zero",
                    "'%.60s' is no direction", text);
    return false;
}

#define MEMBER(name) offsetof(lobe_app_model_values, name)
const lobe_app_option lobe_app_model_options[] = {
    {"--ndf", "NAME", "ggx", "distribution of normals", lobe_app_read_choice, MEMBER(ndf),
     lobe_app_ndfs},
    {"--masking", "NAME", "smith", "masking of the microsurface", lobe_app_read_choice,
     MEMBER(masking), lobe_app_maskings},
    {"--method", "NAME", "the best for the model", "how directions are drawn", lobe_app_read_choice,
     MEMBER(method), lobe_app_methods},
    {"--alpha", "A[,AY]", NULL,
     "roughness of the distribution, along x and along y; from 0 "
     "(a mirror) on; required",
     read_alpha, MEMBER(alpha), NULL},
    {"--wi", "X,Y,Z", NULL,
     "direction toward the viewer in the shading frame, of any length; may "
     "lie below the surface; required",
     lobe_app_read_direction, MEMBER(wi), NULL},
    {"--floor", "D", "0.25", "method horizon: how much of the density ignores shadowing, in [0, 1]",
     lobe_app_read_floor, MEMBER(floor), NULL},
    {"--geometric-normal", "X,Y,Z", "none",
     "normal of the geometric surface in the shading frame, of any length; directions below it are "
     "invalid too",
     lobe_app_read_direction, MEMBER(plane), NULL},
    {"--precision", "P", "f32", "of the arithmetic", lobe_app_read_choice, MEMBER(precision),
     precisions},
    {"--g2", "NAME", "correlated", "masking of both directions together", lobe_app_read_choice,
     MEMBER(g2), lobe_app_g2s},
    {"--fresnel", "F", "none",
     "reflectance of a microfacet: none (F = 1), F0 (Schlick), "
     "f82:F0,TINT, dielectric:IOR, conductor:N,K; multiplies weight and f_cos",
     lobe_app_read_fresnel, MEMBER(fresnel), NULL},
    {"--bsdf", "NAME", "reflection",
     "reflection, or dielectric: reflection and transmission by exact Fresnel; needs --fresnel "
     "dielectric:IOR, of the inside over the outside; a wi below the surface is then inside",
     lobe_app_read_choice, MEMBER(bsdf), bsdfs},
    {"--transport", "NAME", "radiance",
     "what a dielectric transports: through the surface radiance grows and shrinks with the square "
     "of the index, importance does not",
     lobe_app_read_choice, MEMBER(transport), transports},
    {0}};
#undef MEMBER

lobe_app_model_values lobe_app_default_model(void) {
    const lobe_reflection_options options = lobe_reflection_default_options();
    return (lobe_app_model_values){.method = LOBE_METHOD_COUNT,
                                   .g2 = (int)options.g2,
                                   .normalization = (int)options.normalization,
                                   .floor = options.floor,
                                   .plane = {0, 0, 1}};
}

/* "ndf, caps, ..." of what exists for a distribution and a masking. */
static void list_methods(lobe_model model, char *text, size_t room) {
    size_t length = 0;
    text[0] = '\0';
    for (int i = 0; i < lobe_model_count(); ++i) {
        const lobe_model known = lobe_model_at(i);
        if (known.ndf != model.ndf || known.masking != model.masking) continue;
        const int added = snprintf(text + length, room - length, "%s%s", length ? ", " : "",
                                   lobe_method_name(known.method));
        if (added > 0 && length + (size_t)added < room) length += (size_t)added;
    }
}

lobe_app_status lobe_app_choose_model(int ndf, int masking, int method, lobe_model *model) {
    *model = (lobe_model){(lobe_ndf)ndf, (lobe_masking)masking, (lobe_method)method};
    if (method == LOBE_METHOD_COUNT) model->method = lobe_best_method(model->ndf, model->masking);
    if (lobe_model_exists(*model)) return LOBE_APP_DONE;
    char methods[256], hint[320];
    list_methods(*model, methods, sizeof methods);
    snprintf(hint, sizeof hint, "those that do are %s", methods);
    return lobe_app_reject("--method", hint, "%s does not exist for --ndf %s --masking %s",
                           lobe_method_name(model->method), lobe_ndf_name(model->ndf),
                           lobe_masking_name(model->masking));
}

lobe_app_status lobe_app_check_floor(const lobe_app_arguments *arguments, lobe_model model) {
    if (!lobe_app_is_given(arguments, "--floor") ||
        (model.method == LOBE_METHOD_HORIZON && model.ndf == LOBE_NDF_GGX))
        return LOBE_APP_DONE;
    return lobe_app_reject("--floor", "it goes with --ndf ggx --method horizon",
                           "%s %s has no floor", lobe_ndf_name(model.ndf),
                           lobe_method_name(model.method));
}

/* ---- Model ----------------------------------------------------------------------------------- */

static lobe_vec3_f32 narrow(lobe_vec3_f64 v) {
    return (lobe_vec3_f32){(float)v.x, (float)v.y, (float)v.z};
}

static lobe_vec3_f64 widen(lobe_vec3_f32 v) {
    return (lobe_vec3_f64){v.x, v.y, v.z};
}

/* false: the model is invalid in its precision. */
static bool prepare(const lobe_app_model_values *values, lobe_reflection_options options,
                    lobe_vec3_f64 wi, lobe_vec3_f64 plane, lobe_app_model *model) {
    const double ax = values->alpha[0], ay = values->alpha[1];
    model->f32 =
        lobe_reflection_prepare_above_f32(options, narrow(wi), (float)ax, (float)ay, narrow(plane));
    model->f64 = lobe_reflection_prepare_above_f64(options, wi, ax, ay, plane);
    return model->precision == LOBE_APP_F32 ? model->f32.is_valid : model->f64.is_valid;
}

static double dot(lobe_vec3_f64 a, lobe_vec3_f64 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

lobe_app_status lobe_app_prepare(const lobe_app_model_values *values,
                                 const lobe_app_arguments *arguments, lobe_app_model *model) {
    if (!lobe_app_is_given(arguments, "--alpha"))
        return lobe_app_reject("--alpha", "give the roughness, as in --alpha 0.3", "missing");
    if (!lobe_app_is_given(arguments, "--wi"))
        return lobe_app_reject("--wi", "give the direction toward the viewer, as in --wi 0.6,0,0.8",
                               "missing");
    lobe_reflection_options options = lobe_reflection_default_options();
    lobe_app_status status = lobe_app_check_bsdf(values, arguments);
    if (status != LOBE_APP_DONE) return status;
    model->precision = (lobe_app_precision)values->precision;
    model->bsdf = (lobe_app_bsdf)values->bsdf;
    if (model->bsdf == LOBE_APP_DIELECTRIC) return lobe_app_prepare_dielectric(values, model);
    status = lobe_app_choose_model(values->ndf, values->masking, values->method, &options.model);
    if (status != LOBE_APP_DONE) return status;
    if ((status = lobe_app_check_floor(arguments, options.model))) return status;
    options.g2 = (lobe_g2)values->g2;
    options.floor = values->floor;
    options.normalization = (lobe_normalization)values->normalization;
    model->fresnel = values->fresnel;
    if (prepare(values, options, values->wi, values->plane, model)) return LOBE_APP_DONE;
    const lobe_vec3_f64 z = {0, 0, 1};
    if (dot(values->wi, values->plane) <= 0 && prepare(values, options, values->wi, z, model))
        return lobe_app_reject("--geometric-normal", "turn it toward --wi",
                               "the direction lies below the geometric surface");
    if (prepare(values, options, z, z, model))
        return lobe_app_reject("--wi", "tilt the direction", "no microfacet faces it");
    return lobe_app_reject("--alpha", "give a smaller roughness",
                           "%g,%g is too large for the precision", values->alpha[0],
                           values->alpha[1]);
}

lobe_reflection_draw_f64 lobe_app_draw(const lobe_app_model *model, const double u[3]) {
    if (model->bsdf == LOBE_APP_DIELECTRIC) return lobe_app_draw_dielectric(model, u);
    if (model->precision == LOBE_APP_F64) {
        lobe_reflection_draw_f64 draw = lobe_reflection_sample_f64(&model->f64, u[0], u[1], u[2]);
        draw.weight *= lobe_app_fresnel_f64(&model->fresnel, draw.cos_im);
        return draw;
    }
    const lobe_reflection_draw_f32 draw =
        lobe_reflection_sample_f32(&model->f32, (float)u[0], (float)u[1], (float)u[2]);
    return (lobe_reflection_draw_f64){
        widen(draw.m), widen(draw.wo),
        draw.cos_im,   draw.pdf_m,
        draw.pdf,      draw.weight * lobe_app_fresnel_f32(&model->fresnel, draw.cos_im)};
}

static lobe_reflection_eval_f64 finish_f64(const lobe_app_model *model,
                                           lobe_reflection_eval_f64 eval) {
    eval.f_cos *= lobe_app_fresnel_f64(&model->fresnel, eval.cos_im);
    return eval;
}

static lobe_reflection_eval_f64 finish_f32(const lobe_app_model *model,
                                           lobe_reflection_eval_f32 eval) {
    return (lobe_reflection_eval_f64){eval.d,
                                      eval.g1_i,
                                      eval.g1_o,
                                      eval.g2,
                                      eval.pdf_m,
                                      eval.pdf,
                                      eval.f_cos *
                                          lobe_app_fresnel_f32(&model->fresnel, eval.cos_im),
                                      eval.cos_im};
}

lobe_reflection_eval_f64 lobe_app_eval_wo(const lobe_app_model *model, lobe_vec3_f64 wo) {
    if (model->bsdf == LOBE_APP_DIELECTRIC) return lobe_app_eval_dielectric(model, wo);
    if (model->precision == LOBE_APP_F64)
        return finish_f64(model, lobe_reflection_eval_wo_f64(&model->f64, wo));
    return finish_f32(model, lobe_reflection_eval_wo_f32(&model->f32, narrow(wo)));
}

lobe_reflection_eval_f64 lobe_app_eval_m(const lobe_app_model *model, lobe_vec3_f64 m) {
    if (model->precision == LOBE_APP_F64)
        return finish_f64(model, lobe_reflection_eval_m_f64(&model->f64, m));
    return finish_f32(model, lobe_reflection_eval_m_f32(&model->f32, narrow(m)));
}

void lobe_app_random(const lobe_app_model *model, uint64_t seed, uint64_t row, double u[3]) {
    if (model->precision == LOBE_APP_F64) {
        lobe_draw_numbers_f64(seed, row, u);
        return;
    }
    float narrow_u[3];
    lobe_draw_numbers_f32(seed, row, narrow_u);
    for (int k = 0; k < 3; k++) u[k] = narrow_u[k];
}

bool lobe_app_normalize(lobe_app_precision precision, lobe_vec3_f64 *v) {
    const double scale = fmax(fabs(v->x), fmax(fabs(v->y), fabs(v->z)));
    if (!(scale > 0)) return false;
    const double x = v->x / scale, y = v->y / scale, z = v->z / scale; /* no overflow below */
    const double length = sqrt(x * x + y * y + z * z);
    const double rounding = 4 * (precision == LOBE_APP_F32 ? (double)FLT_EPSILON : DBL_EPSILON);
    if (fabs(scale * length - 1) > rounding)
        *v = (lobe_vec3_f64){x / length, y / length, z / length};
    return true;
}
