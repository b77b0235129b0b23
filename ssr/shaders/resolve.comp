/* Resolve: the colour of a pixel from its own ray and those of its neighbours.
 * Agrees with the processor to 2e-4, for the same rays. */
#include "common.glsl"
#include "surface.glsl"

layout(std430, binding = 8) readonly buffer drawn_block {
    ssr_drawn drawn[];
};
layout(std430, binding = 9) readonly buffer met_block {
    ssr_met met[];
};
layout(std430, binding = 12) readonly buffer found_block {
    ssr_reflected found[];
};
layout(std430, binding = 13) writeonly buffer resolved_block {
    ssr_reflected resolved[];
};

real weight_of(ssr_resolved own, kint neighbour, bool is_own) {
    ssr_drawn d = drawn[neighbour];
    kint state = ssr_met_state(met[neighbour]);
    if (k_is(p.as_hdrp)) return ssr_hdrp_weight(own, state, d.direction);
    return ssr_ray_weight(own, state, d.direction, d.pdf, is_own, k_is(p.mirrors), p.way);
}

ssr_sum gather(ssr_resolved own) {
    ssr_sum sum = ssr_no_sum();
    kint reach = ssr_gather_reach(p.way);
    for (kint y = own_y() - reach; y <= own_y() + reach; ++y)
        for (kint x = own_x() - reach; x <= own_x() + reach; ++x) {
            if (x < 0 || y < 0 || x >= p.width || y >= p.height) continue;
            if (!ssr_gathers(x - own_x(), y - own_y())) continue;
            kint neighbour = pixel_at(x, y);
            bool is_own = x == own_x() && y == own_y();
            sum = ssr_add_ray(sum, found[neighbour], weight_of(own, neighbour, is_own));
        }
    return sum;
}

void main() {
    if (is_outside(p.width, p.height)) return;
    kint pixel = pixel_at(own_x(), own_y());
    resolved[pixel] = ssr_no_reflected();
    if (ssr_met_state(met[pixel]) == SSR_NO_RAY) return;
    ssr_surface surface = surface_at(own_x(), own_y());
    if (!k_is(surface.seen)) return;
    ssr_sum sum;
    if (ssr_is_alone(p.way)) sum = ssr_add_ray(ssr_no_sum(), found[pixel], 1.0);
    else sum = gather(ssr_resolved_of(surface));
    real fade = ssr_roughness_fade(roughness_of_pixel[pixel], p.fade_start, p.fade_end);
    resolved[pixel] = ssr_mean_of(sum, fade);
}
