/* lobe/metrics.h: how far a picture is from another one.
 *
 * A picture is width * height * 3 floats, rows from the top: linear RGB with the primaries of sRGB. No
 * value may be NaN or infinite. Functions may be called from any thread. */
#ifndef LOBE_METRICS_H
#define LOBE_METRICS_H

#include <stddef.h>

#include "types.h"

LOBE_BEGIN_C

typedef struct lobe_picture_difference {
    double rmse;           /* root of the mean squared difference of all values */
    double relative_mse;   /* mean of lobe_relative_square */
    double mean;           /* of all values of the picture, */
    double mean_reference; /* and of the reference */
    double largest;        /* greatest absolute difference */
} lobe_picture_difference;

/* What a squared difference is divided by, so that dark places count as much as bright ones:
 * reference^2 + 0.01. */
LOBE_API double lobe_relative_scale(double reference);

/* Of `count` pixels, three values each. */
LOBE_API lobe_picture_difference lobe_compare_pictures(const float *picture, const float *reference,
                                                       size_t count);

/* FLIP: the difference that a person sees who flips between the two pictures, pixel by pixel, 0 (none) to
 * 1. LDR: Andersson et al. 2020, of what a screen shows: values are clamped to [0, 1]. HDR: Andersson et
 * al. 2021, the greatest LDR-FLIP over exposures, which follow from the reference, through the ACES tone
 * curve. Both agree with the authors' program (version 1.7) to 2e-5 in the mean. */
typedef enum lobe_flip_range { LOBE_FLIP_LDR, LOBE_FLIP_HDR } lobe_flip_range;

/* Pixels a degree of visual angle of a 4K screen 0.7 m wide, 0.7 m away. */
#define LOBE_FLIP_PIXELS_PER_DEGREE 67.0206f

/* Writes width * height values to `map` (NULL: not wanted) and their mean to *mean. Sizes: 1 to 32768 each;
 * pixels_per_degree: 1 to 1000. 0: out of memory. */
LOBE_API int lobe_flip(const float *picture, const float *reference, int width, int height,
                       lobe_flip_range range, float pixels_per_degree, float *map, double *mean);

LOBE_END_C

#endif
