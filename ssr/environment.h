/* Light between the texels and levels of an environment. */
#ifndef LOBE_SSR_ENVIRONMENT_H
#define LOBE_SSR_ENVIRONMENT_H

#include "pipeline.h"

K_FN v3 ssr_environment_texel(const lobe_ssr_environment *e, int level, int x, int y) {
    x = ssr_around(x, e->width);
    y = ssr_inside(y, e->height);
    const int at = 3 * ((level * e->height + y) * e->width + x);
    return ssr_usable_light(v3_of(e->rgb[at], e->rgb[at + 1], e->rgb[at + 2]));
}

K_FN v3 ssr_environment_level(const lobe_ssr_environment *e, int level, ssr_between b) {
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    K_UNROLL
    for (int k = 0; k < 4; k++)
        sum = ssr_add_share(sum,
                            ssr_environment_texel(e, level, ssr_corner_x(b, k), ssr_corner_y(b, k)),
                            ssr_share(b, k));
    return sum;
}

/* Of an environment that has texels. */
K_FN v3 ssr_environment_light(const lobe_ssr_environment *e, v3 direction, float roughness) {
    const ssr_between b = ssr_environment_place(direction, e->width, e->height);
    const float level = ssr_rough_level(roughness, e->levels);
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    K_UNROLL
    for (int k = 0; k < 2; k++)
        sum = ssr_add_share(sum, ssr_environment_level(e, ssr_level_at(level, k, e->levels), b),
                            ssr_level_share(level, k));
    return sum;
}

#endif
