/* ssr/passes/pyramid.h: nearest and farthest depth of 2 x 2 cells, and the mean of their colours. */
#ifndef LOBE_SSR_PYRAMID_H
#define LOBE_SSR_PYRAMID_H

#include "surface.h"

K_STRUCT(ssr_cell) {
    real nearest;
    real farthest;
};

/* Of one pixel; 0: no surface. */
K_FN ssr_cell ssr_cell_of(ssr_camera c, real z) {
    real usable = ssr_usable_z(z, c.near_z, c.far_z);
    bool there = usable > R(0.0);
    real depth = k_saturate(ssr_depth_of(c, k_select(there, usable, c.far_z)));
    ssr_cell cell;
    cell.nearest = k_select(there, depth, R(0.0));
    cell.farthest = cell.nearest;
    return cell;
}

K_FN ssr_cell ssr_cell_of_four(ssr_cell a, ssr_cell b, ssr_cell c, ssr_cell d) {
    ssr_cell cell;
    cell.nearest = k_max(k_max(a.nearest, b.nearest), k_max(c.nearest, d.nearest));
    cell.farthest = k_min(k_min(a.farthest, b.farthest), k_min(c.farthest, d.farthest));
    return cell;
}

/* Light that cannot be is dark here: a mean must not spread it. */
K_FN v3 ssr_usable_light(v3 light) {
    return v3_of(ssr_usable(light.x), ssr_usable(light.y), ssr_usable(light.z));
}

K_FN v3 ssr_mean_light(v3 a, v3 b, v3 c, v3 d) {
    v3 upper = v3_add(ssr_usable_light(a), ssr_usable_light(b));
    v3 three = v3_add(upper, ssr_usable_light(c));
    return v3_scale(v3_add(three, ssr_usable_light(d)), R(0.25));
}

#endif
