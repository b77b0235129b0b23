/* ssr/shaders/surface.glsl: the surface of a pixel. */
#include "z.glsl"

layout(std430, binding = 2) readonly buffer normal_block {
    v3 normal_of_pixel[];
};
layout(std430, binding = 3) readonly buffer roughness_block {
    real roughness_of_pixel[];
};
layout(std430, binding = 4) readonly buffer mask_block {
    kword mask_of_four_pixels[];
};
layout(std430, binding = 5) readonly buffer anisotropy_block {
    real anisotropy_of_pixel[];
};
layout(std430, binding = 6) readonly buffer tangent_block {
    v3 tangent_of_pixel[];
};

bool is_masked(kint pixel) {
    if (!k_is(p.has_mask)) return false;
    return (mask_of_four_pixels[pixel >> 2] >> (8 * (pixel & 3)) & 255u) == 0u;
}

ssr_material material_at(kint pixel) {
    ssr_material m = ssr_material_of(normal_of_pixel[pixel], roughness_of_pixel[pixel]);
    if (k_is(p.has_tangent)) {
        m.anisotropy = anisotropy_of_pixel[pixel];
        m.tangent = tangent_of_pixel[pixel];
    }
    return m;
}

ssr_surface surface_at(kint x, kint y) {
    kint pixel = pixel_at(x, y);
    return ssr_surface_of(p.now, float(x) + 0.5, float(y) + 0.5, z_at(pixel), material_at(pixel));
}
