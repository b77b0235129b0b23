/* What the facets of metals reflect. All that depends on the law is here: F at an angle, straight ahead and on
 * average, and as random walks take it. One law holds for the whole scene. */
#ifndef LOBE_RENDER_METAL_H
#define LOBE_RENDER_METAL_H

#include "lobe/albedo.h"
#include "lobe/render.h"
#include "vector.h"

/* A law with what follows from it, found once a picture: the average of a conductor is an integral. */
typedef struct metal {
    lobe_metal law;
    vec3 f0, average; /* of conductors only */
} metal;

int lobe_metal_is_usable(const lobe_metal *law);
metal lobe_metal_prepare(const lobe_metal *law);

/* NULL for `m` is Schlick's law. `base_color` is F straight ahead, where it is not the conductor that says it. */
vec3 lobe_metal_f0(const metal *m, vec3 base_color);
vec3 lobe_metal_at(const metal *m, vec3 base_color, float cosine);
vec3 lobe_metal_average(const metal *m, vec3 base_color);
void lobe_metal_reflectances(const metal *m, vec3 base_color, lobe_reflectance by_channel[3]);

#endif
