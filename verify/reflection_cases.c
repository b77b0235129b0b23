#include "reflection_cases.h"

typedef struct configuration {
    double alpha_x, alpha_y;
    double theta, phi;
    lobe_g2 g2;
    double tilt, tilt_azimuth; /* of the geometric normal */
} configuration;

/* Smooth to very rough, round to 150:1, straight on to grazing to behind; closed forms at alpha = 1
 * and at theta = 0; the mirror, and one roughness below the floor; above a geometric surface. */
static const configuration CONFIGURATIONS[] = {
    {1, 1, 0, 0, LOBE_G2_CORRELATED, 0, 0},          {1, 1, 60, 30, LOBE_G2_SEPARABLE, 0, 0},
    {1, 1, 75, 20, LOBE_G2_CORRELATED, 0, 0},        {0.3, 0.3, 0, 0, LOBE_G2_SEPARABLE, 0, 0},
    {0.7, 0.7, 40, 0, LOBE_G2_CORRELATED, 0, 0},     {0.05, 0.05, 30, 60, LOBE_G2_CORRELATED, 0, 0},
    {0.001, 0.001, 50, 0, LOBE_G2_CORRELATED, 0, 0}, {0.3, 0.3, 88, 10, LOBE_G2_CORRELATED, 0, 0},
    {0.2, 0.8, 40, 45, LOBE_G2_CORRELATED, 0, 0},    {0.2, 0.8, 60, 90, LOBE_G2_SEPARABLE, 0, 0},
    {0.1, 1, 60, 45, LOBE_G2_CORRELATED, 0, 0},      {0.5, 1, 75, 0, LOBE_G2_CORRELATED, 0, 0},
    {0.02, 0.5, 20, 70, LOBE_G2_CORRELATED, 0, 0},   {0.9, 0.3, 85, 300, LOBE_G2_SEPARABLE, 0, 0},
    {2, 2, 30, 0, LOBE_G2_CORRELATED, 0, 0},         {1.5, 0.4, 65, 120, LOBE_G2_CORRELATED, 0, 0},
    {0.6, 0.6, 90, 0, LOBE_G2_CORRELATED, 0, 0},     {0.4, 0.4, 100, 0, LOBE_G2_CORRELATED, 0, 0},
    {0.2, 0.7, 120, 40, LOBE_G2_SEPARABLE, 0, 0},    {1, 1, 150, 10, LOBE_G2_CORRELATED, 0, 0},
    {0.3, 0.1, 95, 200, LOBE_G2_CORRELATED, 0, 0},   {0.002, 0.3, 70, 30, LOBE_G2_CORRELATED, 0, 0},
    {0, 0.2, 45, 80, LOBE_G2_CORRELATED, 0, 0},      {0, 0, 40, 0, LOBE_G2_CORRELATED, 0, 0},
    {0.5, 0.5, 40, 0, LOBE_G2_CORRELATED, 20, 130},  {0.1, 1, 70, 45, LOBE_G2_CORRELATED, 35, 130},
    {0.3, 0.8, 60, 10, LOBE_G2_SEPARABLE, 35, 20},   {0.4, 0.2, 100, 0, LOBE_G2_CORRELATED, 30, 15},
};

enum { CONFIGURATION_COUNT = sizeof CONFIGURATIONS / sizeof *CONFIGURATIONS };

size_t lobe_reflection_case_count(void) {
    return (size_t)lobe_model_count() * LOBE_PRECISION_COUNT * CONFIGURATION_COUNT;
}

lobe_reflection_case lobe_reflection_case_at(size_t index) {
    const configuration *c = &CONFIGURATIONS[index % CONFIGURATION_COUNT];
    size_t model = index / CONFIGURATION_COUNT;
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = lobe_model_at((int)(model / LOBE_PRECISION_COUNT));
    options.g2 = c->g2;
    return (lobe_reflection_case){
        {options, c->alpha_x, c->alpha_y, c->theta, c->phi, c->tilt, c->tilt_azimuth},
        (lobe_precision)(model % LOBE_PRECISION_COUNT)};
}
