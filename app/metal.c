#include "metal.h"

#include <stdio.h>
#include <string.h>

#include "number.h"

static const char f82[] = "f82:", conductor[] = "conductor:";

static bool begins_with(const char *text, const char *start) {
    return strncmp(text, start, strlen(start)) == 0;
}

static bool refuse(const lobe_app_option *option, const char *text, const char *hint) {
    lobe_app_report(option->name, hint, "cannot use '%.60s'", text);
    return false;
}

/* The numbers behind a colon, each in its range. */
static bool read_channels(const char *text, int count, double least, double most, double *number) {
    if (lobe_app_read_numbers(text, count, count, number) != count) return false;
    for (int i = 0; i < count; i++)
        if (!(number[i] >= (i < 3 ? least : 0) && number[i] <= most)) return false;
    return true;
}

static bool read_f82(const lobe_app_option *option, const char *text, lobe_metal *metal) {
    double tint[3];
    if (!read_channels(text + strlen(f82), 3, 0, 1, tint))
        return refuse(option, text, "write f82:R,G,B, the tint of each channel in [0, 1]");
    *metal = (lobe_metal){.law = LOBE_METAL_F82};
    for (int c = 0; c < 3; c++) metal->tint[c] = (float)tint[c];
    return true;
}

static bool read_conductor(const lobe_app_option *option, const char *text, lobe_metal *metal) {
    double index[6];
    if (!read_channels(text + strlen(conductor), 6, 1e-3, 1e3, index))
        return refuse(option, text,
                      "write conductor:NR,NG,NB,KR,KG,KB, each N in [0.001, 1000] and K in "
                      "[0, 1000]");
    *metal = (lobe_metal){.law = LOBE_METAL_CONDUCTOR};
    for (int c = 0; c < 3; c++) {
        metal->n[c] = (float)index[c];
        metal->k[c] = (float)index[c + 3];
    }
    return true;
}

static bool refuse_name(const lobe_app_option *option, const char *text) {
    char hint[256] = "write schlick, f82:R,G,B, conductor:NR,NG,NB,KR,KG,KB";
    for (size_t i = 0; lobe_metal_name(i); i++) {
        const size_t used = strlen(hint);
        snprintf(hint + used, sizeof hint - used, "%s%s", lobe_metal_name(i + 1) ? ", " : " or ",
                 lobe_metal_name(i));
    }
    return refuse(option, text, hint);
}

bool lobe_app_read_metal(const lobe_app_option *option, const char *text, void *value) {
    lobe_metal *metal = value;
    if (begins_with(text, f82)) return read_f82(option, text, metal);
    if (begins_with(text, conductor)) return read_conductor(option, text, metal);
    if (strcmp(text, "schlick") == 0) {
        *metal = (lobe_metal){.law = LOBE_METAL_SCHLICK};
        return true;
    }
    return lobe_metal_from_name(text, metal) || refuse_name(option, text);
}
