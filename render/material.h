/* Reflection at a point: a GGX coat or metal over a diffuse base (glTF 2.0), as one density.
 *
 * Metal and coat share one GGX: F = metallic * Schlick(base colour) + (1 - metallic) * dielectric 1.5.
 * The base gets what the coat lets through (Kelemen & Szirmay-Kalos 2001):
 * f = base (1 - E(i)) (1 - E(o)) / (pi (1 - E_avg)), E the albedo of the coat: a white dielectric
 * reflects all light. E comes from a table over the roughness toward each direction. Measured against
 * the exact sum over roughness 0.02 to 1 and cosine 0.001 to 1: isotropic within 0.016 of 1 (worst at
 * roughness 0.02, cosine 0.001). An anisotropic coat is approximate there: within 0.03 at
 * anisotropy 0.3, 0.07 at 0.5, 0.18 at 0.9. */
#ifndef LOBE_RENDER_MATERIAL_H
#define LOBE_RENDER_MATERIAL_H

#include "lobe/fresnel.h"
#include "lobe/reflection.h"
#include "vector.h"

/* Roughness; cosine from -1 (a shading normal that faces away) to 1, with the average last. */
enum { COAT_ROWS = 32, COAT_COLUMNS = 98 };

/* Albedo of the coat of index 1.5 over perceptual roughness and cosine. */
void lobe_coat_table(float table[COAT_ROWS][COAT_COLUMNS]);

typedef struct surface {
    frame frame;             /* shading */
    vec3 geometric;          /* normal, toward the viewer */
    lobe_reflection_f32 ggx; /* wi is in the shading frame */
    vec3 base_color;
    float metallic;
    float base_share_i;                /* (1 - E(i))/(pi (1 - E_avg)) of the base */
    float specular;                    /* probability of drawing from the GGX */
    const float (*coat)[COAT_COLUMNS]; /* table */
} surface;

typedef struct surface_draw {
    vec3 direction; /* world */
    vec3 weight;    /* f cos / pdf */
    float pdf;      /* 0: rejected */
    int is_mirror;
    int is_ggx; /* a GGX draw was made */
} surface_draw;

typedef struct surface_options {
    lobe_reflection_options ggx;
    const float (*coat)[COAT_COLUMNS];
} surface_options;

/* `to_viewer`: unit, world, on the front of `geometric`. */
surface lobe_surface_at(const surface_options *options, frame shading, vec3 geometric,
                        vec3 to_viewer, vec3 base_color, float metallic, float roughness,
                        float anisotropy);
surface_draw lobe_surface_draw(const surface *s, float choice, float u1, float u2);

/* f cos and density at a direction; 0 below either surface, and for mirrors. */
vec3 lobe_surface_value(const surface *s, vec3 direction, float *pdf);

#endif
