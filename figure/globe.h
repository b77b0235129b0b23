/* The unit sphere as seen from afar, and disks across a direction. */
#ifndef LOBE_FIGURE_GLOBE_H
#define LOBE_FIGURE_GLOBE_H

#include "canvas.h"
#include "geometry.h"

typedef struct globe {
    canvas *c;
    double x, y, radius; /* of the picture of the unit sphere */
    vec3 right, up, toward;
} globe;

/* Seen from `toward`; z points upward in the picture. */
globe lobe_globe(canvas *c, double x, double y, double radius, vec3 toward);
double lobe_globe_x(const globe *g, vec3 p);
double lobe_globe_y(const globe *g, vec3 p);

/* A curve on the sphere; what lies behind is faint. */
void lobe_globe_curve(const globe *g, pen pen, int count, const vec3 *points);
/* The outline and the equator. */
void lobe_globe_outline(const globe *g);
void lobe_globe_arrow(const globe *g, pen pen, vec3 from, vec3 to);

#endif
