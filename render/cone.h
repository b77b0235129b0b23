/* What a ray stands for, as a cone: over its width textures are averaged (ray cones: Amanatides 1984; Akenine-Moller et al.,
 * "Texture Level of Detail Strategies for Real-Time Ray Tracing", Ray Tracing Gems, 2019).
 *
 * A camera ray begins as a point and widens by the angle of a pixel. A direction that was drawn with density p among N
 * stands for a solid angle of 1/(N p) (Suykens and Willems, "Path Differentials and Applications", 2001): rough surfaces
 * widen the cone by a share of the root of it, mirrors do not. Curvature is left out: cones are narrower than they might be,
 * which costs noise and is never wrong. */
#ifndef LOBE_RENDER_CONE_H
#define LOBE_RENDER_CONE_H

#include "vector.h"

typedef struct cone {
    float width, angle; /* where the ray begins, and what it gains for each unit of its way */
} cone;

/* Of a pixel of a plane picture, which is seen from farther away and aslant off the axis. */
static inline cone cone_of_pixel(float pixel_angle, vec3 axis, vec3 direction) {
    const float cosine = fabsf(v3_dot(axis, direction));
    return (cone){0.0f, pixel_angle * cosine * sqrtf(cosine)};
}

static inline void cone_travel(cone *c, float distance) {
    c->width += c->angle * distance;
}

static inline void cone_scatter(cone *c, float share, float pdf) {
    c->angle = minf(c->angle + share / sqrtf(pdf), 2.0f);
}

/* Side of a square on a surface with as much area as the cone cuts out of it; of another plane where the area of a
 * triangle is `plane_area` and not `area`. */
static inline float cone_footprint(float width, float cosine, float area, float plane_area) {
    return width * sqrtf(plane_area / maxf(area * cosine, 1e-30f));
}

#endif
