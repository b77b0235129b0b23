/* A clear coat over any surface (KHR_materials_clearcoat): GGX with the exact Fresnel of an index of 1.5 and a
 * normal of its own. It reflects share * F; what lies below gets what the coat's albedo E toward the viewer leaves,
 * 1 - share * E(i), so that a white surface stays white. As published that factor is not reciprocal. */
#ifndef LOBE_RENDER_CLEARCOAT_H
#define LOBE_RENDER_CLEARCOAT_H

#include "coat.h"
#include "vector.h"

typedef struct clearcoat {
    frame frame;
    vec3 geometric;
    lobe_reflection_f32 ggx;
    float share;
    float keeps;       /* what lies below */
    float probability; /* of drawing from the coat */
} clearcoat;

typedef struct clearcoat_draw {
    vec3 direction; /* world */
    float weight;   /* f cos / pdf */
    float pdf;      /* 0: rejected */
} clearcoat_draw;

/* `table` is that of COAT_IOR, `below` about what lies below reflects. */
clearcoat lobe_clearcoat_at(const lobe_reflection_options *ggx, const coat_table *table,
                            frame shading, vec3 geometric, vec3 to_viewer, float share,
                            float roughness, float below);

clearcoat_draw lobe_clearcoat_draw(const clearcoat *c, float u1, float u2, float u3);

/* f cos and density at a direction; 0 of a point mass, and below either surface. */
float lobe_clearcoat_value(const clearcoat *c, vec3 direction, float *pdf);

#endif
