/* The library's own models as one list of cases: reflections, then rough dielectrics. */
#ifndef LOBE_VERIFY_LIBRARY_CASES_H
#define LOBE_VERIFY_LIBRARY_CASES_H

#include "dielectric_cases.h"
#include "reflection_cases.h"
#include "suite.h"

/* Stays where it is made: the model points into it. */
typedef struct lobe_library_subject {
    union {
        lobe_reflection_subject reflection;
        lobe_dielectric_subject dielectric;
    };
    const lobe_verify_model *model;
} lobe_library_subject;

size_t lobe_library_case_count(void);
void lobe_library_case_title(size_t index, lobe_case_title *title);
void lobe_library_subject_make(lobe_library_subject *subject, size_t index);

#endif
