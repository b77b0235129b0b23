/* Trace: one ray a pixel, drawn from the surface's lobe and marched through the depth pyramid. */
#include "pipeline.h"

int lobe_ssr_has_bias(lobe_method method) {
    return method != LOBE_METHOD_SLOPE && method != LOBE_METHOD_SLOPE_PUBLISHED;
}

static facet_draw draw_ray(const lobe_ssr *s, const ssr_surface *surface, int x, int y) {
    const lobe_ssr_options *o = &s->options;
    const v3 v = surface->to_viewer;
    if (o->mode == LOBE_SSR_MIRROR) return ssr_mirror_draw(v);
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = o->mode == LOBE_SSR_NDF ? LOBE_METHOD_NDF : o->method;
    const lobe_reflection_f32 model = lobe_reflection_prepare_f32(
        options, (lobe_vec3_f32){v.x, v.y, v.z}, surface->alpha_x, surface->alpha_y);
    const ssr_noise u =
        ssr_biased(ssr_noise_of(s->noise, (kword)x, (kword)y), o->bias, o->mode == LOBE_SSR_NDF);
    const lobe_reflection_draw_f32 d = lobe_reflection_sample_f32(&model, u.u1, u.u2, u.u3);
    return (facet_draw){.wo = v3_of(d.wo.x, d.wo.y, d.wo.z), .pdf = d.pdf, .weight = d.weight};
}

/* What a cell of the pyramid holds. Without the farthest depth nothing is known of what lies behind. */
static ssr_cell cell_at(const lobe_ssr *s, int level, int x, int y) {
    const pyramid *p = &s->pyramid;
    x = x < p->width[level] ? x : p->width[level] - 1;
    y = y < p->height[level] ? y : p->height[level] - 1;
    ssr_cell cell = p->depth[level][(size_t)y * (size_t)p->width[level] + (size_t)x];
    if (s->options.as_hdrp && level > 0) cell.farthest = 0.0f;
    return cell;
}

/* The march; `ray` receives what was met. */
static void march(const lobe_ssr *s, ssr_ray r, ssr_slab slab, lobe_ssr_ray *ray) {
    const int highest = s->options.linear_march ? 0 : s->pyramid.levels - 1;
    ssr_march m = ssr_march_start(r);
    int x = 0, y = 0;
    while (m.state == SSR_MARCH_GOES && ray->steps < s->options.max_iterations) {
        x = ssr_march_x(r, m);
        y = ssr_march_y(r, m);
        const ssr_cell cell = cell_at(s, m.level, x, y);
        m = ssr_march_step(r, m, slab, x, y, cell.nearest, cell.farthest, highest);
        ray->steps++;
    }
    int sees_sky = 0;
    if (s->options.reflect_sky && ssr_leaves_far(r, m)) {
        m = ssr_march_at_end(r, m);
        x = ssr_march_x(r, m);
        y = ssr_march_y(r, m);
        sees_sky = cell_at(s, 0, x, y).nearest == 0.0f;
    }
    ray->state = ssr_state_of(m, sees_sky);
    if (ray->state == LOBE_SSR_MISS) return;
    ray->x = x < s->width ? x : s->width - 1;
    ray->y = y < s->height ? y : s->height - 1;
    ray->length = ssr_march_length(r, m);
}

static int is_traced(const lobe_ssr *s, const lobe_ssr_frame *f, size_t pixel) {
    if (f->mask && !f->mask[pixel]) return 0;
    return ssr_roughness_fade(f->roughness[pixel], s->options.fade_start, s->options.fade_end) >
           0.0f;
}

static lobe_ssr_ray trace_pixel(const lobe_ssr *s, const lobe_ssr_frame *f, const ssr_camera *c,
                                ssr_slab slab, int x, int y) {
    const size_t pixel = (size_t)y * (size_t)s->width + (size_t)x;
    lobe_ssr_ray ray = {.x = -1, .y = -1, .state = LOBE_SSR_NO_RAY};
    ssr_surface surface;
    if (!is_traced(s, f, pixel) || !lobe_ssr_surface_at(c, f, x, y, &surface)) return ray;
    const facet_draw draw = draw_ray(s, &surface, x, y);
    const v3 direction = ssr_to_world(surface, draw.wo);
    ray.direction = (lobe_vec3_f32){direction.x, direction.y, direction.z};
    ray.pdf = draw.pdf;
    ray.weight = draw.weight;
    ray.state = LOBE_SSR_REJECTED;
    if (!ssr_is_kept(draw)) return ray;
    const float z = ssr_start_z(surface, lobe_ssr_z_at(f, pixel));
    march(s, ssr_ray_of(*c, (float)x + 0.5f, (float)y + 0.5f, z, direction), slab, &ray);
    return ray;
}

void lobe_ssr_pass_trace(lobe_ssr *s, const lobe_ssr_frame *f, lobe_ssr_statistics *statistics) {
    const ssr_camera c = lobe_ssr_kernel_camera(s, &f->camera);
    const ssr_slab slab = ssr_slab_of(c, s->options.thickness);
    s->noise = lobe_ssr_noise_keys(s->options.seed, s->frame);
    uint64_t rays = 0, rejected = 0, hits = 0, steps = 0;
#pragma omp parallel for schedule(dynamic, 4) num_threads(s->threads)                              \
    reduction(+ : rays, rejected, hits, steps)
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            const lobe_ssr_ray ray = trace_pixel(s, f, &c, slab, x, y);
            s->rays[(size_t)y * (size_t)s->width + (size_t)x] = ray;
            rays += ray.state != LOBE_SSR_NO_RAY;
            rejected += ray.state == LOBE_SSR_REJECTED;
            hits += ray.state == LOBE_SSR_HIT || ray.state == LOBE_SSR_SKY;
            steps += (uint64_t)ray.steps;
        }
    statistics->rays = rays;
    statistics->rejected = rejected;
    statistics->hits = hits;
    statistics->steps = steps;
}
