/* The list of what is verified: every method and precision at every configuration. */
#ifndef LOBE_VERIFY_GGX_CASES_H
#define LOBE_VERIFY_GGX_CASES_H

#include "ggx_model.h"

typedef struct lobe_ggx_case {
    lobe_ggx_parameters parameters;
    lobe_precision precision;
} lobe_ggx_case;

size_t lobe_ggx_case_count(void);
lobe_ggx_case lobe_ggx_case_at(size_t index);

#endif
