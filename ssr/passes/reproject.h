/* ssr/passes/reproject.h: where what a ray met was on the screen one frame ago, and its colour there. */
#ifndef LOBE_SSR_REPROJECT_H
#define LOBE_SSR_REPROJECT_H

#include "between.h"
#include "fade.h"
#include "finite.h"

/* Light of the screen, times opacity where it says so; 0: nothing. Four numbers in a row. */
K_STRUCT(ssr_reflected) {
    v3 color;
    real opacity;
};

/* Position on the screen, in [0, 1] where it is on it. */
K_STRUCT(ssr_place) {
    real x;
    real y;
};

K_FN ssr_reflected ssr_no_reflected(void) {
    ssr_reflected l;
    l.color = v3_of(R(0.0), R(0.0), R(0.0));
    l.opacity = R(0.0);
    return l;
}

K_FN ssr_place ssr_place_before(real px, real py, real width, real height, real motion_x,
                                real motion_y) {
    ssr_place p;
    p.x = px / width - motion_x;
    p.y = py / height - motion_y;
    return p;
}

K_FN bool ssr_is_on_screen(ssr_place p) {
    return k_and(k_and(p.x >= R(0.0), p.x <= R(1.0)), k_and(p.y >= R(0.0), p.y <= R(1.0)));
}

/* Level of a pyramid that grows with roughness. */
K_FN real ssr_rough_level(real roughness, kint levels) {
    return k_saturate(roughness) * k_from_int(levels - K_INT(1));
}

/* The level below it and the one above, `step` 0 and 1, and how much of each is taken. */
K_FN kint ssr_level_at(real level, kint step, kint levels) {
    return ssr_inside(k_to_int(k_floor(level)) + step, levels);
}

K_FN real ssr_level_share(real level, kint step) {
    real above = level - k_floor(level);
    return k_select(step != K_INT(0), above, R(1.0) - above);
}

K_FN bool ssr_is_light(v3 c) {
    bool finite = k_and(k_and(ssr_is_finite(c.x), ssr_is_finite(c.y)), ssr_is_finite(c.z));
    bool above = k_and(k_and(c.x >= R(0.0), c.y >= R(0.0)), c.z >= R(0.0));
    return k_and(finite, above);
}

/* Light that is there whole. */
K_FN ssr_reflected ssr_whole(v3 color) {
    ssr_reflected l;
    l.color = color;
    l.opacity = R(1.0);
    return l;
}

/* What a ray found: the colour at a place and the fade there. */
K_FN ssr_reflected ssr_found(ssr_place p, v3 color, real edge_fade) {
    bool usable = k_and(ssr_is_on_screen(p), ssr_is_light(color));
    ssr_reflected l;
    l.color = v3_select(usable, color, v3_of(R(0.0), R(0.0), R(0.0)));
    real fade = ssr_edge_fade(p.x, edge_fade) * ssr_edge_fade(p.y, edge_fade);
    l.opacity = k_select(usable, fade, R(0.0));
    return l;
}

#endif
