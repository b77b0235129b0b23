#include "chart.h"

#include <math.h>

lobe_disk_point lobe_disk_from_square(double t, double a, double *area) {
    double scale = 1 / (1 + t * t);
    double r = 2 * t * scale;
    double w = (1 - t * t) * scale;
    double turn = 4 * a;
    int quarter = turn < 3 ? (int)turn : 3;
    double along = turn - quarter;
    double length = sqrt((1 - along) * (1 - along) + along * along);
    double c = (1 - along) / length;
    double s = along / length;
    lobe_disk_point point = {r * c, r * s, w};
    if (quarter & 1) {
        point.x = -r * s;
        point.y = r * c;
    }
    if (quarter & 2) {
        point.x = -point.x;
        point.y = -point.y;
    }
    double angle_per_t = 2 * scale;
    double angle_per_a = 4 / (length * length);
    *area = r * w * angle_per_t * angle_per_a;
    return point;
}

void lobe_square_from_disk(lobe_disk_point point, double *t, double *a) {
    double r = sqrt(point.x * point.x + point.y * point.y);
    double sum = fabs(point.x) + fabs(point.y);
    double along = sum > 0 ? fabs(point.y) / sum : 0;
    /* By a table: which quarter it is, no processor foresees. */
    static const double START[4] = {0, 2, 4, 2};
    static const double SIGN[4] = {1, -1, -1, 1};
    int quarter = 2 * (point.y < 0) + !(point.x > 0);
    *t = r / (1 + point.w);
    *a = (START[quarter] + SIGN[quarter] * along) / 4;
}

/* `self` points to the sign of z. */
static const double UP = 1;
static const double DOWN = -1;

static double hemisphere_direction(const void *self, lobe_disk_point point, double wo[3]) {
    wo[0] = point.x;
    wo[1] = point.y;
    wo[2] = *(const double *)self * point.w;
    return 1 / point.w;
}

static int hemisphere_point(const void *self, const double wo[3], lobe_disk_point *point) {
    *point = (lobe_disk_point){wo[0], wo[1], *(const double *)self * wo[2]};
    return point->w > 0;
}

lobe_verify_chart lobe_hemisphere_chart(void) {
    return (lobe_verify_chart){&UP, hemisphere_direction, hemisphere_point};
}

lobe_verify_chart lobe_lower_hemisphere_chart(void) {
    return (lobe_verify_chart){&DOWN, hemisphere_direction, hemisphere_point};
}
