#include "sphere_chart.h"

#include <math.h>

static double sphere_direction(const void *self, lobe_disk_point point, double wo[3]) {
    (void)self;
    wo[0] = 2 * point.w * point.x;
    wo[1] = 2 * point.w * point.y;
    wo[2] = 1 - 2 * (point.x * point.x + point.y * point.y);
    return 4;
}

static int sphere_point(const void *self, const double wo[3], lobe_disk_point *point) {
    (void)self;
    double across = sqrt(wo[0] * wo[0] + wo[1] * wo[1]);
    double half = atan2(across, wo[2]) / 2;
    double r = sin(half);
    int is_off_axis = across > 0;
    point->x = is_off_axis ? r * wo[0] / across : r;
    point->y = is_off_axis ? r * wo[1] / across : 0;
    point->w = cos(half);
    return 1;
}

lobe_verify_chart lobe_sphere_chart(void) {
    return (lobe_verify_chart){0, sphere_direction, sphere_point};
}

/* The point of the same azimuth with tangent t of half the angle. */
static lobe_disk_point with_tangent(lobe_disk_point point, double t) {
    double length = sqrt(point.x * point.x + point.y * point.y);
    double c = length > 0 ? point.x / length : 1;
    double s = length > 0 ? point.y / length : 0;
    double r = 2 * t / (1 + t * t);
    return (lobe_disk_point){r * c, r * s, (1 - t * t) / (1 + t * t)};
}

static double tangent_of(lobe_disk_point point) {
    return sqrt(point.x * point.x + point.y * point.y) / (1 + point.w);
}

/* Area of the disk per unit of t and turn. */
static double area_at(double t) {
    double scale = 1 / (1 + t * t);
    return 4 * t * scale * scale * (1 - t * t) * scale;
}

static double double_direction(const void *self, lobe_disk_point point, double wo[3]) {
    const lobe_double_chart *pair = self;
    double t = tangent_of(point);
    int is_inner = t < 0.5;
    const lobe_verify_chart *chart = is_inner ? &pair->above : &pair->below;
    double own = is_inner ? 2 * t : 2 * t - 1;
    double angle = chart->direction(chart->self, with_tangent(point, own), wo);
    double area = area_at(t);
    return area > 0 ? angle * 2 * area_at(own) / area : 0;
}

static int double_point(const void *self, const double wo[3], lobe_disk_point *point) {
    const lobe_double_chart *pair = self;
    int is_above = wo[2] > 0;
    const lobe_verify_chart *chart = is_above ? &pair->above : &pair->below;
    if (!chart->point(chart->self, wo, point)) return 0;
    double own = tangent_of(*point) / 2;
    *point = with_tangent(*point, is_above ? fmin(own, nextafter(0.5, 0)) : 0.5 + own);
    return 1;
}

lobe_verify_chart lobe_double_chart_view(const lobe_double_chart *pair) {
    return (lobe_verify_chart){pair, double_direction, double_point};
}
