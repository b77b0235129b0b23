/* lobe/rays.h: single rays through a scene (lobe/render.h): what they meet, and the light along them. Made for
 * G-buffers, and for judging what screen-space methods guess.
 *
 * Directions have unit length. Everything but create and free may be called by several threads at once; the
 * scene must outlive the handle. */
#ifndef LOBE_RAYS_H
#define LOBE_RAYS_H

#include "render.h"

LOBE_BEGIN_C

typedef struct lobe_rays lobe_rays;

/* *rays is to be freed by lobe_rays_free after LOBE_RENDER_OK; otherwise it is NULL. */
LOBE_API lobe_render_result lobe_rays_create(const lobe_scene *scene, lobe_rays **rays);
LOBE_API void lobe_rays_free(lobe_rays *rays); /* NULL is fine */

/* A place of a surface by the numbers of its scene. Scenes of the same file and options at two moments have the same
 * numbers, so it names the same place of a surface that moves or bends. */
typedef struct lobe_ray_place {
    uint32_t corner[3]; /* vertices of the triangle */
    uint32_t instance;  /* UINT32_MAX: none */
    float u, v;         /* shares of the second and the third corner */
} lobe_ray_place;

/* A place of a surface; the normals are turned to the side that the ray comes from. */
typedef struct lobe_ray_surface {
    float distance;
    lobe_vec3_f32 position;
    lobe_vec3_f32 normal;    /* shading, with the normal map: may face away from the ray */
    lobe_vec3_f32 geometric; /* of the triangle */
    lobe_vec3_f32 f0;        /* reflectance at normal incidence */
    float roughness;         /* perceptual; of an anisotropic surface the one of the mean alpha */
    float
        anisotropy; /* alpha is roughness^2 (1 + anisotropy) along the tangent, (1 - anisotropy) across */
    lobe_vec3_f32 tangent; /* unit, across the shading normal */
    lobe_ray_place place;
} lobe_ray_surface;

/* The first surface; of those that let light through by their alpha, what stops half of it counts. 0: none. */
LOBE_API int lobe_rays_meet(const lobe_rays *rays, lobe_vec3_f32 origin, lobe_vec3_f32 direction,
                            lobe_ray_surface *surface);

/* Where a place of `from` is in another scene of the same file and options. Of the same scene, and of what has not moved, it
 * is the position to the bit. 0: the scenes have not the same parts, or the place is not finite; a shape of many
 * instances that shrinks to nothing is the one part that can be missing at a moment. */
LOBE_API int lobe_rays_find(const lobe_rays *rays, const lobe_rays *from,
                            const lobe_ray_place *place, lobe_vec3_f32 *position);

/* One path-traced sample of the radiance that arrives at `origin` against `direction`. (seed, stream) names
 * the place, index the sample there, one of `samples`: the same numbers give the same bits. */
LOBE_API lobe_vec3_f32 lobe_rays_light(const lobe_rays *rays, lobe_vec3_f32 origin,
                                       lobe_vec3_f32 direction, uint64_t seed, uint64_t stream,
                                       uint32_t index, uint32_t samples);

/* The light of the environment from a direction; 0 where a scene has none. */
LOBE_API lobe_vec3_f32 lobe_rays_environment(const lobe_rays *rays, lobe_vec3_f32 direction);

LOBE_END_C

#endif
