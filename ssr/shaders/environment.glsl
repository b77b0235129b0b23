/* ssr/shaders/environment.glsl: light between the texels and levels of the environment. */
layout(std430, binding = 18) readonly buffer environment_block {
    v3 texels[];
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
