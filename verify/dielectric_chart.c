#include "dielectric_chart.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalize(double v[3]) {
    double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; ++k) v[k] /= length;
}

/* Heitz 2018: the visible part of the hemisphere, seen from i, is a half disk and a half ellipse: a
 * disk whose chords are compressed. */
static void make_refraction(lobe_refraction_chart *chart, const double wi[3], const double alpha[2],
                            double n_i, double n_o) {
    *chart = (lobe_refraction_chart){.alpha = {alpha[0], alpha[1]}, .n_i = n_i, .n_o = n_o};
    for (int k = 0; k < 3; ++k) chart->wi[k] = wi[k];
    double *i = chart->axis[2];
    i[0] = alpha[0] * wi[0];
    i[1] = alpha[1] * wi[1];
    i[2] = wi[2];
    normalize(i);
    double length = sqrt(i[0] * i[0] + i[1] * i[1]);
    double *across = chart->axis[0];
    double *up = chart->axis[1];
    across[0] = length > 0 ? -i[1] / length : 1;
    across[1] = length > 0 ? i[0] / length : 0;
    across[2] = 0;
    up[0] = i[1] * across[2] - i[2] * across[1];
    up[1] = i[2] * across[0] - i[0] * across[2];
    up[2] = i[0] * across[1] - i[1] * across[0];
    chart->stretch = (1 + i[2]) / 2;
}

/* Where nothing leaves below: no solid angle. */
static double nowhere(double wo[3]) {
    wo[0] = wo[1] = 0;
    wo[2] = -1;
    return 0;
}

static double refraction_direction(const void *self, lobe_disk_point point, double wo[3]) {
    const lobe_refraction_chart *chart = self;
    double x = point.x;
    double y = (1 - chart->stretch) * sqrt(1 - x * x) + chart->stretch * point.y;
    double z = sqrt(fmax(1 - x * x - y * y, 0));
    double m[3];
    for (int k = 0; k < 3; ++k) {
        m[k] = x * chart->axis[0][k] + y * chart->axis[1][k] + z * chart->axis[2][k];
        if (k < 2) m[k] *= chart->alpha[k];
    }
    double length = sqrt(dot(m, m));
    normalize(m);
    double c = dot(chart->wi, m);
    double gap = (chart->n_o - chart->n_i) * (chart->n_o + chart->n_i) / (chart->n_i * chart->n_i);
    double eta = chart->n_o / chart->n_i;
    double g = sqrt(fmax(gap + c * c, 0));
    if (!(z > 0) || !(c > 0) || !(g > 0) || gap == 0) return nowhere(wo);
    double bend = gap / (g + c);
    for (int k = 0; k < 3; ++k) wo[k] = -(chart->wi[k] + bend * m[k]) / eta;
    if (!(wo[2] < 0)) return nowhere(wo);
    double stretched = chart->stretch / z;
    double normals = chart->alpha[0] * chart->alpha[1] / (length * length * length);
    return stretched * normals * bend * bend / (eta * g);
}

/* A direction rounded to just outside, in single precision, belongs to the edge: for an index near 1 what is left of
 * both directions in their half vector is not much more than their rounding. */
static int refraction_point(const void *self, const double wo[3], lobe_disk_point *point) {
    const lobe_refraction_chart *chart = self;
    const double slack = 4 * 0x1p-24 * (chart->n_i + chart->n_o);
    if (!(wo[2] < 0) || chart->n_i == chart->n_o) return 0;
    double excess = chart->n_o - chart->n_i;
    double m[3];
    for (int k = 0; k < 3; ++k) {
        m[k] = chart->n_i * (chart->wi[k] + wo[k]) + excess * wo[k];
        if (excess > 0) m[k] = -m[k];
    }
    if (!(m[2] > -slack) || !(dot(m, chart->wi) > -slack) || !(dot(m, wo) < slack)) return 0;
    m[2] = fmax(m[2], 0);
    m[0] /= chart->alpha[0];
    m[1] /= chart->alpha[1];
    normalize(m);
    double x = fmin(fmax(dot(m, chart->axis[0]), -1), 1);
    double chord = sqrt(1 - x * x);
    double y = (dot(m, chart->axis[1]) - (1 - chart->stretch) * chord) / chart->stretch;
    y = fmin(fmax(y, -chord), chord);
    *point = (lobe_disk_point){x, y, sqrt(fmax(1 - x * x - y * y, 0))};
    return 1;
}

void lobe_dielectric_chart_make(lobe_dielectric_chart *chart, const double wi[3], double alpha_x,
                                double alpha_y, double ior, int transmits) {
    chart->side = wi[2] < 0 ? -1 : 1;
    double above[3] = {wi[0], wi[1], fabs(wi[2])};
    double alpha[2] = {alpha_x, alpha_y};
    double n_i = chart->side < 0 ? ior : 1;
    double n_o = transmits ? (chart->side < 0 ? 1 : ior) : n_i;
    chart->reflection = lobe_ggx_chart_prepare(above, alpha_x, alpha_y);
    make_refraction(&chart->refraction, above, alpha, n_i, n_o);
    chart->both.above = lobe_ggx_chart_view(&chart->reflection);
    chart->both.below =
        (lobe_verify_chart){&chart->refraction, refraction_direction, refraction_point};
}

static double dielectric_direction(const void *self, lobe_disk_point point, double wo[3]) {
    const lobe_dielectric_chart *chart = self;
    lobe_verify_chart both = lobe_double_chart_view(&chart->both);
    double angle = both.direction(both.self, point, wo);
    wo[2] *= chart->side;
    return angle;
}

static int dielectric_point(const void *self, const double wo[3], lobe_disk_point *point) {
    const lobe_dielectric_chart *chart = self;
    lobe_verify_chart both = lobe_double_chart_view(&chart->both);
    double turned[3] = {wo[0], wo[1], wo[2] * chart->side};
    return both.point(both.self, turned, point);
}

lobe_verify_chart lobe_dielectric_chart_view(const lobe_dielectric_chart *chart) {
    return (lobe_verify_chart){chart, dielectric_direction, dielectric_point};
}
