#include "fresnel.h"

#include <string.h>

#include <lobe/fresnel.h>

#include "number.h"

/* How each kind is written: "f82:F0,TINT", and the ranges of its numbers. */
static const struct form {
    const char *prefix;
    lobe_app_fresnel_kind kind;
    int count;
    double least[2], most[2];
    const char *hint;
} forms[] = {
    {"f82:", LOBE_APP_FRESNEL_F82, 2, {0, 0}, {1, 1}, "write f82:F0,TINT, both in [0, 1]"},
    {"dielectric:",
     LOBE_APP_FRESNEL_DIELECTRIC,
     1,
     {1e-3},
     {1e3},
     "write dielectric:IOR, the IOR in [0.001, 1000]"},
    {"conductor:",
     LOBE_APP_FRESNEL_CONDUCTOR,
     2,
     {1e-3, 0},
     {1e3, 1e3},
     "write conductor:N,K with N in [0.001, 1000] and K in [0, 1000]"},
    {"",
     LOBE_APP_FRESNEL_SCHLICK,
     1,
     {0},
     {1},
     "write none, F0 in [0, 1], f82:F0,TINT, dielectric:IOR or conductor:N,K"},
};

static bool read_form(const struct form *form, const char *text, lobe_app_fresnel *fresnel) {
    fresnel->kind = form->kind;
    if (!lobe_app_read_numbers(text + strlen(form->prefix), form->count, form->count,
                               fresnel->parameter))
        return false;
    for (int i = 0; i < form->count; i++)
        if (!(fresnel->parameter[i] >= form->least[i] && fresnel->parameter[i] <= form->most[i]))
            return false;
    return true;
}

bool lobe_app_read_fresnel(const lobe_app_option *option, const char *text, void *value) {
    lobe_app_fresnel *fresnel = value;
    if (strcmp(text, "none") == 0) {
        *fresnel = (lobe_app_fresnel){0};
        return true;
    }
    const struct form *form = forms;
    while (strncmp(text, form->prefix, strlen(form->prefix)) != 0) form++;
    if (read_form(form, text, fresnel)) return true;
    lobe_app_report(option->name, form->hint, "cannot use '%.60s'", text);
    return false;
}

float lobe_app_fresnel_f32(const lobe_app_fresnel *fresnel, float cos_im) {
    const float a = (float)fresnel->parameter[0], b = (float)fresnel->parameter[1];
    switch (fresnel->kind) {
    case LOBE_APP_FRESNEL_NONE:
        return 1;
    case LOBE_APP_FRESNEL_SCHLICK:
        return lobe_fresnel_schlick_f32(a, cos_im);
    case LOBE_APP_FRESNEL_F82:
        return lobe_fresnel_f82_f32(a, b, cos_im);
    case LOBE_APP_FRESNEL_DIELECTRIC:
        return lobe_fresnel_dielectric_f32(a, cos_im);
    case LOBE_APP_FRESNEL_CONDUCTOR:
        return lobe_fresnel_conductor_f32(a, b, cos_im);
    }
    return 1;
}

double lobe_app_fresnel_f64(const lobe_app_fresnel *fresnel, double cos_im) {
    const double a = fresnel->parameter[0], b = fresnel->parameter[1];
    switch (fresnel->kind) {
    case LOBE_APP_FRESNEL_NONE:
        return 1;
    case LOBE_APP_FRESNEL_SCHLICK:
        return lobe_fresnel_schlick_f64(a, cos_im);
    case LOBE_APP_FRESNEL_F82:
        return lobe_fresnel_f82_f64(a, b, cos_im);
    case LOBE_APP_FRESNEL_DIELECTRIC:
        return lobe_fresnel_dielectric_f64(a, cos_im);
    case LOBE_APP_FRESNEL_CONDUCTOR:
        return lobe_fresnel_conductor_f64(a, b, cos_im);
    }
    return 1;
}
