/* Reproject: where what a ray met was on the screen one frame ago, its colour there, and how far the edge
 * of the screen fades it. */
#include <math.h>

#include "pipeline.h"

v3 lobe_ssr_color_between(const float *rgb, int width, int height, const float p[2]) {
    const float px = p[0] * (float)width - 0.5f, py = p[1] * (float)height - 0.5f;
    const int x0 = (int)floorf(px), y0 = (int)floorf(py);
    const float tx = px - floorf(px), ty = py - floorf(py);
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 4; k++) {
        const float share = (k & 1 ? tx : 1.0f - tx) * (k & 2 ? ty : 1.0f - ty);
        const int x = x0 + (k & 1), y = y0 + (k >> 1);
        const int cx = x < 0 ? 0 : x >= width ? width - 1 : x;
        const int cy = y < 0 ? 0 : y >= height ? height - 1 : y;
        if (share > 0.0f)
            sum = v3_add(
                sum, v3_scale(ssr_v3(rgb + 3 * ((size_t)cy * (size_t)width + (size_t)cx)), share));
    }
    return sum;
}

/* APPROX takes the level of the colour pyramid that grows with roughness. */
static v3 color_at(const lobe_ssr *s, const lobe_ssr_frame *f, float roughness, const float p[2]) {
    if (s->options.resolve != LOBE_SSR_APPROX)
        return lobe_ssr_color_between(f->previous_color, s->width, s->height, p);
    const float level = k_saturate(roughness) * (float)(s->pyramid.levels - 1);
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 2; k++) {
        const int at = (int)level + k;
        const float share = k ? level - floorf(level) : 1.0f - (level - floorf(level));
        if (!(share > 0.0f)) continue;
        const float *rgb = at == 0 ? f->previous_color : s->pyramid.color[at];
        const v3 color =
            lobe_ssr_color_between(rgb, s->pyramid.width[at], s->pyramid.height[at], p);
        sum = v3_add(sum, v3_scale(color, share));
    }
    return sum;
}

static int is_light(v3 c) {
    return v3_is_finite(c) && c.x >= 0.0f && c.y >= 0.0f && c.z >= 0.0f;
}

/* r, g, b and the fade of what the ray of a pixel met; 0 where that cannot be known. */
static void look_up(const lobe_ssr *s, const lobe_ssr_frame *f, size_t pixel, float found[4]) {
    const lobe_ssr_ray *ray = &s->rays[pixel];
    for (int k = 0; k < 4; k++) found[k] = 0.0f;
    if (ray->state != LOBE_SSR_HIT && ray->state != LOBE_SSR_SKY) return;
    float motion[2];
    lobe_ssr_motion_at(f, (size_t)ray->y * (size_t)s->width + (size_t)ray->x, motion);
    const float p[2] = {((float)ray->x + 0.5f) / (float)s->width - motion[0],
                        ((float)ray->y + 0.5f) / (float)s->height - motion[1]};
    if (!(p[0] >= 0.0f && p[0] <= 1.0f && p[1] >= 0.0f && p[1] <= 1.0f)) return;
    const v3 c = color_at(s, f, f->roughness[pixel], p);
    if (!is_light(c)) return;
    found[0] = c.x;
    found[1] = c.y;
    found[2] = c.z;
    found[3] =
        ssr_edge_fade(p[0], s->options.edge_fade) * ssr_edge_fade(p[1], s->options.edge_fade);
}

void lobe_ssr_pass_reproject(lobe_ssr *s, const lobe_ssr_frame *f) {
#pragma omp parallel for schedule(static) num_threads(s->threads)
    for (size_t i = 0; i < ssr_pixels(s); i++) look_up(s, f, i, s->found + 4 * i);
}
