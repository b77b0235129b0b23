/* lib/methods.c: names of the methods, and the options to start from. */
#include "lobe/ggx.h"

#include <stddef.h>
#include <string.h>

typedef struct method_row {
    const char *name;
    const char *about;
} method_row;

#define METHOD_ROW(ID, name, text, about) {text, about},
static const method_row rows[LOBE_METHOD_COUNT] = {LOBE_GGX_METHODS(METHOD_ROW)};
#undef METHOD_ROW

lobe_ggx_options lobe_ggx_default_options(void) {
    lobe_ggx_options options = {LOBE_METHOD_OPTIMAL, LOBE_G2_CORRELATED,
                                LOBE_NORMALIZATION_UNBIASED};
    return options;
}

lobe_method lobe_method_from_name(const char *name) {
    int method = 0;
    while (method < LOBE_METHOD_COUNT && (!name || strcmp(rows[method].name, name) != 0)) ++method;
    return (lobe_method)method;
}

const char *lobe_method_name(lobe_method method) {
    return (unsigned)method < LOBE_METHOD_COUNT ? rows[method].name : NULL;
}

const char *lobe_method_about(lobe_method method) {
    return (unsigned)method < LOBE_METHOD_COUNT ? rows[method].about : NULL;
}
