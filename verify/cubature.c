#include "cubature.h"

#include <math.h>
#include <stddef.h>

enum { POINTS = 5, MOST_BOXES = 4, DEPTH = 9, SIDES = 4 };
_Static_assert(MOST_BOXES *POINTS *POINTS == LOBE_CUBATURE_POINTS, "the quarters of a box");

static const double NODE[POINTS] = {-0.90617984593866399280, -0.53846931010568309104, 0,
                                    0.53846931010568309104, 0.90617984593866399280};
static const double WEIGHT[POINTS] = {0.23692688505618908751, 0.47862867049936646804,
                                      0.56888888888888888889, 0.47862867049936646804,
                                      0.23692688505618908751};

static void evaluate(const lobe_integrand *integrand, int points, const double *x, const double *y,
                     double (*values)[LOBE_CUBATURE_VALUES]) {
    if (integrand->evaluate_many != NULL) {
        integrand->evaluate_many(integrand->self, points, x, y, values);
        return;
    }
    for (int p = 0; p < points; ++p) integrand->evaluate(integrand->self, x[p], y[p], values[p]);
}

/* Of so many boxes, all their points at once. */
static void gauss(const lobe_integrand *integrand, int boxes, const lobe_box *box,
                  double (*integral)[LOBE_CUBATURE_VALUES]) {
    double x[MOST_BOXES * POINTS * POINTS] = {0}, y[MOST_BOXES * POINTS * POINTS] = {0};
    double values[MOST_BOXES * POINTS * POINTS][LOBE_CUBATURE_VALUES];
    for (int p = 0; p < boxes * POINTS * POINTS; ++p) {
        const lobe_box *b = &box[p / (POINTS * POINTS)];
        const double half_x = (b->high[0] - b->low[0]) / 2;
        const double half_y = (b->high[1] - b->low[1]) / 2;
        x[p] = b->low[0] + half_x * (1 + NODE[p / POINTS % POINTS]);
        y[p] = b->low[1] + half_y * (1 + NODE[p % POINTS]);
    }
    evaluate(integrand, boxes * POINTS * POINTS, x, y, values);
    for (int b = 0; b < boxes; ++b)
        for (int k = 0; k < integrand->count; ++k) integral[b][k] = 0;
    for (int p = 0; p < boxes * POINTS * POINTS; ++p) {
        const lobe_box *b = &box[p / (POINTS * POINTS)];
        const double half_x = (b->high[0] - b->low[0]) / 2;
        const double half_y = (b->high[1] - b->low[1]) / 2;
        const double weight = WEIGHT[p / POINTS % POINTS] * WEIGHT[p % POINTS] * half_x * half_y;
        for (int k = 0; k < integrand->count; ++k)
            integral[p / (POINTS * POINTS)][k] += weight * values[p][k];
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

/* Whether something reaches into a box along its sides, by less than the distance of the rule's first point: so near
 * to them, in parts of the box. */
static int reaches_in(const lobe_integrand *integrand, lobe_box box) {
    const double near = 1e-3;
    double at[2][SIDES * POINTS], values[SIDES * POINTS][LOBE_CUBATURE_VALUES];
    for (int p = 0; p < SIDES * POINTS; ++p) {
        const int side = p / POINTS, across = side & 1;
        const double part[2] = {side < 2 ? near : 1 - near, (1 + NODE[p % POINTS]) / 2};
        for (int axis = 0; axis < 2; ++axis)
            at[axis][p] = box.low[axis] + (box.high[axis] - box.low[axis]) * part[axis != across];
    }
    evaluate(integrand, SIDES * POINTS, at[0], at[1], values);
    for (int p = 0; p < SIDES * POINTS; ++p)
        for (int k = 0; k < integrand->count; ++k)
            if (values[p][k] != 0) return 1;
    return 0;
}

/* `integral` comes in as the estimate for the whole box and leaves refined. */
static void refine(const lobe_integrand *integrand, lobe_box box, int depth, int least_depth,
                   double integral[LOBE_CUBATURE_VALUES]) {
    lobe_box quarters[4];
    double part[4][LOBE_CUBATURE_VALUES];
    for (int q = 0; q < 4; ++q) quarters[q] = quarter(box, q);
    gauss(integrand, 4, quarters, part);
    int is_good = depth >= least_depth, is_empty = 1;
    for (int k = 0; k < integrand->count; ++k) {
        double sum = part[0][k] + part[1][k] + part[2][k] + part[3][k];
        is_empty &= sum == 0;
        /* No refinement mends what is not finite. */
        is_good &= fabs(sum - integral[k]) <= integrand->tolerance[k] || !isfinite(sum);
    }
    if (is_good && is_empty && depth < DEPTH) is_good = !reaches_in(integrand, box);
    for (int q = 0; q < 4 && !is_good && depth < DEPTH; ++q) {
        refine(integrand, quarters[q], depth + 1, least_depth, part[q]);
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
    double whole[1][LOBE_CUBATURE_VALUES];
    gauss(integrand, 1, &box, whole);
    for (int k = 0; k < integrand->count; ++k) integral[k] = whole[0][k];
    refine(integrand, box, 0, least_depth, integral);
}
