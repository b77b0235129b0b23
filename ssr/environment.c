/* Prefiltered light from everywhere, interpolated over directions and roughness. */
#include "pipeline.h"

static v3 texel_at(const lobe_ssr_environment *e, int level, int x, int y) {
    x = ssr_around(x, e->width);
    y = ssr_inside(y, e->height);
    const size_t texel = ((size_t)level * (size_t)e->height + (size_t)y) * (size_t)e->width;
    return ssr_usable_light(ssr_v3(e->rgb + 3 * (texel + (size_t)x)));
}

static v3 level_at(const lobe_ssr_environment *e, int level, ssr_between b) {
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 4; k++)
        sum = ssr_add_share(sum, texel_at(e, level, ssr_corner_x(b, k), ssr_corner_y(b, k)),
                            ssr_share(b, k));
    return sum;
}

v3 lobe_ssr_environment_at(const lobe_ssr_environment *e, v3 direction, float roughness) {
    if (!e->rgb) return v3_of(0.0f, 0.0f, 0.0f);
    const ssr_between b = ssr_environment_place(direction, e->width, e->height);
    const float level = ssr_rough_level(roughness, e->levels);
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 2; k++)
        sum = ssr_add_share(sum, level_at(e, ssr_level_at(level, k, e->levels), b),
                            ssr_level_share(level, k));
    return sum;
}
