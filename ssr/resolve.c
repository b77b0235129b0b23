/* Resolve: the colour of a pixel from its own ray and those of its neighbours. */
#include <math.h>

#include "pipeline.h"

/* The pixel that is resolved. */
typedef struct resolved_pixel {
    ssr_surface surface;
    lobe_reflection_f32 model; /* of NEIGHBOURHOOD_RATIO */
    v3 world_to_viewer;
} resolved_pixel;

static v3 to_frame(const ssr_surface *s, v3 d) {
    return v3_of(v3_dot(d, s->x), v3_dot(d, s->y), v3_dot(d, s->z));
}

/* Value over density of a neighbour's ray, for this pixel. */
static float ratio_weight(const resolved_pixel *p, const lobe_ssr_ray *ray, v3 direction) {
    const v3 wo = to_frame(&p->surface, direction);
    const lobe_reflection_eval_f32 e =
        lobe_reflection_eval_wo_f32(&p->model, (lobe_vec3_f32){wo.x, wo.y, wo.z});
    return ray->pdf > 0.0f ? k_usable(e.f_cos / ray->pdf) : 0.0f;
}

static float weight_of(const lobe_ssr *s, const resolved_pixel *p, const lobe_ssr_ray *ray,
                       int is_own) {
    const v3 direction = v3_of(ray->direction.x, ray->direction.y, ray->direction.z);
    if (ray->state == LOBE_SSR_NO_RAY) return 0.0f;
    if (s->options.as_hdrp) {
        if (ray->state == LOBE_SSR_REJECTED) return 1.0f;
        const float alpha = 0.5f * (p->surface.alpha_x + p->surface.alpha_y);
        return ssr_visible_weight(p->world_to_viewer, direction, alpha, alpha);
    }
    if (ray->state == LOBE_SSR_REJECTED) return 0.0f;
    if (s->options.resolve == LOBE_SSR_NEIGHBOURHOOD)
        return ssr_visible_weight(p->surface.to_viewer, to_frame(&p->surface, direction),
                                  p->surface.alpha_x, p->surface.alpha_y);
    /* a mirror's ray is its neighbours' no more */
    if (s->options.mode == LOBE_SSR_MIRROR || p->model.is_mirror) return is_own ? 1.0f : 0.0f;
    return ratio_weight(p, ray, direction);
}

static void add_ray(float sum[5], const float found[4], float weight) {
    for (int k = 0; k < 3; k++) sum[k] += weight * found[3] * found[k];
    sum[3] += weight * found[3];
    sum[4] += weight;
}

static void gather(const lobe_ssr *s, const resolved_pixel *p, int x, int y, float out[4]) {
    float sum[5] = {0.0f};
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const int nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= s->width || ny >= s->height) continue;
            const size_t neighbour = (size_t)ny * (size_t)s->width + (size_t)nx;
            add_ray(sum, s->found + 4 * neighbour,
                    weight_of(s, p, &s->rays[neighbour], dx == 0 && dy == 0));
        }
    for (int k = 0; k < 4; k++) out[k] = sum[4] > 0.0f ? sum[k] / sum[4] : 0.0f;
}

static resolved_pixel pixel_of(const lobe_ssr *s, const ssr_surface *surface) {
    resolved_pixel p = {.surface = *surface};
    const v3 v = surface->to_viewer;
    p.world_to_viewer = v3_combine(surface->x, v.x, surface->y, v.y, surface->z, v.z);
    if (s->options.resolve != LOBE_SSR_NEIGHBOURHOOD_RATIO) return p;
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = LOBE_METHOD_ELLIPSOID; /* the value does not depend on it */
    p.model = lobe_reflection_prepare_f32(options, (lobe_vec3_f32){v.x, v.y, v.z}, surface->alpha_x,
                                          surface->alpha_y);
    return p;
}

static void resolve_pixel(const lobe_ssr *s, const lobe_ssr_frame *f, const ssr_camera *c, int x,
                          int y, float out[4]) {
    const size_t pixel = (size_t)y * (size_t)s->width + (size_t)x;
    for (int k = 0; k < 4; k++) out[k] = 0.0f;
    ssr_surface surface;
    if (s->rays[pixel].state == LOBE_SSR_NO_RAY || !lobe_ssr_surface_at(c, f, x, y, &surface))
        return;
    if (s->options.resolve == LOBE_SSR_APPROX) {
        float own[5] = {0.0f};
        add_ray(own, s->found + 4 * pixel, 1.0f);
        for (int k = 0; k < 4; k++) out[k] = own[k];
    } else {
        const resolved_pixel p = pixel_of(s, &surface);
        gather(s, &p, x, y, out);
    }
    const float fade =
        ssr_roughness_fade(f->roughness[pixel], s->options.fade_start, s->options.fade_end);
    for (int k = 0; k < 4; k++) out[k] *= fade;
}

void lobe_ssr_pass_resolve(lobe_ssr *s, const lobe_ssr_frame *f) {
    const ssr_camera c = lobe_ssr_kernel_camera(s, &f->camera);
#pragma omp parallel for schedule(dynamic, 4) num_threads(s->threads)
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++)
            resolve_pixel(s, f, &c, x, y,
                          s->resolved + 4 * ((size_t)y * (size_t)s->width + (size_t)x));
}
