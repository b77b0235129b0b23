/* lobe/walk.h: all scatterings on a Smith microsurface, GGX or Beckmann, by a random walk (Heitz et al. 2016).
 *
 *     lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, 0.5, 0.5};
 *     double weight;
 *     lobe_walk w = lobe_walk_sample(s, &f, 1, wi, seed, k, 1000, &weight);   // the k-th walk
 *     if (w.bounces) light += weight * radiance_from(w.wo);
 *
 * The truth that the approximations of lobe/albedo.h are measured against: unbiased, draws in
 * proportion to f cos of F = 1 summed over all scatterings. Walks of one bounce are the model of
 * lobe/reflection.h with the height-correlated G2. A walk has no density, but its value can be
 * estimated: for a lamp in direction wo
 *
 *     lobe_walk_eval(s, &f, 1, wi, wo, seed, k, 1000, &value);     // f cos, all scatterings
 *     light += value * radiance / pdf_of_the_lamp;
 *
 * In multiple importance sampling any density stands in for the missing one, as long as both
 * strategies take the same: that of the first scattering and a cosine will do. */
#ifndef LOBE_WALK_H
#define LOBE_WALK_H

#include "albedo.h"

LOBE_BEGIN_C

typedef struct lobe_walk {
    lobe_vec3_f64 wo; /* where the walk leaves, above the surface */
    int bounces;      /* scatterings until then; 0: it was cut */
} lobe_walk;

/* The walk of number `index` of `seed`. `weights`: for each of `count` laws the product of its
 * reflectances along the walk; 0 where it was cut: after `most` bounces, or because the microsurface
 * (only Smith has a random walk; g2 is not read) or wi is unusable. wi: unit, above the surface. */
LOBE_API lobe_walk lobe_walk_sample(lobe_microsurface s, const lobe_reflectance *f, int count,
                                    lobe_vec3_f64 wi, uint64_t seed, uint64_t index, int most,
                                    double *weights);

/* An unbiased estimate of f |wo.z| for each of `count` <= 64 laws, scatterings up to the `most`-th: the first
 * one exactly, the others by one walk from wi, which at each facet looks toward wo. It has no
 * correlation with the walk of lobe_walk_sample of another seed or index. 0, and values of 0, for what
 * lobe_walk_sample refuses and for a wo that is not above the surface; else 1. */
LOBE_API int lobe_walk_eval(lobe_microsurface s, const lobe_reflectance *f, int count,
                            lobe_vec3_f64 wi, lobe_vec3_f64 wo, uint64_t seed, uint64_t index,
                            int most, double *values);

/* A rough dielectric: a facet reflects with the chance of Fresnel's factor, else the walk goes on on the other
 * side of the surface. `ior`: inside over outside, 1e-3 to 1e3. wi and wo above: outside, below: inside.
 * Every walk carries all of the light. Those of one bounce are lobe/dielectric.h for importance, with the
 * height-correlated G2. */
LOBE_API lobe_walk lobe_walk_dielectric_sample(lobe_microsurface s, double ior, lobe_vec3_f64 wi,
                                               uint64_t seed, uint64_t index, int most);

/* An unbiased estimate of what these walks scatter to wo, above or below, per steradian, as lobe_walk_eval has
 * it of a conductor: over the sphere it adds up to 1. Equal indices let light pass straight: 0. Radiance that
 * crosses the surface is multiplied by the square of the index of the side of wi over that of the other. */
LOBE_API int lobe_walk_dielectric_eval(lobe_microsurface s, double ior, lobe_vec3_f64 wi,
                                       lobe_vec3_f64 wo, uint64_t seed, uint64_t index, int most,
                                       double *value);

LOBE_END_C

#endif
