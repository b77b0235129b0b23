/* app/dielectric.h: --bsdf dielectric: reflection and transmission in the number commands. Columns are
 * those of reflection. */
#ifndef LOBE_APP_DIELECTRIC_H
#define LOBE_APP_DIELECTRIC_H

#include <lobe/dielectric.h>

#include "model.h"

/* Bad usage if an option is given that has no meaning for the chosen --bsdf, or if one is missing. */
lobe_app_status lobe_app_check_bsdf(const lobe_app_model_values *values,
                                    const lobe_app_arguments *arguments);

/* Of what lobe_app_check_bsdf let pass; reports a roughness out of range. */
lobe_app_status lobe_app_prepare_dielectric(const lobe_app_model_values *values,
                                            lobe_app_model *model);

lobe_reflection_draw_f64 lobe_app_draw_dielectric(const lobe_app_model *model, const double u[3]);
lobe_reflection_eval_f64 lobe_app_eval_dielectric(const lobe_app_model *model, lobe_vec3_f64 wo);

#endif
