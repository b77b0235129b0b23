/* Resolve: the colour of a pixel from its own ray and those of its neighbours. */
#include "pipeline.h"

static float weight_of(const lobe_ssr *s, const ssr_resolved *p, const lobe_ssr_ray *ray,
                       int is_own) {
    const v3 direction = v3_of(ray->direction.x, ray->direction.y, ray->direction.z);
    if (s->options.as_hdrp) return ssr_hdrp_weight(*p, ray->state, direction);
    return ssr_ray_weight(*p, ray->state, direction, ray->pdf, is_own,
                          s->options.mode == LOBE_SSR_MIRROR, (kint)s->options.resolve);
}

static ssr_sum gather(const lobe_ssr *s, const ssr_resolved *p, int x, int y) {
    ssr_sum sum = ssr_no_sum();
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const int nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= s->width || ny >= s->height) continue;
            const size_t neighbour = (size_t)ny * (size_t)s->width + (size_t)nx;
            sum = ssr_add_ray(sum, ssr_reflected_at(s->found + 4 * neighbour),
                              weight_of(s, p, &s->rays[neighbour], dx == 0 && dy == 0));
        }
    return sum;
}

static void resolve_pixel(const lobe_ssr *s, const lobe_ssr_frame *f, const ssr_camera *c, int x,
                          int y, float out[4]) {
    const size_t pixel = (size_t)y * (size_t)s->width + (size_t)x;
    for (int k = 0; k < 4; k++) out[k] = 0.0f;
    ssr_surface surface;
    if (s->rays[pixel].state == LOBE_SSR_NO_RAY || !lobe_ssr_surface_at(c, f, x, y, &surface))
        return;
    ssr_sum sum;
    if (s->options.resolve == LOBE_SSR_APPROX) {
        sum = ssr_add_ray(ssr_no_sum(), ssr_reflected_at(s->found + 4 * pixel), 1.0f);
    } else {
        const ssr_resolved p = ssr_resolved_of(surface);
        sum = gather(s, &p, x, y);
    }
    const float fade =
        ssr_roughness_fade(f->roughness[pixel], s->options.fade_start, s->options.fade_end);
    ssr_put_reflected(out, ssr_mean_of(sum, fade));
}

void lobe_ssr_pass_resolve(lobe_ssr *s, const lobe_ssr_frame *f) {
    const ssr_camera c = lobe_ssr_kernel_camera(s, &f->camera);
#pragma omp parallel for schedule(dynamic, 4) num_threads(s->threads)
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++)
            resolve_pixel(s, f, &c, x, y,
                          s->resolved + 4 * ((size_t)y * (size_t)s->width + (size_t)x));
}
