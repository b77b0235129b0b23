/* The list of rough dielectrics that are verified. */
#ifndef LOBE_VERIFY_DIELECTRIC_CASES_H
#define LOBE_VERIFY_DIELECTRIC_CASES_H

#include "dielectric_model.h"

typedef struct lobe_dielectric_case {
    lobe_dielectric_parameters parameters;
    lobe_precision precision;
} lobe_dielectric_case;

size_t lobe_dielectric_case_count(void);
lobe_dielectric_case lobe_dielectric_case_at(size_t index);

#endif
