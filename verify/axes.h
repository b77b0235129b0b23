/* Three-vectors in double, for the charts. */
#ifndef LOBE_VERIFY_AXES_H
#define LOBE_VERIFY_AXES_H

/* Inline: charts call it for every draw. */
static inline double lobe_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void lobe_normalize(double v[3]);

/* Any two axes across the third. */
void lobe_complete_frame(double axis[3][3]);

#endif
