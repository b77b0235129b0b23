#include "dielectric_cases.h"

#define CORRELATED LOBE_G2_CORRELATED
#define SEPARABLE LOBE_G2_SEPARABLE
#define RADIANCE LOBE_TRANSPORT_RADIANCE
#define IMPORTANCE LOBE_TRANSPORT_IMPORTANCE

/* Water, glass, diamond, next to nothing, and the reverse; straight on to grazing, from outside and from
 * inside, where the critical angle of glass is at 138 degrees; thin walls; compensated. */
static const lobe_dielectric_parameters CONFIGURATIONS[] = {
    {{CORRELATED, RADIANCE, 0, 0}, 0.3, 0.3, 1.5, 0, 0},
    {{SEPARABLE, IMPORTANCE, 0, 0}, 0.3, 0.3, 1.5, 40, 30},
    {{CORRELATED, IMPORTANCE, 0, 0}, 0.2, 0.8, 1.33, 60, 45},
    {{SEPARABLE, RADIANCE, 0, 0}, 0.05, 0.4, 1.5, 75, 100},
    {{CORRELATED, RADIANCE, 0, 0}, 1, 1, 2.4, 30, 0},
    {{SEPARABLE, RADIANCE, 0, 0}, 0.4, 0.4, 1.5, 90, 20},
    {{CORRELATED, RADIANCE, 0, 0}, 0.4, 0.4, 1.5, 88, 20},
    {{SEPARABLE, RADIANCE, 0, 0}, 0.01, 0.01, 1.5, 50, 200},
    {{CORRELATED, IMPORTANCE, 0, 0}, 0.5, 0.5, 1.0001, 35, 0},
    {{SEPARABLE, RADIANCE, 0, 0}, 0.5, 0.3, 0.75, 55, 60},
    {{CORRELATED, RADIANCE, 0, 0}, 0.3, 0.3, 1.5, 180, 0},
    {{SEPARABLE, IMPORTANCE, 0, 0}, 0.1, 0.1, 1.5, 138, 0},
    {{CORRELATED, RADIANCE, 0, 0}, 0.4, 0.2, 1.5, 120, 70},
    {{SEPARABLE, RADIANCE, 0, 0}, 1, 1, 2.4, 150, 0},
    {{CORRELATED, IMPORTANCE, 0, 0}, 0.6, 0.6, 1.33, 93, 10},
    {{CORRELATED, RADIANCE, 0, 0}, 0.5, 0.5, 1.0001, 140, 0},
    {{CORRELATED, RADIANCE, 1, 0}, 0.4, 0.2, 1.5, 65, 30},
    {{CORRELATED, RADIANCE, 1, 1}, 0.4, 0.2, 1.5, 115, 30},
    {{CORRELATED, IMPORTANCE, 0, 1}, 0.6, 0.6, 1.5, 60, 0},
    {{SEPARABLE, RADIANCE, 0, 1}, 0.3, 0.5, 1.5, 125, 0},
};

enum { CONFIGURATION_COUNT = sizeof CONFIGURATIONS / sizeof *CONFIGURATIONS };

size_t lobe_dielectric_case_count(void) {
    return (size_t)LOBE_PRECISION_COUNT * CONFIGURATION_COUNT;
}

lobe_dielectric_case lobe_dielectric_case_at(size_t index) {
    return (lobe_dielectric_case){CONFIGURATIONS[index % CONFIGURATION_COUNT],
                                  (lobe_precision)(index / CONFIGURATION_COUNT)};
}
