/* Reproject: where what a ray met was on the screen one frame ago, its colour there, and how far the edge
 * of the screen fades it. */
#include "pipeline.h"

v3 lobe_ssr_color_between(const float *rgb, int width, int height, const float p[2]) {
    const ssr_between b = ssr_between_of(p[0] * (float)width, p[1] * (float)height);
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 4; k++) {
        const size_t x = (size_t)ssr_inside(ssr_corner_x(b, k), width);
        const size_t y = (size_t)ssr_inside(ssr_corner_y(b, k), height);
        sum = ssr_add_share(sum, ssr_v3(rgb + 3 * (y * (size_t)width + x)), ssr_share(b, k));
    }
    return sum;
}

/* APPROX takes the level of the colour pyramid that grows with roughness. */
static v3 color_at(const lobe_ssr *s, const lobe_ssr_frame *f, float roughness, const float p[2]) {
    if (s->options.resolve != LOBE_SSR_APPROX)
        return lobe_ssr_color_between(f->previous_color, s->width, s->height, p);
    const float level = ssr_rough_level(roughness, s->pyramid.levels);
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 2; k++) {
        const int at = ssr_level_at(level, k, s->pyramid.levels);
        const float *rgb = at == 0 ? f->previous_color : s->pyramid.color[at];
        const v3 color =
            lobe_ssr_color_between(rgb, s->pyramid.width[at], s->pyramid.height[at], p);
        sum = ssr_add_share(sum, color, ssr_level_share(level, k));
    }
    return sum;
}

/* r, g, b and the fade of what the ray of a pixel met; 0 where that cannot be known. */
static void look_up(const lobe_ssr *s, const lobe_ssr_frame *f, size_t pixel, float found[4]) {
    const lobe_ssr_ray *ray = &s->rays[pixel];
    for (int k = 0; k < 4; k++) found[k] = 0.0f;
    if (ray->state != LOBE_SSR_HIT && ray->state != LOBE_SSR_SKY) return;
    float motion[2];
    lobe_ssr_motion_at(f, (size_t)ray->y * (size_t)s->width + (size_t)ray->x, motion);
    const ssr_place p = ssr_place_before((float)ray->x + 0.5f, (float)ray->y + 0.5f,
                                         (float)s->width, (float)s->height, motion[0], motion[1]);
    if (!ssr_is_on_screen(p)) return;
    const v3 c = color_at(s, f, f->roughness[pixel], (float[2]){p.x, p.y});
    ssr_put_reflected(found, ssr_found(p, c, s->options.edge_fade));
}

void lobe_ssr_pass_reproject(lobe_ssr *s, const lobe_ssr_frame *f) {
#pragma omp parallel for schedule(static) num_threads(s->threads)
    for (size_t i = 0; i < ssr_pixels(s); i++) look_up(s, f, i, s->found + 4 * i);
}
