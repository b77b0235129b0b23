/* Pyramid: the mean of 2 x 2 colours.
 * Agrees with the processor to 1e-5. */
#include "common.glsl"
#include "level.glsl"

layout(std430, binding = 11) buffer color_block {
    v3 colors[];
};

void main() {
    if (is_outside(p.level_width[level], p.level_height[level])) return;
    colors[cell_at(own_x(), own_y())] =
        ssr_mean_light(colors[cell_below(0)], colors[cell_below(1)], colors[cell_below(2)],
                       colors[cell_below(3)]);
}
