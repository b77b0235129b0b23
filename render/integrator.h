/* One camera path: unidirectional, with next-event estimation and multiple importance sampling. */
#ifndef LOBE_RENDER_INTEGRATOR_H
#define LOBE_RENDER_INTEGRATOR_H

#include "film.h"
#include "lobe/rays.h"
#include "ray_log.h"
#include "sampler.h"
#include "scene.h"

typedef struct integrator {
    const lobe_scene *scene;
    surface_options surface;        /* its coat is that of the material: */
    const coat_table *const *coats; /* after the last material's, that of COAT_IOR */
    lobe_heuristic heuristic;
    int depth, roulette_depth;
    int keeps_vndf_integral; /* of the first surface */
    ray_log *log;            /* of a single thread; NULL: rays are not noted */
    int has_light_tree;      /* lights are chosen by it */
    /* Over what textures are averaged (cone.h). All 0: textures are taken as they are. */
    vec3 axis;         /* of the camera, unit */
    float pixel_angle; /* of a camera ray along the axis */
    float share;       /* of what a direction that was drawn stands for, as a width */
} integrator;

/* `rays` is raised by the rays traced. */
film_sample lobe_trace_path(const integrator *k, vec3 origin, vec3 direction, sampler *points,
                            uint64_t *rays);

/* The first surface of a ray, as lobe_rays_meet tells it. */
int lobe_first_surface(const lobe_scene *s, vec3 origin, vec3 direction, lobe_ray_surface *surface);

/* The coat's table of every material and of COAT_IOR, by malloc; NULL: no memory. */
const coat_table **lobe_find_coats(const lobe_scene *s, const lobe_reflection_options *o);

#endif
