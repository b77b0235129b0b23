/* ssr/shaders/z.glsl: distances along the camera's axis. */
layout(std430, binding = 1) readonly buffer z_block {
    real z_of_pixel[];
};

real z_at(kint pixel) {
    return ssr_usable_z(z_of_pixel[pixel], p.now.near_z, p.now.far_z);
}
