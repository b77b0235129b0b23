#include "tone.h"

#include <math.h>
#include <stdlib.h>

/* (k[0] x^2 + k[1] x) / (k[2] x^2 + k[3] x + k[4]), of x = 0.6 times the linear value. */
static const double curve[5] = {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};

static const double white_share = 0.85; /* what "just below white" is */

float lobe_tone(float linear) {
    const float x = linear;
    const float above = (float)curve[0] * x * x + (float)curve[1] * x;
    const float below = (float)curve[2] * x * x + (float)curve[3] * x + (float)curve[4];
    const float tone = isinf(below) ? 1.0f : above / below;
    return fminf(fmaxf(tone, 0.0f), 1.0f);
}

/* The linear value that the curve maps to white_share. */
static double near_white(void) {
    const double a = curve[0] - white_share * curve[2], b = curve[1] - white_share * curve[3],
                 c = -white_share * curve[4];
    return (-b + sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

static int by_value(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Luminance of black would ask for an endless exposure. */
static double exposure_of(double luminance) {
    return log2(near_white() / fmax(luminance, 1e-5));
}

int lobe_find_tone_range(const float *rgb, size_t count, tone_range *range) {
    float *luminance = malloc(count * sizeof *luminance);
    if (!luminance) return 0;
    for (size_t i = 0; i < count; i++)
        luminance[i] =
            fmaxf(0.2126f * rgb[3 * i] + 0.7152f * rgb[3 * i + 1] + 0.0722f * rgb[3 * i + 2], 0.0f);
    qsort(luminance, count, sizeof *luminance, by_value);
    const double median = 0.5 * ((double)luminance[(count - 1) / 2] + (double)luminance[count / 2]);
    range->first = (float)exposure_of((double)luminance[count - 1]);
    range->last = (float)exposure_of(median);
    range->steps = (int)fmax(2.0, ceil((double)(range->last - range->first)));
    free(luminance);
    return 1;
}

float lobe_tone_exposure(const tone_range *range, int step) {
    return range->first + (range->last - range->first) * (float)step / (float)(range->steps - 1);
}
