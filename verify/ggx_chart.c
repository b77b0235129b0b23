#include "ggx_chart.h"

#include <math.h>

#include "axes.h"

/* Largest root of r - x + i_x^2/(x + c_x) + i_y^2/(x + c_y), convex and falling: Newton from a lower
 * bound rises to it. The bound is exact for an isotropic surface. */
static double positive_eigenvalue(const double i[3], const double c[2], double r) {
    double rho2 = i[0] * i[0] + i[1] * i[1];
    double mean = rho2 > 0 ? (i[0] * i[0] * c[0] + i[1] * i[1] * c[1]) / rho2 : 0;
    double half = (r - mean) / 2;
    double root = sqrt((r + mean) * (r + mean) / 4 + rho2);
    double x = half >= 0 ? half + root : (r * mean + rho2) / (root - half);
    for (int step = 0; step < 6; ++step) {
        double p = i[0] / (x + c[0]);
        double q = i[1] / (x + c[1]);
        x += (r - x + p * i[0] + q * i[1]) / (1 + p * p + q * q);
    }
    return x;
}

/* a^T (-Q) b */
static double minus_q(const double i[3], const double c[2], double r, const double a[3],
                      const double b[3]) {
    return c[0] * a[0] * b[0] + c[1] * a[1] * b[1] - r * a[2] * b[2] -
           i[0] * (a[0] * b[2] + a[2] * b[0]) - i[1] * (a[1] * b[2] + a[2] * b[1]);
}

/* Turns the first two axes into eigenvectors of Q and returns the larger eigenvalue of -Q there. */
static double diagonalize(const double i[3], const double c[2], double r, double axis[3][3]) {
    double xx = minus_q(i, c, r, axis[0], axis[0]);
    double xy = minus_q(i, c, r, axis[0], axis[1]);
    double yy = minus_q(i, c, r, axis[1], axis[1]);
    double angle = atan2(2 * xy, xx - yy) / 2;
    double cosine = cos(angle);
    double sine = sin(angle);
    for (int k = 0; k < 3; ++k) {
        double first = axis[0][k];
        double second = axis[1][k];
        axis[0][k] = cosine * first + sine * second;
        axis[1][k] = cosine * second - sine * first;
    }
    double difference = (xx - yy) / 2;
    return (xx + yy) / 2 + sqrt(difference * difference + xy * xy);
}

lobe_ggx_chart lobe_ggx_chart_prepare(const double wi[3], double alpha_x, double alpha_y) {
    lobe_ggx_chart ggx = {.alpha = {alpha_x, alpha_y}, .wi = {wi[0], wi[1], wi[2]}};
    double i[3] = {alpha_x * wi[0], alpha_y * wi[1], wi[2]};
    ggx.length = sqrt(lobe_dot(i, i));
    lobe_normalize(i);
    double front = fmax(i[2], 0);
    double c[2] = {front * alpha_x * alpha_x, front * alpha_y * alpha_y};
    double r = 2 * i[2] - front;
    ggx.lambda = positive_eigenvalue(i, c, r);
    double *n = ggx.axis[2];
    n[0] = i[0] / (ggx.lambda + c[0]);
    n[1] = i[1] / (ggx.lambda + c[1]);
    n[2] = 1;
    lobe_normalize(n);
    lobe_complete_frame(ggx.axis);
    double larger = diagonalize(i, c, r, ggx.axis);
    /* By the determinant: the difference of the two would cancel. */
    double smaller =
        (c[0] * c[1] * r + c[0] * i[1] * i[1] + c[1] * i[0] * i[0]) / (ggx.lambda * larger);
    ggx.nu = (ggx.lambda - r + i[2]) * n[2];
    double minor[2] = {larger, larger > 0 ? fmax(smaller, 0) : 0};
    for (int k = 0; k < 2; ++k) {
        ggx.half_axis[k] = sqrt(ggx.lambda / (ggx.lambda + minor[k]));
        ggx.gap[k] = minor[k] / (ggx.lambda + minor[k]);
        ggx.inverse_alpha[k] = 1 / ggx.alpha[k];
        ggx.inverse_half_axis[k] = 1 / ggx.half_axis[k];
        ggx.slant[k] = ggx.half_axis[k] * lobe_dot(i, ggx.axis[k]) / ggx.nu;
    }
    return ggx;
}

static double ggx_direction(const void *self, lobe_disk_point point, double wo[3]) {
    const lobe_ggx_chart *ggx = self;
    double v = point.w * point.w;
    double z = sqrt(v + ggx->gap[0] * point.x * point.x + ggx->gap[1] * point.y * point.y);
    double a = ggx->half_axis[0];
    double b = ggx->half_axis[1];
    double m[3];
    for (int k = 0; k < 3; ++k) {
        m[k] = a * point.x * ggx->axis[0][k] + b * point.y * ggx->axis[1][k] + z * ggx->axis[2][k];
    }
    m[0] *= ggx->alpha[0];
    m[1] *= ggx->alpha[1];
    double length2 = lobe_dot(m, m);
    double lift = (ggx->slant[0] * point.x + ggx->slant[1] * point.y) / z;
    double i_m = ggx->nu * z * fmax(1 + lift, 0); /* stretched i . m */
    for (int k = 0; k < 2; ++k) wo[k] = 2 * ggx->length * i_m / length2 * m[k] - ggx->wi[k];
    /* The same as 2 (i.m) m_z - i_z, without its cancellation at the horizon. */
    wo[2] = ggx->length * ggx->lambda * v / length2 - fmin(ggx->wi[2], 0);
    /* Four Jacobians: reflection 4 i.m; stretch alpha_x alpha_y / |A m|^3; disk a b / z. */
    return 4 * ggx->length * ggx->alpha[0] * ggx->alpha[1] * a * b * ggx->nu * fmax(1 + lift, 0) /
           (length2 * length2);
}

static int ggx_point(const void *self, const double wo[3], lobe_disk_point *point) {
    const lobe_ggx_chart *ggx = self;
    double m[3] = {(ggx->wi[0] + wo[0]) * ggx->inverse_alpha[0],
                   (ggx->wi[1] + wo[1]) * ggx->inverse_alpha[1], ggx->wi[2] + wo[2]};
    double length = sqrt(lobe_dot(m, m));
    if (!(length > 0) || !(m[2] >= 0)) return 0;
    double x = lobe_dot(m, ggx->axis[0]) * ggx->inverse_half_axis[0] / length;
    double y = lobe_dot(m, ggx->axis[1]) * ggx->inverse_half_axis[1] / length;
    /* A direction rounded to just outside belongs to the edge. */
    double v = fmax(1 - x * x - y * y, 0);
    *point = (lobe_disk_point){x, y, sqrt(v)};
    return 1;
}

lobe_verify_chart lobe_ggx_chart_view(const lobe_ggx_chart *ggx) {
    return (lobe_verify_chart){ggx, ggx_direction, ggx_point};
}

double lobe_ggx_chart_visible_share(const lobe_ggx_chart *ggx) {
    double i_z = ggx->wi[2] / ggx->length;
    double x = ggx->alpha[0] * ggx->wi[0] / ggx->length;
    double y = ggx->alpha[1] * ggx->wi[1] / ggx->length;
    /* Below the surface 1 + i_z cancels: take the squared sine over 1 - i_z instead. */
    double cap = i_z < 0 ? (x * x + y * y) / (1 - i_z) : 1 + i_z;
    return 2 * ggx->half_axis[0] * ggx->half_axis[1] * ggx->nu / cap;
}
