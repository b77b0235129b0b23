/* Exposures at which pictures of high dynamic range are compared, and the tone curve. */
#ifndef LOBE_METRICS_TONE_H
#define LOBE_METRICS_TONE_H

#include <stddef.h>

typedef struct tone_range {
    float first, last; /* stops */
    int steps;         /* exposures, both ends among them */
} tone_range;

/* From the exposure that shows the brightest place of the picture to the one that shows its median, both just
 * below white. 0: out of memory. */
int lobe_find_tone_range(const float *rgb, size_t count, tone_range *range);
float lobe_tone_exposure(const tone_range *range, int step);

/* The ACES curve as Narkowicz fitted it (2016), clamped to [0, 1]. */
float lobe_tone(float linear);

#endif
