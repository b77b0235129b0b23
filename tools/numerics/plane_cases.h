/* tools/numerics/plane_cases.h: shading points with a geometric plane. Before including: a binding. */
#ifndef TOOLS_NUMERICS_PLANE_CASES_H
#define TOOLS_NUMERICS_PLANE_CASES_H

#include "kernel/ggx_horizon_plane_ellipse.h"
#include "kernel/ggx_horizon_plane_uniform.h"
#include "kernel/ggx_horizon_plane_table.h"

#include <math.h>

static inline v3 plane_direction(double theta, double phi) {
    const double degree = 3.14159265358979323846 / 180;
    double s = sin(theta * degree);
    return v3_of((real)(s * cos(phi * degree)), (real)(s * sin(phi * degree)),
                 (real)cos(theta * degree));
}

static inline ggx_base plane_base(v3 wi, v3 plane, double ax, double ay, double floor_share) {
    facet_options options = facet_options_of(false, false);
    options.plane = plane;
    options.floor_share = (real)floor_share;
    return ggx_base_of(wi, (real)ax, (real)ay, options);
}

/* The 110 cases of the method's description: the plane tilted toward, away from and across wi. */
enum { PLANE_CASES = 110 };

static inline ggx_base plane_case(int index, double floor_share) {
    static const double alphas[][2] = {{0.5, 0.5}, {0.1, 1}, {0.3, 0.8}, {1, 1}, {0.2, 0.2}};
    static const double thetas[] = {10, 40, 70}, tilts[] = {20, 35};
    int found = 0;
    for (int k = 0;; ++k) {
        const double *alpha = alphas[k / 24];
        v3 wi = plane_direction(thetas[k / 8 % 3], 0);
        v3 plane = plane_direction(tilts[k / 4 % 2], 90 * (k % 4));
        if ((double)v3_dot(wi, plane) < 1e-6) continue; /* at 70 degrees, tilted away */
        if (found++ == index) return plane_base(wi, plane, alpha[0], alpha[1], floor_share);
    }
}

#endif
