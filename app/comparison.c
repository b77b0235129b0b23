/* What is kept of each picture. */
#include "comparison.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/metrics.h>

static size_t values_of(const lobe_app_comparison *c) {
    return 3 * (size_t)c->width * (size_t)c->height;
}

void lobe_app_free_comparison(lobe_app_comparison *c) {
    for (int m = 0; m < LOBE_APP_CONTENDERS_MAX; m++)
        for (int n = 0; n < LOBE_APP_SIZES_MAX; n++) {
            lobe_app_cell *cell = &c->cell[m][n];
            free(cell->rgb);
            free(cell->flip);
            free(cell->relative);
            free(cell->sum);
            free(cell->product);
            *cell = (lobe_app_cell){0};
        }
    if (c->half[1] != c->half[0]) free(c->half[1]);
    free(c->half[0]);
    free(c->reference);
    c->half[0] = c->half[1] = c->reference = NULL;
}

bool lobe_app_set_reference(lobe_app_comparison *c) {
    c->reference = malloc(values_of(c) * sizeof *c->reference);
    for (size_t i = 0; c->reference && i < values_of(c); i++)
        c->reference[i] = 0.5f * c->half[0][i] + 0.5f * c->half[1][i];
    return c->reference != NULL;
}

double lobe_app_reference_noise(const lobe_app_comparison *c) {
    double squares = 0;
    for (size_t i = 0; i < values_of(c); i++) {
        const double d = 0.5 * ((double)c->half[0][i] - (double)c->half[1][i]);
        squares += d * d;
    }
    return sqrt(squares / (double)values_of(c));
}

/* What a screen shows: the exposure applied. NULL: out of memory. */
static float *exposed(const lobe_app_comparison *c, const float *rgb) {
    float *shown = malloc(values_of(c) * sizeof *shown);
    const float scale = exp2f((float)c->exposure);
    for (size_t i = 0; shown && i < values_of(c); i++) shown[i] = rgb[i] * scale;
    return shown;
}

static bool measure_flip(const lobe_app_comparison *c, const float *rgb, float *map, double *flip) {
    float *a = exposed(c, rgb), *b = exposed(c, c->reference);
    const bool is_good =
        a && b &&
        lobe_flip(a, b, c->width, c->height, LOBE_FLIP_LDR, LOBE_FLIP_PIXELS_PER_DEGREE, map, flip);
    free(a);
    free(b);
    return is_good;
}

static bool make_room(const lobe_app_comparison *c, lobe_app_cell *cell, bool has_floor) {
    const size_t values = values_of(c), pixels = values / 3;
    cell->rgb = malloc(values * sizeof *cell->rgb);
    cell->flip = malloc(pixels * sizeof *cell->flip);
    cell->relative = calloc(pixels, sizeof *cell->relative);
    if (has_floor) {
        cell->sum = calloc(values, sizeof *cell->sum);
        cell->product = calloc(values, sizeof *cell->product);
    }
    return cell->rgb && cell->flip && cell->relative &&
           (!has_floor || (cell->sum && cell->product));
}

static bool keep_first(const lobe_app_comparison *c, lobe_app_cell *cell, const float *rgb) {
    memcpy(cell->rgb, rgb, values_of(c) * sizeof *rgb);
    return lobe_flip(rgb, c->reference, c->width, c->height, LOBE_FLIP_HDR,
                     LOBE_FLIP_PIXELS_PER_DEGREE, NULL, &cell->flip_hdr) != 0;
}

/* The halves are independent: (x - A) (x - B) has the squared error against the truth as its mean, while
 * (x - reference)^2 had the noise of the reference added. */
static void add_errors(const lobe_app_comparison *c, lobe_app_cell *cell, const float *rgb,
                       lobe_app_measurement *measured) {
    const size_t values = values_of(c);
    for (size_t i = 0; i < values; i++) {
        const double x = (double)rgb[i];
        const double product = (x - (double)c->half[0][i]) * (x - (double)c->half[1][i]);
        const double relative = product / lobe_relative_scale((double)c->reference[i]);
        measured->mse += product / (double)values;
        measured->relmse += relative / (double)values;
        cell->relative[i / 3] += (float)(relative / 3);
        if (!cell->sum) continue;
        cell->sum[i] += x;
        cell->product[i] += product;
    }
}

bool lobe_app_add_picture_to(lobe_app_comparison *c, int contender, int size, const float *rgb,
                             lobe_app_measurement measured) {
    lobe_app_cell *cell = &c->cell[contender][size];
    const bool is_first = cell->count == 0;
    if (is_first && (!make_room(c, cell, size == c->sizes - 1) || !keep_first(c, cell, rgb)))
        return false;
    if (!measure_flip(c, rgb, is_first ? cell->flip : NULL, &measured.flip)) return false;
    add_errors(c, cell, rgb, &measured);
    cell->runs[cell->count++] = measured;
    return true;
}
