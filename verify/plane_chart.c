#include "plane_chart.h"

#include <math.h>
#include <string.h>

#include "axes.h"

/* Eigenvalues of a symmetric matrix on the diagonal, eigenvectors in the columns of v: Jacobi. */
static void diagonalize(double a[3][3], double v[3][3]) {
    memset(v, 0, sizeof(double[3][3]));
    for (int k = 0; k < 3; ++k) v[k][k] = 1;
    for (int sweep = 0; sweep < 10; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                if (a[p][q] == 0) continue;
                double turn = (a[q][q] - a[p][p]) / (2 * a[p][q]);
                double t = copysign(1, turn) / (fabs(turn) + hypot(turn, 1));
                double c = 1 / hypot(t, 1), s = t * c;
                for (int k = 0; k < 3; ++k) {
                    double x = a[k][p], y = a[k][q];
                    a[k][p] = c * x - s * y;
                    a[k][q] = s * x + c * y;
                }
                for (int k = 0; k < 3; ++k) {
                    double x = a[p][k], y = a[q][k];
                    a[p][k] = c * x - s * y;
                    a[q][k] = s * x + c * y;
                    x = v[k][p], y = v[k][q];
                    v[k][p] = c * x - s * y;
                    v[k][q] = s * x + c * y;
                }
            }
        }
    }
}

/* Largest eigenvalue of (1 - t) a + t b and its eigenvector. */
static double largest(double a[3][3], double b[3][3], double t, double n[3]) {
    double mix[3][3], v[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) mix[i][j] = (1 - t) * a[i][j] + t * b[i][j];
    diagonalize(mix, v);
    int top = 0;
    for (int k = 1; k < 3; ++k)
        if (mix[k][k] > mix[top][top]) top = k;
    for (int k = 0; k < 3; ++k) n[k] = v[k][top];
    return mix[top][top];
}

static double apply(double form[3][3], const double a[3], const double b[3]) {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum += a[i] * form[i][j] * b[j];
    return sum;
}

static void scale_to_one(double form[3][3]) {
    double n[3], eigenvalue = largest(form, form, 0, n);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) form[i][j] /= eigenvalue;
}

/* The axis deepest inside both cones: the top eigenvector of the mixture whose largest eigenvalue is
 * least. */
static void find_axis(lobe_plane_chart *plane, double n[3]) {
    double low = 0, high = 1;
    for (int step = 0; step < 40; ++step) {
        double t = (low + high) / 2;
        largest(plane->form[0], plane->form[1], t, n);
        /* the derivative of the largest eigenvalue */
        double slope = apply(plane->form[1], n, n) - apply(plane->form[0], n, n);
        if (slope < 0)
            low = t;
        else
            high = t;
    }
    double side = lobe_dot(n, plane->i_std) < 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k) n[k] *= side;
}

lobe_plane_chart lobe_plane_chart_prepare(const double wi[3], const double g[3], double alpha_x,
                                          double alpha_y) {
    lobe_plane_chart plane = {.alpha = {alpha_x, alpha_y}, .wi = {wi[0], wi[1], wi[2]}};
    double *i = plane.i_std;
    i[0] = alpha_x * wi[0];
    i[1] = alpha_y * wi[1];
    i[2] = wi[2];
    plane.length = sqrt(lobe_dot(i, i));
    lobe_normalize(i);
    /* from behind: m_z >= 0 and i.m >= 0, the form of i_z = 0 without its curvature */
    const double z[3] = {0, 0, 1};
    const double *normals[2] = {z, g};
    double heights[2] = {fmax(wi[2], 0), lobe_dot(wi, g)};
    const double a2[3] = {alpha_x * alpha_x, alpha_y * alpha_y, 1};
    for (int form = 0; form < 2; ++form) {
        const double *normal = normals[form];
        double stretched[3] = {alpha_x * normal[0], alpha_y * normal[1], normal[2]};
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) {
                double q = i[r] * stretched[c] + i[c] * stretched[r];
                if (r == c) q -= heights[form] / plane.length * a2[r];
                plane.form[form][r][c] = q;
            }
        }
        scale_to_one(plane.form[form]);
    }
    find_axis(&plane, plane.axis[2]);
    lobe_complete_frame(plane.axis);
    return plane;
}

/* Cosine of the angle from the axis along `across` at which a form turns negative: the form is
 * quadratic in the tangent. */
static double edge(double form[3][3], const double axis[3], const double across[3]) {
    double a = apply(form, axis, axis), b = apply(form, axis, across),
           c = apply(form, across, across);
    double root = sqrt(fmax(b * b - a * c, 0));
    /* a + 2 b t + c t^2 = 0, smallest angle in (0, pi) */
    double s, co;
    if (b <= 0) {
        s = a;
        co = root - b;
    } else {
        s = b + root;
        co = -c;
    }
    return co / hypot(s, co);
}

static double edge_of_both(const lobe_plane_chart *plane, const double across[3]) {
    double forms[2][3][3];
    memcpy(forms, plane->form, sizeof forms);
    return fmax(edge(forms[0], plane->axis[2], across), edge(forms[1], plane->axis[2], across));
}

static void across_of(const lobe_plane_chart *plane, double c, double s, double across[3]) {
    for (int k = 0; k < 3; ++k) across[k] = c * plane->axis[0][k] + s * plane->axis[1][k];
}

static double plane_direction(const void *self, lobe_disk_point point, double wo[3]) {
    const lobe_plane_chart *plane = self;
    double r2 = point.x * point.x + point.y * point.y, r = sqrt(r2), across[3], m[3];
    across_of(plane, r > 0 ? point.x / r : 1, r > 0 ? point.y / r : 0, across);
    double height = 1 - edge_of_both(plane, across);
    double rise = r2 * height; /* 1 - cos of the angle from the axis */
    double sine = sqrt(rise * (2 - rise));
    for (int k = 0; k < 3; ++k) m[k] = (1 - rise) * plane->axis[2][k] + sine * across[k];
    double i_m = fmax(lobe_dot(plane->i_std, m), 0); /* stretched */
    m[0] *= plane->alpha[0];
    m[1] *= plane->alpha[1];
    double length2 = lobe_dot(m, m);
    for (int k = 0; k < 3; ++k) wo[k] = 2 * plane->length * i_m / length2 * m[k] - plane->wi[k];
    /* reflection 4 i.m, stretch alpha_x alpha_y / |A m|^3, disk 2 height */
    return 8 * height * plane->length * i_m * plane->alpha[0] * plane->alpha[1] /
           (length2 * length2);
}

static int plane_point(const void *self, const double wo[3], lobe_disk_point *point) {
    const lobe_plane_chart *plane = self;
    double m[3] = {(plane->wi[0] + wo[0]) / plane->alpha[0],
                   (plane->wi[1] + wo[1]) / plane->alpha[1], plane->wi[2] + wo[2]};
    if (!(lobe_dot(m, m) > 0) || !(m[2] >= 0)) return 0;
    lobe_normalize(m);
    double x = lobe_dot(m, plane->axis[0]), y = lobe_dot(m, plane->axis[1]);
    double sine = hypot(x, y), across[3];
    double c = sine > 0 ? x / sine : 1, s = sine > 0 ? y / sine : 0;
    across_of(plane, c, s, across);
    double along = lobe_dot(m, plane->axis[2]);
    double rise = along > 0 ? sine * sine / (1 + along) : 1 - along;
    /* A direction rounded to just outside belongs to the edge. */
    double r2 = fmin(rise / (1 - edge_of_both(plane, across)), 1);
    double r = sqrt(r2);
    *point = (lobe_disk_point){r * c, r * s, sqrt(1 - r2)};
    return 1;
}

lobe_verify_chart lobe_plane_chart_view(const lobe_plane_chart *plane) {
    return (lobe_verify_chart){plane, plane_direction, plane_point};
}
