/* lib/methods.c: the names of the lists, and the options to start from. */
#include "lobe/reflection.h"

#include <stddef.h>
#include <string.h>

#define NAME(ID, name) name,
static const char *const ndf_names[LOBE_NDF_COUNT] = {LOBE_NDFS(NAME)};
static const char *const masking_names[LOBE_MASKING_COUNT] = {LOBE_MASKINGS(NAME)};
#undef NAME

typedef struct method_row {
    const char *name;
    const char *about;
} method_row;

#define METHOD_ROW(ID, name, about) {name, about},
static const method_row methods[LOBE_METHOD_COUNT] = {LOBE_METHODS(METHOD_ROW)};
#undef METHOD_ROW

#define MODEL_ROW(NDF, MASKING, METHOD, kernel)                                                    \
    {LOBE_NDF_##NDF, LOBE_MASKING_##MASKING, LOBE_METHOD_##METHOD},
static const lobe_model models[] = {LOBE_MODELS(MODEL_ROW)};
#undef MODEL_ROW

enum { MODELS = sizeof models / sizeof *models };

const char *lobe_ndf_name(lobe_ndf ndf) {
    return (unsigned)ndf < LOBE_NDF_COUNT ? ndf_names[ndf] : NULL;
}

const char *lobe_masking_name(lobe_masking masking) {
    return (unsigned)masking < LOBE_MASKING_COUNT ? masking_names[masking] : NULL;
}

lobe_method lobe_method_from_name(const char *name) {
    int method = 0;
    while (method < LOBE_METHOD_COUNT && (!name || strcmp(methods[method].name, name) != 0))
        ++method;
    return (lobe_method)method;
}

const char *lobe_method_name(lobe_method method) {
    return (unsigned)method < LOBE_METHOD_COUNT ? methods[method].name : NULL;
}

const char *lobe_method_about(lobe_method method) {
    return (unsigned)method < LOBE_METHOD_COUNT ? methods[method].about : NULL;
}

int lobe_model_count(void) {
    return MODELS;
}

lobe_model lobe_model_at(int index) {
    const lobe_model none = {LOBE_NDF_COUNT, LOBE_MASKING_COUNT, LOBE_METHOD_COUNT};
    return index >= 0 && index < MODELS ? models[index] : none;
}

int lobe_model_exists(lobe_model model) {
    int index = 0;
    while (index < MODELS && memcmp(&models[index], &model, sizeof model) != 0) ++index;
    return index < MODELS;
}

lobe_method lobe_best_method(lobe_ndf ndf, lobe_masking masking) {
    for (int index = MODELS - 1; index >= 0; --index)
        if (models[index].ndf == ndf && models[index].masking == masking)
            return models[index].method;
    return LOBE_METHOD_COUNT;
}

lobe_reflection_options lobe_reflection_default_options(void) {
    lobe_reflection_options options = {
        {LOBE_NDF_GGX, LOBE_MASKING_SMITH, lobe_best_method(LOBE_NDF_GGX, LOBE_MASKING_SMITH)},
        LOBE_G2_CORRELATED,
        LOBE_NORMALIZATION_UNBIASED,
        0.25};
    return options;
}
