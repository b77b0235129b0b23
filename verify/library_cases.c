#include "library_cases.h"

size_t lobe_library_case_count(void) {
    return lobe_reflection_case_count() + lobe_dielectric_case_count();
}

void lobe_library_case_title(size_t index, lobe_case_title *title) {
    size_t reflections = lobe_reflection_case_count();
    if (index < reflections) {
        lobe_reflection_case c = lobe_reflection_case_at(index);
        lobe_reflection_subject_name(c.parameters, c.precision, title->model, sizeof title->model,
                                     title->configuration, sizeof title->configuration);
    } else {
        lobe_dielectric_case c = lobe_dielectric_case_at(index - reflections);
        lobe_dielectric_subject_name(c.parameters, c.precision, title->model, sizeof title->model,
                                     title->configuration, sizeof title->configuration);
    }
}

void lobe_library_subject_make(lobe_library_subject *subject, size_t index) {
    size_t reflections = lobe_reflection_case_count();
    if (index < reflections) {
        lobe_reflection_case c = lobe_reflection_case_at(index);
        lobe_reflection_subject_make(&subject->reflection, c.parameters, c.precision);
        subject->model = &subject->reflection.model;
    } else {
        lobe_dielectric_case c = lobe_dielectric_case_at(index - reflections);
        lobe_dielectric_subject_make(&subject->dielectric, c.parameters, c.precision);
        subject->model = &subject->dielectric.model;
    }
}
