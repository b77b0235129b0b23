/* ssr/shaders/level.glsl: the level of a pyramid that is made, and the four cells below one of it. */
layout(std430, binding = 21) readonly buffer level_block {
    kint level;
};

kint cell_at(kint x, kint y) {
    return p.level_start[level] + y * p.level_width[level] + x;
}

/* Corner 0 to 3; beyond the edge the level goes on as it ends. */
kint cell_below(kint corner) {
    kint below = level - 1;
    kint x = ssr_inside(2 * own_x() + (corner & 1), p.level_width[below]);
    kint y = ssr_inside(2 * own_y() + (corner >> 1), p.level_height[below]);
    return p.level_start[below] + y * p.level_width[below] + x;
}
