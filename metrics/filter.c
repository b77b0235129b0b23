#include "filter.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

void lobe_gaussian(float *weights, int radius, double sigma) {
    for (int i = -radius; i <= radius; i++)
        weights[i + radius] = (float)exp(-(double)i * i / (2.0 * sigma * sigma));
}

static int clamp_index(int i, int count) {
    return i < 0 ? 0 : i < count ? i : count - 1;
}

/* One row of `in`, filtered along x. */
static void filter_row(const float *in, int width, const float *weights, int radius, float *out) {
    for (int x = 0; x < width; x++) {
        float sum = 0.0f;
        if (x >= radius && x + radius < width)
            for (int i = -radius; i <= radius; i++) sum += weights[i + radius] * in[x + i];
        else
            for (int i = -radius; i <= radius; i++)
                sum += weights[i + radius] * in[clamp_index(x + i, width)];
        out[x] = sum;
    }
}

/* Row by row, so that the memory is walked in order. */
void lobe_filter_plane(const float *in, int width, int height, const float *row,
                       const float *column, int radius, float *scratch, float *out) {
    const size_t stride = (size_t)width;
    for (int y = 0; y < height; y++)
        filter_row(in + (size_t)y * stride, width, row, radius, scratch + (size_t)y * stride);
    memset(out, 0, stride * (size_t)height * sizeof *out);
    for (int y = 0; y < height; y++)
        for (int j = -radius; j <= radius; j++) {
            const float *line = scratch + (size_t)clamp_index(y + j, height) * stride;
            const float weight = column[j + radius];
            for (int x = 0; x < width; x++) out[(size_t)y * stride + (size_t)x] += weight * line[x];
        }
}
