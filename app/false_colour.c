#include "false_colour.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include <stb/stb_image_write.h>

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

static void write_base64(void *context, void *data, int size) {
    static const char DIGITS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const uint8_t *bytes = data;
    FILE *file = context;
    for (int i = 0; i < size; i += 3) {
        int left = size - i;
        uint32_t word = (uint32_t)bytes[i] << 16;
        if (left > 1) word |= (uint32_t)bytes[i + 1] << 8;
        if (left > 2) word |= bytes[i + 2];
        fputc(DIGITS[word >> 18], file);
        fputc(DIGITS[word >> 12 & 63], file);
        fputc(left > 1 ? DIGITS[word >> 6 & 63] : '=', file);
        fputc(left > 2 ? DIGITS[word & 63] : '=', file);
    }
}

bool lobe_app_write_false_colour(FILE *file, const float *values, int size, lobe_app_ramp ramp,
                                 float most) {
    uint8_t *pixels = calloc((size_t)size * (size_t)size, 4);
    if (!pixels) return false;
    for (int i = 0; i < size * size; ++i) paint(pixels + 4 * i, values[i], ramp, most);
    fputs("data:image/png;base64,", file);
    /* The writer hands over the whole file in one call, so the padding stands at its end. */
    const int is_good = stbi_write_png_to_func(write_base64, file, size, size, 4, pixels, 4 * size);
    free(pixels);
    return is_good != 0;
}
