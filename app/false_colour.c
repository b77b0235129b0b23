#include "false_colour.h"

#include <math.h>
#include <stdlib.h>

#include "page.h"

typedef struct colour {
    float red, green, blue;
} colour;

/* Evenly spaced along each ramp; lightness rises along the first. */
static const colour AMOUNT[] = {{14, 16, 48},   {52, 38, 118},  {112, 48, 140},  {178, 62, 120},
                                {226, 100, 86}, {248, 158, 70}, {252, 220, 116}, {255, 252, 216}};
static const colour DIFFERENCE[] = {{10, 54, 120},   {64, 132, 198},  {160, 200, 226},
                                    {246, 246, 246}, {244, 182, 150}, {212, 88, 70},
                                    {124, 12, 36}};
enum {
    AMOUNTS = sizeof AMOUNT / sizeof *AMOUNT,
    DIFFERENCES = sizeof DIFFERENCE / sizeof *DIFFERENCE
};

/* x in [0, 1] along the colours. */
static colour mix(const colour *colours, int count, float x) {
    float at = fminf(fmaxf(x, 0), 1) * (float)(count - 1);
    int i = (int)at < count - 2 ? (int)at : count - 2;
    float part = at - (float)i;
    colour a = colours[i], b = colours[i + 1];
    return (colour){a.red + part * (b.red - a.red), a.green + part * (b.green - a.green),
                    a.blue + part * (b.blue - a.blue)};
}

static void paint(uint8_t *pixel, float value, lobe_app_ramp ramp, float most) {
    if (isnan(value)) return; /* stays transparent */
    float x = most > 0 ? value / most : 0;
    colour c = ramp == LOBE_APP_RAMP_AMOUNT ? mix(AMOUNT, AMOUNTS, sqrtf(fmaxf(x, 0)))
                                            : mix(DIFFERENCE, DIFFERENCES, (x + 1) / 2);
    pixel[0] = (uint8_t)(c.red + 0.5f);
    pixel[1] = (uint8_t)(c.green + 0.5f);
    pixel[2] = (uint8_t)(c.blue + 0.5f);
    pixel[3] = 255;
}

uint8_t *lobe_app_false_colour(const float *values, int width, int height, lobe_app_ramp ramp,
                               float most) {
    const size_t count = (size_t)width * (size_t)height;
    uint8_t *pixels = calloc(count, 4);
    for (size_t i = 0; pixels && i < count; ++i) paint(pixels + 4 * i, values[i], ramp, most);
    return pixels;
}

bool lobe_app_write_false_colour(FILE *file, const float *values, int size, lobe_app_ramp ramp,
                                 float most) {
    uint8_t *pixels = lobe_app_false_colour(values, size, size, ramp, most);
    const bool is_good = pixels && lobe_app_write_png_uri(file, pixels, size, size, 4);
    free(pixels);
    return is_good;
}
