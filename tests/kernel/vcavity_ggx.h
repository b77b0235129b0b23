/* tests/kernel/vcavity_ggx.h: what tests/kernel/vcavity_template.h needs of GGX, in double. */
#include "kernel/ggx_vcavity.h"
#include "kernel/ggx_vcavity_ndf.h"
#include "kernel/ggx_vcavity_valid.h"

#define NDF(stem) ggx_##stem
#define DEEP_CASE                                                                                  \
    { 0.2, 0.2, 165, 80 }
#define SPREAD 1
#define ACROSS_WIDTH(across, a) ((across) / cos(a))

static double distribution_d(const double m[3], double ax, double ay) {
    double x = m[0] / ax, y = m[1] / ay, e = x * x + y * y + m[2] * m[2];
    return 1 / (3.14159265358979323846 * ax * ay * e * e);
}

static double area_within(double s2) {
    return s2 / (1 + s2);
}

static double slope2_of(double area) {
    return area / (1 - area);
}

/* alpha_x, alpha_y, theta; rejected and variance of vcavity and vcavity_valid */
static const double oracle_rows[][7] = {
    {0.1, 0.1, 5, 0.010, 0.009, 0.0145, 0.0145},  {0.1, 0.1, 40, 0.010, 0.004, 0.0156, 0.0119},
    {0.1, 0.1, 60, 0.013, 0.002, 0.0200, 0.0117}, {0.1, 0.1, 75, 0.025, 0.001, 0.0374, 0.0161},
    {0.1, 0.1, 87, 0.028, 0.000, 0.0360, 0.0109}, {0.3, 0.3, 5, 0.082, 0.075, 0.1291, 0.1290},
    {0.3, 0.3, 40, 0.074, 0.035, 0.1220, 0.0922}, {0.3, 0.3, 60, 0.068, 0.020, 0.1052, 0.0614},
    {0.3, 0.3, 75, 0.054, 0.010, 0.0765, 0.0358}, {0.3, 0.3, 87, 0.014, 0.002, 0.0182, 0.0080},
    {0.5, 0.5, 5, 0.200, 0.183, 0.3524, 0.3520},  {0.5, 0.5, 40, 0.159, 0.091, 0.2878, 0.2185},
    {0.5, 0.5, 60, 0.112, 0.052, 0.1857, 0.1235}, {0.5, 0.5, 75, 0.064, 0.026, 0.0956, 0.0608},
    {0.5, 0.5, 87, 0.013, 0.005, 0.0186, 0.0120}, {1, 1, 5, 0.498, 0.472, 1.3621, 1.3598},
    {1, 1, 40, 0.358, 0.278, 0.8616, 0.6902},     {1, 1, 60, 0.216, 0.167, 0.4233, 0.3545},
    {1, 1, 75, 0.108, 0.083, 0.1805, 0.1576},     {1, 1, 87, 0.022, 0.017, 0.0318, 0.0285},
    {0.1, 1, 5, 0.295, 0.275, 0.5572, 0.5566},    {0.1, 1, 40, 0.211, 0.134, 0.4100, 0.3125},
    {0.1, 1, 60, 0.107, 0.060, 0.1922, 0.1343},   {0.1, 1, 75, 0.041, 0.017, 0.0639, 0.0413},
    {0.1, 1, 87, 0.005, 0.001, 0.0073, 0.0033},
};
enum { ORACLE_ROWS = sizeof oracle_rows / sizeof oracle_rows[0] };
