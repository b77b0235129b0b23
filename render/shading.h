/* What a path does at a surface: the value toward a light, and a draw. For one point, or for many side by side
 * (rows/rows.h), with the same bits. */
#ifndef LOBE_RENDER_SHADING_H
#define LOBE_RENDER_SHADING_H

#include "hit_point.h"
#include "integrator.h"
#include "light.h"

/* One point; at `hit.shading` the frame is that of the stretched surface. */
typedef struct shading_point {
    hit_point hit;
    hit_looks looks;
    vec3 to_viewer;
    light_sample light; /* pdf: 0 where none was drawn */
    sampler *numbers;   /* of the path */
    sampler_point roll; /* of the draw; its last number is free */
    /* what comes out */
    vec3 value; /* f cos toward the light; 0 where none can be drawn for the surface, */
    float value_pdf;
    surface_draw draw;
    int has_glass;
    float vndf_integral; /* of a first surface, where the integrator keeps it; without a GGX 1 */
} shading_point;

/* Up to WAVE_PATHS points: takes the numbers of the draw from the path, then fills in all that comes out. `is_first`: the first surfaces. */
void lobe_shade(const integrator *k, shading_point *points, int count, int is_first);

#endif
