/* Composite: what the screen does not show comes from the environment.
 * Agrees with the processor to 2e-4, for the same reflection. */
#include "common.glsl"
#include "surface.glsl"

layout(std430, binding = 15) readonly buffer reflection_block {
    ssr_reflected reflection[];
};
layout(std430, binding = 17) readonly buffer f0_block {
    v3 f0_of_pixel[];
};
layout(std430, binding = 18) readonly buffer environment_block {
    v3 texels[];
};
layout(std430, binding = 19) writeonly buffer radiance_block {
    v3 radiance[];
};
layout(std430, binding = 20) writeonly buffer composite_block {
    v3 composite[];
};

v3 texel_at(kint level, kint x, kint y) {
    kint row = level * p.environment_height + ssr_inside(y, p.environment_height);
    return ssr_usable_light(texels[row * p.environment_width + ssr_around(x, p.environment_width)]);
}

v3 level_at(kint level, ssr_between b) {
    v3 sum = v3_of(0.0, 0.0, 0.0);
    for (kint k = 0; k < 4; ++k)
        sum = ssr_add_share(sum, texel_at(level, ssr_corner_x(b, k), ssr_corner_y(b, k)),
                            ssr_share(b, k));
    return sum;
}

v3 environment_at(v3 direction, real roughness) {
    v3 sum = v3_of(0.0, 0.0, 0.0);
    if (p.environment_levels == 0) return sum;
    ssr_between b = ssr_environment_place(direction, p.environment_width, p.environment_height);
    real level = ssr_rough_level(roughness, p.environment_levels);
    for (kint k = 0; k < 2; ++k)
        sum = ssr_add_share(sum, level_at(ssr_level_at(level, k, p.environment_levels), b),
                            ssr_level_share(level, k));
    return sum;
}

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
