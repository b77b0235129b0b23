/* app/albedo_draws.h: `lobe albedo --method SAMPLER`: albedos as the mean of drawn weights. */
#ifndef LOBE_APP_ALBEDO_DRAWS_H
#define LOBE_APP_ALBEDO_DRAWS_H

#include <stdbool.h>
#include <stdint.h>

#include <lobe/albedo.h>
#include <lobe/reflection.h>

typedef struct lobe_app_draws {
    lobe_reflection_options options;
    double alpha[2];
    lobe_vec3_f64 plane; /* geometric normal */
    uint64_t count, seed;
} lobe_app_draws;

/* Toward wi with F = 1, and by each law. The draws are those of `lobe sample --precision f64` with
 * this seed. false: interrupted, or the model is invalid. */
bool lobe_app_albedo_by_draws(const lobe_app_draws *draws, lobe_vec3_f64 wi,
                              const lobe_reflectance *laws, int count, double *e, double *by_law);

#endif
