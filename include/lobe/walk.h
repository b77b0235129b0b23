/* lobe/walk.h: all scatterings on a Smith microsurface, by a random walk (Heitz et al. 2016).
 *
 *     lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, 0.5, 0.5};
 *     double weight;
 *     lobe_walk w = lobe_walk_sample(s, &f, 1, wi, seed, k, 1000, &weight);   // the k-th walk
 *     if (w.bounces) light += weight * radiance_from(w.wo);
 *
 * The truth that the approximations of lobe/albedo.h are measured against: unbiased, draws in
 * proportion to f cos of F = 1 summed over all scatterings. Walks of one bounce are the model of
 * lobe/reflection.h with the height-correlated G2. It draws; it has no density. */
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

LOBE_END_C

#endif
