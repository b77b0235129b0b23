/* Three-vectors in double, for the charts. */
#ifndef LOBE_VERIFY_AXES_H
#define LOBE_VERIFY_AXES_H

double lobe_dot(const double a[3], const double b[3]);
void lobe_normalize(double v[3]);

/* Any two axes across the third. */
void lobe_complete_frame(double axis[3][3]);

#endif
