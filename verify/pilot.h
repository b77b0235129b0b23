/* Draws that show where the lobe of a model is, as points of its charts.
 *
 * Around each draw stand eight more points, at the distance to which the draws resolve the lobe
 * there: what is next to the lobe is looked at as closely as the lobe, or its edge would be lost in
 * a large box of few draws. */
#ifndef LOBE_VERIFY_PILOT_H
#define LOBE_VERIFY_PILOT_H

#include "model.h"

typedef struct lobe_pilot_point {
    double at[2]; /* t, a */
} lobe_pilot_point;

typedef struct lobe_pilot {
    lobe_pilot_point *points[2]; /* of each sheet */
    size_t count[2];
    size_t crowd; /* a box with more points than this is to be halved */
} lobe_pilot;

/* No points for a model that asks for none. Returns 0 without memory. */
int lobe_pilot_make(lobe_pilot *pilot, const lobe_verify_model *model);
void lobe_pilot_free(lobe_pilot *pilot);

/* Moves the points below `at` along `axis` to the front and returns their number. */
size_t lobe_pilot_split(lobe_pilot_point *points, size_t count, int axis, double at);

#endif
