#include "axes.h"

#include <math.h>

void lobe_normalize(double v[3]) {
    double length = sqrt(lobe_dot(v, v));
    for (int i = 0; i < 3; ++i) v[i] /= length;
}

void lobe_complete_frame(double axis[3][3]) {
    const double *n = axis[2];
    int least = fabs(n[0]) < fabs(n[1]) ? 0 : 1;
    double other[3] = {0, 0, 0};
    other[least] = 1;
    double along = lobe_dot(other, n);
    for (int i = 0; i < 3; ++i) axis[0][i] = other[i] - along * n[i];
    lobe_normalize(axis[0]);
    axis[1][0] = n[1] * axis[0][2] - n[2] * axis[0][1];
    axis[1][1] = n[2] * axis[0][0] - n[0] * axis[0][2];
    axis[1][2] = n[0] * axis[0][1] - n[1] * axis[0][0];
}
