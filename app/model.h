/* app/model.h: the model options of the number commands, and the model in the chosen precision.
 * Outside this file everything is double: a float is one exactly. */
#ifndef LOBE_APP_MODEL_H
#define LOBE_APP_MODEL_H

#include <stdint.h>

#include <lobe/dielectric.h>
#include <lobe/reflection.h>

#include "fresnel.h"
#include "options.h"

typedef enum lobe_app_precision { LOBE_APP_F32, LOBE_APP_F64 } lobe_app_precision;

typedef enum lobe_app_bsdf { LOBE_APP_REFLECTION, LOBE_APP_DIELECTRIC } lobe_app_bsdf;

/* What the options say. */
typedef struct lobe_app_model_values {
    int ndf, masking, precision;
    int bsdf, transport;           /* lobe_app_bsdf, lobe_transport */
    int method, g2, normalization; /* lobe_method (_COUNT: the best), lobe_g2, lobe_normalization */
    double alpha[2], floor;
    lobe_vec3_f64 wi;    /* of unit length */
    lobe_vec3_f64 plane; /* geometric normal, of unit length */
    lobe_app_fresnel fresnel;
} lobe_app_model_values;

extern const lobe_app_option lobe_app_model_options[]; /* fills a lobe_app_model_values */
extern const char *const lobe_app_ndfs[],
    *const lobe_app_maskings[], *const lobe_app_methods[], *const lobe_app_g2s[],
                                                               *const lobe_app_normalizations[];

lobe_app_model_values lobe_app_default_model(void);

/* The row of the list of models; reports a combination that does not exist, and which ones do.
 * method LOBE_METHOD_COUNT: the best. */
lobe_app_status lobe_app_choose_model(int ndf, int masking, int method, lobe_model *model);

/* Bad usage if a floor is given for a method that has none. */
lobe_app_status lobe_app_check_floor(const lobe_app_arguments *arguments, lobe_model model);

/* The model, ready to draw from; reports what is missing or out of range. */
typedef struct lobe_app_model {
    lobe_app_precision precision;
    lobe_app_bsdf bsdf;
    lobe_app_fresnel fresnel;
    lobe_reflection_f32 f32;
    lobe_reflection_f64 f64;
    lobe_dielectric_f32 dielectric_f32;
    lobe_dielectric_f64 dielectric_f64;
} lobe_app_model;

lobe_app_status lobe_app_prepare(const lobe_app_model_values *values,
                                 const lobe_app_arguments *arguments, lobe_app_model *model);

/* Weight and f_cos include the Fresnel factor; eval_m is of reflection only. */
lobe_reflection_draw_f64 lobe_app_draw(const lobe_app_model *model, const double u[3]);
lobe_reflection_eval_f64 lobe_app_eval_wo(const lobe_app_model *model, lobe_vec3_f64 wo);
lobe_reflection_eval_f64 lobe_app_eval_m(const lobe_app_model *model, lobe_vec3_f64 m);

/* Three numbers in [0, 1) for the row-th draw. f32 takes the leading bits of the numbers of f64, so
 * that both draw the same directions up to rounding. */
void lobe_app_random(const lobe_app_model *model, uint64_t seed, uint64_t row, double u[3]);

/* `v` scaled to unit length, and left as it is, bit for bit, if it has that length up to the rounding
 * of `precision`. false: it is zero. */
bool lobe_app_normalize(lobe_app_precision precision, lobe_vec3_f64 *v);

lobe_app_reader lobe_app_read_direction; /* value: lobe_vec3_f64 of unit length */
lobe_app_reader lobe_app_read_floor;     /* value: double in [0, 1] */

#endif
