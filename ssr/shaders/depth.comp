/* Pyramid, first level: the depth of every pixel.
 * Agrees with the processor to 1e-6. */
#include "common.glsl"
#include "z.glsl"

layout(std430, binding = 7) writeonly buffer depth_block {
    ssr_cell cells[];
};

void main() {
    if (is_outside(p.width, p.height)) return;
    kint pixel = pixel_at(own_x(), own_y());
    cells[pixel] = ssr_cell_of(p.now, z_of_pixel[pixel]);
}
