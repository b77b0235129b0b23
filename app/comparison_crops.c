/* Where the contenders differ most. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "comparison.h"

static int by_value(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

float lobe_app_quantile(const float *values, size_t count, double share) {
    float *sorted = malloc(count * sizeof *sorted);
    if (!sorted) return INFINITY;
    memcpy(sorted, values, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, by_value);
    const float value = sorted[(size_t)(share * (double)(count - 1))];
    free(sorted);
    return value;
}

static double error_within(const lobe_app_comparison *c, const lobe_app_cell *cell,
                           lobe_app_crop crop, float most) {
    double sum = 0;
    for (int y = crop.y; y < crop.y + crop.size; y++)
        for (int x = crop.x; x < crop.x + crop.size; x++)
            sum += fmin(cell->relative[y * c->width + x], most);
    return sum / cell->count;
}

/* Greatest minus least error of the contenders; the error itself if there is one only. */
static double spread(const lobe_app_comparison *c, int size, lobe_app_crop crop,
                     const float *most) {
    double least = INFINITY, greatest = -INFINITY;
    for (int m = 0; m < c->contenders; m++) {
        const lobe_app_cell *cell = &c->cell[m][size];
        if (!cell->count) continue;
        const double error = error_within(c, cell, crop, most[m]);
        least = fmin(least, error);
        greatest = fmax(greatest, error);
    }
    return greatest > least ? greatest - least : greatest;
}

static bool overlaps(lobe_app_crop a, const lobe_app_crop *others, int count) {
    for (int i = 0; i < count; i++)
        if (abs(a.x - others[i].x) < a.size && abs(a.y - others[i].y) < a.size) return true;
    return false;
}

int lobe_app_find_crops(const lobe_app_comparison *c, int size, lobe_app_crop *crops, int most) {
    const int shorter = c->width < c->height ? c->width : c->height;
    const int side = shorter < 32 ? shorter : (int)fmin(fmax(shorter / 6, 32), 96);
    const int step = side > 3 ? side / 4 : 1;
    const size_t pixels = (size_t)c->width * (size_t)c->height;
    float limits[LOBE_APP_CONTENDERS_MAX] = {0};
    for (int m = 0; m < c->contenders; m++)
        if (c->cell[m][size].count) /* one bright pixel makes no place */
            limits[m] = lobe_app_quantile(c->cell[m][size].relative, pixels, 0.999);
    int count = 0;
    for (; count < most; count++) {
        double best = 0;
        for (int y = 0; y + side <= c->height; y += step)
            for (int x = 0; x + side <= c->width; x += step) {
                const lobe_app_crop crop = {x, y, side};
                if (overlaps(crop, crops, count)) continue;
                const double value = spread(c, size, crop, limits);
                if (!(value > best)) continue;
                best = value;
                crops[count] = crop;
            }
        if (!(best > 0)) break;
    }
    return count;
}
