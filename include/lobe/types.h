/* lobe/types.h: what every other header of lobe shares.
 *
 * Frame: local, z is the shading normal, x and y are the directions of alpha_x and alpha_y.
 * Directions: `wi` points toward the viewer, `wo` is the reflected (sampled) direction; both point
 * away from the surface and have unit length. Either may lie below the surface (z < 0).
 * Roughness: `alpha` is the roughness of the distribution (perceptual roughness squared).
 * Random numbers: u in [0, 1). 1, values outside and NaN are clamped into the range.
 * Densities are per steradian. `pdf > 0` if and only if the sample is valid; never negative or NaN.
 *
 * Functions come in pairs with the suffixes _f32 and _f64: one text, two precisions. They are pure,
 * allocate nothing, keep no state and may be called from any thread.
 * Not promised: which direction a given (u1, u2) maps to, from version to version. The
 * distributions are. */
#ifndef LOBE_TYPES_H
#define LOBE_TYPES_H

#include <stdint.h>

#if defined(_WIN32)
#define LOBE_API
#elif defined(__GNUC__)
#define LOBE_API __attribute__((visibility("default")))
#else
#define LOBE_API
#endif

#ifdef __cplusplus
#define LOBE_BEGIN_C extern "C" {
#define LOBE_END_C }
#else
#define LOBE_BEGIN_C
#define LOBE_END_C
#endif

typedef struct lobe_vec3_f32 {
    float x, y, z;
} lobe_vec3_f32;

typedef struct lobe_vec3_f64 {
    double x, y, z;
} lobe_vec3_f64;

#endif
