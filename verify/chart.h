/* Charts: smooth maps of the unit disk onto the directions that a model can return.
 *
 * Bins and quadrature live on the disk, in coordinates (t, a) of the unit square that need no
 * trigonometry and are smooth up to the edge:
 *   radius r = 2t/(1+t^2), height w = sqrt(1-r^2) = (1-t^2)/(1+t^2)     (t = tan of half the angle)
 *   azimuth: a in quarters of a turn, each quarter along the chord between two axes. */
#ifndef LOBE_VERIFY_CHART_H
#define LOBE_VERIFY_CHART_H

/* A point of the disk: y = r (cos, sin), w = sqrt(1 - r^2) without cancellation. */
typedef struct lobe_disk_point {
    double x, y, w;
} lobe_disk_point;

typedef struct lobe_verify_chart {
    const void *self;
    /* Direction of a point; returns solid angle per area of the disk. */
    double (*direction)(const void *self, lobe_disk_point point, double wo[3]);
    /* The point of a direction; 0 if no point of the disk has it. */
    int (*point)(const void *self, const double wo[3], lobe_disk_point *point);
} lobe_verify_chart;

/* (t, a) to a point; *area gets the area of the disk per area of the square. */
lobe_disk_point lobe_disk_from_square(double t, double a, double *area);
void lobe_square_from_disk(lobe_disk_point point, double *t, double *a);

/* Orthographic: wo = (x, y, w), the upper hemisphere; and wo = (x, y, -w), the lower one. */
lobe_verify_chart lobe_hemisphere_chart(void);
lobe_verify_chart lobe_lower_hemisphere_chart(void);

#endif
