/* Filters that are products of a row and a column. */
#ifndef LOBE_METRICS_FILTER_H
#define LOBE_METRICS_FILTER_H

/* exp(-x^2 / (2 sigma^2)) for x = -radius to radius: 2 radius + 1 weights at `weights`. */
void lobe_gaussian(float *weights, int radius, double sigma);

/* out(x, y) = sum over i, j of column[j] row[i] in(x + i, y + j), i and j from -radius to radius; beyond the
 * edge the nearest pixel stands. `scratch` holds a plane too. */
void lobe_filter_plane(const float *in, int width, int height, const float *row,
                       const float *column, int radius, float *scratch, float *out);

#endif
