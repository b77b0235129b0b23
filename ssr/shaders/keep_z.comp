/* Accumulate, for the next frame: the distances of this one. */
#include "common.glsl"
#include "z.glsl"

layout(std430, binding = 16) writeonly buffer last_z_block {
    real last_z[];
};

void main() {
    if (is_outside(p.width, p.height)) return;
    kint pixel = pixel_at(own_x(), own_y());
    last_z[pixel] = z_at(pixel);
}
