/* ssr/passes/resolve.h: the colour of a pixel from its own ray and those of its neighbours. */
#ifndef LOBE_SSR_RESOLVE_H
#define LOBE_SSR_RESOLVE_H

#include "reproject.h"
#include "trace.h"
#include "weight.h"

/* The ways of lobe/ssr.h. */
#define SSR_APPROX K_INT(0)
#define SSR_NEIGHBOURHOOD K_INT(1)
#define SSR_NEIGHBOURHOOD_RATIO K_INT(2)
#define SSR_CONFIDENCE K_INT(3)
#define SSR_OWN K_INT(4)

/* Without the neighbours. */
K_FN bool ssr_is_alone(kint way) {
    return k_or(way == SSR_APPROX, way == SSR_OWN);
}

/* How far the rays of a pixel's neighbours are gathered, in pixels. */
K_FN kint ssr_gather_reach(kint way) {
    return ssr_pick(way == SSR_CONFIDENCE, K_INT(2), K_INT(1));
}

/* 3 x 3 rays, or the 13 of distance 2 at most. */
K_FN bool ssr_gathers(kint dx, kint dy) {
    return dx * dx + dy * dy <= K_INT(4);
}

/* The pixel that is resolved. */
K_STRUCT(ssr_resolved) {
    ssr_surface surface;
    ggx_base g;
    v3 world_to_viewer;
};

/* Sums over rays: colour and opacity by weight, and the weights. */
K_STRUCT(ssr_sum) {
    v3 color;
    real opacity;
    real weight;
};

K_FN ssr_resolved ssr_resolved_of(ssr_surface surface) {
    ssr_resolved p;
    p.surface = surface;
    p.g = ggx_base_of(surface.to_viewer, surface.alpha_x, surface.alpha_y,
                      facet_options_of(false, false));
    p.world_to_viewer = ssr_to_world(surface, surface.to_viewer);
    return p;
}

/* Value over density of a neighbour's ray, for this pixel. */
K_FN real ssr_ratio_weight(ssr_resolved p, real pdf, v3 wo) {
    real value = ggx_f_cos(p.g, ggx_pair_of_wo(p.g, wo));
    bool drawn = pdf > R(0.0);
    return k_select(drawn, ssr_usable(value / k_select(drawn, pdf, R(1.0))), R(0.0));
}

/* How much a ray tells. One that was lost behind something says that the screen does not show what it meets; what its
 * neighbours met is more likely there than the environment. One that left the screen may meet what stands beside it
 * or nothing. The numbers are chosen on the scenes of docs/ssr.md. */
K_FN real ssr_confidence(kint state) {
    real known = k_select(state == SSR_MISS, R(0.5), R(1.0));
    return k_select(state == SSR_LOST, R(0.03), known);
}

/* `direction` in the world. A mirror's ray is its neighbours' no more. */
K_FN real ssr_ray_weight(ssr_resolved p, kint state, v3 direction, real pdf, bool is_own,
                         bool mirrors, kint way) {
    v3 wo = ssr_to_frame(p.surface, direction);
    real visible =
        ssr_visible_weight(p.surface.to_viewer, wo, p.surface.alpha_x, p.surface.alpha_y);
    real ratio = k_select(k_or(mirrors, k_is(p.g.mirror)), k_select(is_own, R(1.0), R(0.0)),
                          ssr_ratio_weight(p, pdf, wo));
    real sure = k_select(way == SSR_CONFIDENCE, ssr_confidence(state), R(1.0));
    real weight = k_select(way == SSR_NEIGHBOURHOOD, visible, ratio) * sure;
    return k_select(k_or(state == SSR_NO_RAY, state == SSR_REJECTED), R(0.0), weight);
}

/* HDRP's Lambda has the square of z: it does not see which side a direction is on. */
K_FN v3 ssr_folded(v3 d) {
    return v3_of(d.x, d.y, k_abs(d.z));
}

/* World-space vectors in the weight, and draws that were dropped as misses of weight 1. */
K_FN real ssr_hdrp_weight(ssr_resolved p, kint state, v3 direction) {
    real alpha = R(0.5) * (p.surface.alpha_x + p.surface.alpha_y);
    real visible =
        ssr_visible_weight(ssr_folded(p.world_to_viewer), ssr_folded(direction), alpha, alpha);
    real weight = k_select(state == SSR_REJECTED, R(1.0), visible);
    return k_select(state == SSR_NO_RAY, R(0.0), weight);
}

K_FN ssr_sum ssr_no_sum(void) {
    ssr_sum s;
    s.color = v3_of(R(0.0), R(0.0), R(0.0));
    s.opacity = R(0.0);
    s.weight = R(0.0);
    return s;
}

K_FN ssr_sum ssr_add_ray(ssr_sum sum, ssr_reflected found, real weight) {
    ssr_sum s;
    s.color = v3_add(sum.color, v3_scale(found.color, weight * found.opacity));
    s.opacity = sum.opacity + weight * found.opacity;
    s.weight = sum.weight + weight;
    return s;
}

/* The mean, faded by roughness; colours are times opacity. */
K_FN ssr_reflected ssr_mean_of(ssr_sum sum, real fade) {
    bool any = sum.weight > R(0.0);
    real bottom = k_select(any, sum.weight, R(1.0));
    ssr_reflected l;
    l.color = v3_of(sum.color.x / bottom * fade, sum.color.y / bottom * fade,
                    sum.color.z / bottom * fade);
    l.opacity = sum.opacity / bottom * fade;
    return l;
}

#endif
