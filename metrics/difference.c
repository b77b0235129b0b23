/* Errors that are sums over pixels. */
#include <math.h>

#include "lobe/metrics.h"

double lobe_relative_scale(double reference) {
    return reference * reference + 0.01;
}

lobe_picture_difference lobe_compare_pictures(const float *picture, const float *reference,
                                              size_t count) {
    const size_t values = 3 * count;
    lobe_picture_difference d = {0};
    double squares = 0.0;
    for (size_t i = 0; i < values; i++) {
        const double a = picture[i], b = reference[i];
        const double square = (a - b) * (a - b);
        squares += square;
        d.relative_mse += square / lobe_relative_scale(b);
        d.mean += a;
        d.mean_reference += b;
        d.largest = fmax(d.largest, fabs(a - b));
    }
    d.rmse = sqrt(squares / (double)values);
    d.relative_mse /= (double)values;
    d.mean /= (double)values;
    d.mean_reference /= (double)values;
    return d;
}
