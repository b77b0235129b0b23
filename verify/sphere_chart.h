/* Charts of the whole sphere, for models that transmit. */
#ifndef LOBE_VERIFY_SPHERE_CHART_H
#define LOBE_VERIFY_SPHERE_CHART_H

#include "chart.h"

/* Lambert's equal-area map from +z: t is the tangent of a quarter of the angle to it. For any density,
 * where nothing is known of its lobes. */
lobe_verify_chart lobe_sphere_chart(void);

/* Two charts in one disk: the inner half of its radius t belongs to `above`, which has the directions of
 * z > 0, the outer half to `below`. Stays where it is made. */
typedef struct lobe_double_chart {
    lobe_verify_chart above, below;
} lobe_double_chart;

lobe_verify_chart lobe_double_chart_view(const lobe_double_chart *pair);

#endif
