/* app/false_colour.h: numbers on a grid as a picture in a page. */
#ifndef LOBE_APP_FALSE_COLOUR_H
#define LOBE_APP_FALSE_COLOUR_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef enum lobe_app_ramp {
    LOBE_APP_RAMP_AMOUNT,    /* 0 to `most`, dark to light, evenly in the square root */
    LOBE_APP_RAMP_DIFFERENCE /* -most to most, blue through white to red */
} lobe_app_ramp;

/* Red, green, blue, alpha of width x height values, to be freed; NAN is transparent. NULL: out of memory. */
uint8_t *lobe_app_false_colour(const float *values, int width, int height, lobe_app_ramp ramp,
                               float most);

/* Writes size x size values as a PNG in a data URI; NAN is transparent. false: out of memory. */
bool lobe_app_write_false_colour(FILE *file, const float *values, int size, lobe_app_ramp ramp,
                                 float most);

#endif
