/* ssr/passes/weight.h: the weight of a neighbour's ray where the densities are not kept: with D
 * cancelled, value over density of the visible normals, (1 + L(V))/(1 + L(V) + L(L)), L Smith's Lambda. */
#ifndef LOBE_SSR_WEIGHT_H
#define LOBE_SSR_WEIGHT_H

#include "kernel/ggx.h"

/* Directions in the frame of the pixel that is resolved; 0 for a ray below its surface. */
K_FN real ssr_visible_weight(v3 to_viewer, v3 ray, real alpha_x, real alpha_y) {
    bool leaves = k_and(ray.z > R(0.0), to_viewer.z > R(0.0));
    v3 up = v3_of(R(0.0), R(0.0), R(1.0));
    real seen = R(1.0) + ggx_lambda(v3_select(leaves, to_viewer, up), alpha_x, alpha_y);
    real lit = ggx_lambda(v3_select(leaves, ray, up), alpha_x, alpha_y);
    return k_select(leaves, seen / (seen + lit), R(0.0));
}

#endif
