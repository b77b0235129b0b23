/* One camera path: unidirectional, with next-event estimation and multiple importance sampling. */
#ifndef LOBE_RENDER_INTEGRATOR_H
#define LOBE_RENDER_INTEGRATOR_H

#include "film.h"
#include "sampler.h"
#include "scene.h"

typedef struct integrator {
    const lobe_scene *scene;
    surface_options surface;        /* its coat is that of the material: */
    const coat_table *const *coats; /* after the last material's, that of COAT_IOR */
    lobe_heuristic heuristic;
    int depth, roulette_depth;
} integrator;

/* `rays` is raised by the rays traced. */
film_sample lobe_trace_path(const integrator *k, vec3 origin, vec3 direction, sampler *points,
                            uint64_t *rays);

#endif
