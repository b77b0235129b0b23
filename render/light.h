/* Lamps, emissive triangles and the environment, as one thing to draw from. */
#ifndef LOBE_RENDER_LIGHT_H
#define LOBE_RENDER_LIGHT_H

#include "hit_point.h"
#include "sampler.h"

/* One point of light: direction, distance, radiance and density over directions. A point mass:
 * radiance is the irradiance across the direction, and the density the probability of the lamp. */
typedef struct light_sample {
    vec3 direction, radiance;
    float distance, pdf;
    int is_point_mass;
} light_sample;

/* Where light is asked for, of which the choice of a lamp depends. */
typedef struct lit_place {
    int has_tree;       /* lamps are chosen by the tree; else by power alone */
    vec3 place, facing; /* facing: the surface's normal; 0: it is lit from both sides */
} lit_place;

/* Probability of asking the environment rather than a lamp. */
float lobe_light_sky_probability(const lobe_scene *s);

/* Density over directions of drawing the point that a ray from `lit` met; 0 where it cannot be drawn. */
float lobe_light_lamp_pdf(const lobe_scene *s, const lit_place *lit, const hit_point *h,
                          vec3 direction);

/* `from`: where the ray to the light begins. */
light_sample lobe_light_draw(const lobe_scene *s, const lit_place *lit, vec3 from,
                             sampler_point point);

#endif
