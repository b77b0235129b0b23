/* ssr/shaders/motion.glsl: how far pixels moved. */
layout(std430, binding = 10) readonly buffer motion_block {
    real motion_of_pixel[]; /* x, y */
};

ssr_place motion_at(kint pixel) {
    ssr_place m;
    m.x = m.y = 0.0;
    if (k_is(p.has_motion)) {
        real x = motion_of_pixel[2 * pixel];
        real y = motion_of_pixel[2 * pixel + 1];
        m.x = ssr_usable_motion(x, y);
        m.y = ssr_usable_motion(y, x);
    }
    return m;
}
