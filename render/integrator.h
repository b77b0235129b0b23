/* Camera paths: unidirectional, with next-event estimation and multiple importance sampling. */
#ifndef LOBE_RENDER_INTEGRATOR_H
#define LOBE_RENDER_INTEGRATOR_H

#include "cone.h"
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

/* A path in the making, and what it found. */
typedef struct path {
    const integrator *k;
    sampler numbers;
    film_sample sample;
    vec3 origin, direction, throughput;
    vec3
        place; /* on the surface where the path was last: what lies in a solid is measured from it */
    vec3 facing;  /* the surface's normal there; 0: it is lit from both sides */
    float pdf;    /* of `direction`; a point mass: infinite */
    cone cone;    /* of `direction` */
    float spread; /* by which refraction has shrunk radiance so far: what returns on leaving */
    const material *inside; /* the solid in which the path is; NULL: none. They do not nest */
    int is_camera;          /* no surface yet: light is taken as it is */
    uint32_t rays;          /* traced */
} path;

/* So many paths stay in the cache with all that they meet. */
enum { WAVE_PATHS = 128 };

void lobe_path_begin(path *p, const integrator *k, vec3 origin, vec3 direction, sampler numbers);

/* 1 to WAVE_PATHS paths of one integrator, side by side: their samples, the same for each as if it were alone. */
void lobe_trace_paths(path *paths, int count);

/* One path. `rays` is raised by the rays traced. */
film_sample lobe_trace_path(const integrator *k, vec3 origin, vec3 direction, sampler *numbers,
                            uint64_t *rays);

/* The first surface of a ray, as lobe_rays_meet tells it. */
int lobe_first_surface(const lobe_scene *s, vec3 origin, vec3 direction, lobe_ray_surface *surface);

/* The coat's table of every material and of COAT_IOR, by malloc; NULL: no memory. */
const coat_table **lobe_find_coats(const lobe_scene *s, const lobe_reflection_options *o);

#endif
