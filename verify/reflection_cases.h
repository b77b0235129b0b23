/* The list of what is verified: every method and precision at every configuration. */
#ifndef LOBE_VERIFY_REFLECTION_CASES_H
#define LOBE_VERIFY_REFLECTION_CASES_H

#include "reflection_model.h"

typedef struct lobe_reflection_case {
    lobe_reflection_parameters parameters;
    lobe_precision precision;
} lobe_reflection_case;

size_t lobe_reflection_case_count(void);
lobe_reflection_case lobe_reflection_case_at(size_t index);

#endif
