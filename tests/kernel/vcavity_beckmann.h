/* tests/kernel/vcavity_beckmann.h: what tests/kernel/vcavity_template.h needs of Beckmann, in double. */
#include "kernel/beckmann_vcavity.h"
#include "kernel/beckmann_vcavity_ndf.h"
#include "kernel/beckmann_vcavity_valid.h"

#include <math.h>

#define NDF(stem) beckmann_##stem
#define DEEP_CASE                                                                                  \
    { 0.5, 0.5, 150, 80 }
#define SPREAD 2
#define ACROSS_WIDTH(across, a) (3 * (across))

static double distribution_d(const double m[3], double ax, double ay) {
    double x = m[0] / ax, y = m[1] / ay, z2 = m[2] * m[2];
    return exp(-(x * x + y * y) / z2) / (3.14159265358979323846 * ax * ay * z2 * z2);
}

static double area_within(double s2) {
    return -expm1(-s2);
}

static double slope2_of(double area) {
    return -log1p(-area);
}

/* alpha_x, alpha_y, theta; rejected and variance of vcavity and vcavity_valid */
static const double oracle_rows[][7] = {
    {0.1, 0.1, 5, 0.000, 0.000, 0.0000, 0.0000},  {0.1, 0.1, 40, 0.000, 0.000, 0.0000, 0.0000},
    {0.1, 0.1, 60, 0.000, 0.000, 0.0003, 0.0003}, {0.1, 0.1, 75, 0.013, 0.000, 0.0230, 0.0122},
    {0.1, 0.1, 87, 0.033, 0.000, 0.0420, 0.0120}, {0.3, 0.3, 5, 0.000, 0.000, 0.0014, 0.0014},
    {0.3, 0.3, 40, 0.010, 0.000, 0.0231, 0.0154}, {0.3, 0.3, 60, 0.044, 0.000, 0.0662, 0.0264},
    {0.3, 0.3, 75, 0.051, 0.000, 0.0684, 0.0203}, {0.3, 0.3, 87, 0.013, 0.000, 0.0166, 0.0051},
    {0.5, 0.5, 5, 0.019, 0.011, 0.0713, 0.0712},  {0.5, 0.5, 40, 0.066, 0.001, 0.1141, 0.0582},
    {0.5, 0.5, 60, 0.073, 0.001, 0.1066, 0.0378}, {0.5, 0.5, 75, 0.045, 0.000, 0.0607, 0.0209},
    {0.5, 0.5, 87, 0.010, 0.000, 0.0122, 0.0045}, {1, 1, 5, 0.365, 0.327, 0.9134, 0.9111},
    {1, 1, 40, 0.207, 0.095, 0.4778, 0.3279},     {1, 1, 60, 0.108, 0.043, 0.1979, 0.1381},
    {1, 1, 75, 0.051, 0.019, 0.0830, 0.0602},     {1, 1, 87, 0.010, 0.004, 0.0153, 0.0114},
    {0.1, 1, 5, 0.158, 0.133, 0.3034, 0.3030},    {0.1, 1, 40, 0.104, 0.013, 0.2073, 0.1199},
    {0.1, 1, 60, 0.057, 0.000, 0.0825, 0.0268},   {0.1, 1, 75, 0.027, 0.000, 0.0338, 0.0097},
    {0.1, 1, 87, 0.005, 0.000, 0.0064, 0.0019},
};
enum { ORACLE_ROWS = sizeof oracle_rows / sizeof oracle_rows[0] };
