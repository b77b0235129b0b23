/* Reproject: where what was met was one frame ago, its colour there, and the fade toward the edge.
 * Agrees with the processor to 1e-5, for the same ray; where it takes the environment, as directions do. */
#include "common.glsl"
#include "environment.glsl"
#include "motion.glsl"

layout(std430, binding = 3) readonly buffer roughness_block {
    real roughness_of_pixel[];
};
layout(std430, binding = 8) readonly buffer drawn_block {
    ssr_drawn drawn[];
};
layout(std430, binding = 9) readonly buffer met_block {
    ssr_met met[];
};
layout(std430, binding = 11) readonly buffer color_block {
    v3 colors[];
};
layout(std430, binding = 12) writeonly buffer found_block {
    ssr_reflected found[];
};

v3 color_between(kint level, ssr_place at) {
    kint width = p.level_width[level];
    kint height = p.level_height[level];
    ssr_between b = ssr_between_of(at.x * float(width), at.y * float(height));
    v3 sum = v3_of(0.0, 0.0, 0.0);
    for (kint k = 0; k < 4; ++k) {
        kint x = ssr_inside(ssr_corner_x(b, k), width);
        kint y = ssr_inside(ssr_corner_y(b, k), height);
        sum = ssr_add_share(sum, colors[p.level_start[level] + y * width + x], ssr_share(b, k));
    }
    return sum;
}

/* SSR_APPROX takes the level of the pyramid that grows with roughness. */
v3 color_at(real roughness, ssr_place at) {
    if (p.way != SSR_APPROX) return color_between(0, at);
    real level = ssr_rough_level(roughness, p.levels);
    v3 sum = v3_of(0.0, 0.0, 0.0);
    for (kint k = 0; k < 2; ++k)
        sum = ssr_add_share(sum, color_between(ssr_level_at(level, k, p.levels), at),
                            ssr_level_share(level, k));
    return sum;
}

void main() {
    if (is_outside(p.width, p.height)) return;
    kint pixel = pixel_at(own_x(), own_y());
    ssr_met m = met[pixel];
    found[pixel] = ssr_no_reflected();
    if (p.way == SSR_CONFIDENCE && p.environment_levels > 0 && ssr_met_state(m) == SSR_MISS)
        found[pixel] =
            ssr_whole(environment_at(drawn[pixel].direction, roughness_of_pixel[pixel]));
    if (!ssr_met_something(m)) return;
    kint x = ssr_met_x(m);
    kint y = ssr_met_y(m);
    ssr_place motion = motion_at(pixel_at(x, y));
    ssr_place at = ssr_place_before(float(x) + 0.5, float(y) + 0.5, float(p.width),
                                    float(p.height), motion.x, motion.y);
    if (!ssr_is_on_screen(at)) return;
    found[pixel] = ssr_found(at, color_at(roughness_of_pixel[pixel], at), p.edge_fade);
}
