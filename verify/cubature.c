#include "cubature.h"

#include <math.h>

enum { POINTS = 5, DEPTH = 9 };

static const double NODE[POINTS] = {-0.90617984593866399280, -0.53846931010568309104, 0,
                                    0.53846931010568309104, 0.90617984593866399280};
static const double WEIGHT[POINTS] = {0.23692688505618908751, 0.47862867049936646804,
                                      0.56888888888888888889, 0.47862867049936646804,
                                      0.23692688505618908751};

static void gauss(const lobe_integrand *integrand, lobe_box box,
                  double integral[LOBE_CUBATURE_VALUES]) {
    double half_x = (box.high[0] - box.low[0]) / 2;
    double half_y = (box.high[1] - box.low[1]) / 2;
    double values[LOBE_CUBATURE_VALUES];
    for (int k = 0; k < integrand->count; ++k) integral[k] = 0;
    for (int i = 0; i < POINTS; ++i) {
        for (int j = 0; j < POINTS; ++j) {
            double x = box.low[0] + half_x * (1 + NODE[i]);
            double y = box.low[1] + half_y * (1 + NODE[j]);
            integrand->evaluate(integrand->self, x, y, values);
            double weight = WEIGHT[i] * WEIGHT[j] * half_x * half_y;
            for (int k = 0; k < integrand->count; ++k) integral[k] += weight * values[k];
        }
    }
}

static lobe_box quarter(lobe_box box, int which) {
    for (int axis = 0; axis < 2; ++axis) {
        double middle = (box.low[axis] + box.high[axis]) / 2;
        if (which >> axis & 1) {
            box.low[axis] = middle;
        } else {
            box.high[axis] = middle;
        }
    }
    return box;
}

/* `integral` comes in as the estimate for the whole box and leaves refined. */
static void refine(const lobe_integrand *integrand, lobe_box box, int depth, int least_depth,
                   double integral[LOBE_CUBATURE_VALUES]) {
    double part[4][LOBE_CUBATURE_VALUES];
    for (int q = 0; q < 4; ++q) gauss(integrand, quarter(box, q), part[q]);
    int is_good = depth >= least_depth;
    for (int k = 0; k < integrand->count; ++k) {
        double sum = part[0][k] + part[1][k] + part[2][k] + part[3][k];
        /* No refinement mends what is not finite. */
        is_good &= fabs(sum - integral[k]) <= integrand->tolerance[k] || !isfinite(sum);
    }
    for (int q = 0; q < 4 && !is_good && depth < DEPTH; ++q) {
        refine(integrand, quarter(box, q), depth + 1, least_depth, part[q]);
    }
    for (int k = 0; k < integrand->count; ++k) {
        integral[k] = part[0][k] + part[1][k] + part[2][k] + part[3][k];
    }
}

void lobe_cubature(const lobe_integrand *integrand, lobe_box box,
                   double integral[LOBE_CUBATURE_VALUES]) {
    lobe_cubature_of_edges(integrand, box, 0, integral);
}

void lobe_cubature_of_edges(const lobe_integrand *integrand, lobe_box box, int least_depth,
                            double integral[LOBE_CUBATURE_VALUES]) {
    gauss(integrand, box, integral);
    refine(integrand, box, 0, least_depth, integral);
}
