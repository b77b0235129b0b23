/* app/fresnel.h: the option --fresnel. */
#ifndef LOBE_APP_FRESNEL_H
#define LOBE_APP_FRESNEL_H

#include "options.h"

typedef enum lobe_app_fresnel_kind {
    LOBE_APP_FRESNEL_NONE, /* 1 */
    LOBE_APP_FRESNEL_SCHLICK,
    LOBE_APP_FRESNEL_F82,
    LOBE_APP_FRESNEL_DIELECTRIC,
    LOBE_APP_FRESNEL_CONDUCTOR
} lobe_app_fresnel_kind;

typedef struct lobe_app_fresnel {
    lobe_app_fresnel_kind kind;
    double parameter[2];
} lobe_app_fresnel;

lobe_app_reader lobe_app_read_fresnel; /* value: lobe_app_fresnel */

float lobe_app_fresnel_f32(const lobe_app_fresnel *fresnel, float cos_im);
double lobe_app_fresnel_f64(const lobe_app_fresnel *fresnel, double cos_im);

#endif
