/* What lets light through: KHR_materials_transmission, rough or smooth, as the share `transmission` of a
 * dielectric.
 *
 * A solid is a boundary between air and a material of index `ior` (lobe/dielectric.h); the outside is where
 * its triangles face. A thin wall is a sheet of parallel interfaces (thickness 0): the facets reflect
 * F' = 2F/(1 + F), and what is left goes on as if it was reflected, to the other side (glTF: a rough
 * sheet blurs). What is transmitted is tinted by the base colour, at each passing.
 *
 * Where all scatterings on a rough solid are walked (lobe/walk.h), a density stands for that of the walks: that of
 * one scattering and a cosine on each side, by the shares of the two. */
#ifndef LOBE_RENDER_GLASS_H
#define LOBE_RENDER_GLASS_H

#include "lobe/dielectric.h"
#include "lobe/reflection.h"
#include "vector.h"

typedef struct glass_material {
    float share; /* of the surface that is of glass; 0: none */
    float ior;
    int is_thin;
    vec3 tint;
    float alpha_x, alpha_y;
} glass_material;

typedef struct glass_options {
    lobe_reflection_options ggx; /* of thin walls */
    int compensate;              /* R + T = 1 */
    int walks;                   /* of solids, instead */
    uint64_t walk_seed;
} glass_options;

typedef struct glass {
    glass_material material;
    frame frame;    /* of a solid: z outward; of a sheet: toward the viewer */
    vec3 geometric; /* normal, toward the viewer */
    lobe_dielectric_f32 solid;
    lobe_vec3_f64 wi; /* in its frame */
    float walk_once;  /* share of its walks that scatter once, roughly; 0: it does not walk */
    uint64_t walk_seed;
    lobe_reflection_f32 sheet;
    float factor; /* what makes up for the energy that a sheet loses */
} glass;

typedef struct glass_draw {
    vec3 direction, weight; /* world; f cos / pdf */
    float pdf;              /* of a point mass its chance; 0: rejected */
    int is_point;
} glass_draw;

/* `shading`: toward the viewer. is_back: a solid is seen from inside. */
glass lobe_glass_at(const glass_options *options, glass_material material, frame shading,
                    vec3 geometric, vec3 to_viewer, int is_back);

/* `side` chooses between reflection and transmission; u3 is the sampling method's own. */
glass_draw lobe_glass_draw(const glass *g, float u1, float u2, float u3, float side);

/* f cos and density at a direction on either side; 0 of point masses. Of walks an estimate, the same at each
 * call. */
vec3 lobe_glass_value(const glass *g, vec3 direction, float *pdf);

/* Nothing but point masses. */
int lobe_glass_is_clear(const glass *g);

#endif
