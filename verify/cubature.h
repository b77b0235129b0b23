/* Adaptive cubature over rectangles: 5 x 5 Gauss-Legendre points, quartered until halving the step
 * changes nothing above the tolerance. */
#ifndef LOBE_VERIFY_CUBATURE_H
#define LOBE_VERIFY_CUBATURE_H

/* Integrands at most, and points that are asked for at once. */
#define LOBE_CUBATURE_VALUES 5
#define LOBE_CUBATURE_POINTS 100

/* Several integrands on the same points. */
typedef struct lobe_integrand {
    void (*evaluate)(const void *self, double x, double y, double values[LOBE_CUBATURE_VALUES]);
    const void *self;
    int count;
    double tolerance[LOBE_CUBATURE_VALUES]; /* absolute, for each rectangle that is asked for */
    /* Instead of `evaluate`, if it is not NULL. */
    void (*evaluate_many)(const void *self, int points, const double *x, const double *y,
                          double (*values)[LOBE_CUBATURE_VALUES]);
} lobe_integrand;

typedef struct lobe_box {
    double low[2];
    double high[2];
} lobe_box;

void lobe_cubature(const lobe_integrand *integrand, lobe_box box,
                   double integral[LOBE_CUBATURE_VALUES]);

/* Quarters `least_depth` times, whatever that changes, before it believes itself: a corner of a lobe
 * that ends somewhere can lie between all points of a rectangle. */
void lobe_cubature_of_edges(const lobe_integrand *integrand, lobe_box box, int least_depth,
                            double integral[LOBE_CUBATURE_VALUES]);

#endif
