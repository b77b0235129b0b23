/* Trace: one ray a pixel, drawn from the surface's lobe and marched through the depth pyramid. */
#include <math.h>

#include "pipeline.h"

/* Draws of less are dropped: the cosine above the surface, and the weight. */
static const float least = 1e-3f;

int lobe_ssr_has_bias(lobe_method method) {
    return method != LOBE_METHOD_SLOPE && method != LOBE_METHOD_SLOPE_PUBLISHED;
}

static lobe_reflection_draw_f32 mirror_draw(v3 to_viewer) {
    return (lobe_reflection_draw_f32){
        .wo = {-to_viewer.x, -to_viewer.y, to_viewer.z}, .pdf = 1.0f, .weight = 1.0f};
}

static lobe_reflection_draw_f32 draw_ray(const lobe_ssr *s, const ssr_surface *surface, int x,
                                         int y) {
    const lobe_ssr_options *o = &s->options;
    if (o->mode == LOBE_SSR_MIRROR) return mirror_draw(surface->to_viewer);
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = o->mode == LOBE_SSR_NDF ? LOBE_METHOD_NDF : o->method;
    const lobe_vec3_f32 wi = {surface->to_viewer.x, surface->to_viewer.y, surface->to_viewer.z};
    const lobe_reflection_f32 model =
        lobe_reflection_prepare_f32(options, wi, surface->alpha_x, surface->alpha_y);
    float u[3];
    lobe_ssr_noise(s, x, y, u);
    /* the number that tells how far from the centre of the lobe a draw lies */
    u[options.model.method == LOBE_METHOD_NDF ? 0 : 1] *= 1.0f - o->bias;
    return lobe_reflection_sample_f32(&model, u[0], u[1], u[2]);
}

/* What a cell of the pyramid holds. Without the farthest depth nothing is known of what lies behind. */
static depth_cell cell_at(const lobe_ssr *s, int level, int x, int y) {
    const pyramid *p = &s->pyramid;
    x = x < p->width[level] ? x : p->width[level] - 1;
    y = y < p->height[level] ? y : p->height[level] - 1;
    depth_cell cell = p->depth[level][(size_t)y * (size_t)p->width[level] + (size_t)x];
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
        const depth_cell cell = cell_at(s, m.level, x, y);
        m = ssr_march_step(r, m, slab, x, y, cell.nearest, cell.farthest, highest);
        ray->steps++;
    }
    ray->state = LOBE_SSR_MISS;
    if (m.state == SSR_MARCH_LEFT && s->options.reflect_sky && k_is(r.valid)) {
        /* out through the far plane, where nothing stands before it */
        const float depth = r.origin.z + r.end * r.direction.z;
        m.q = r.end;
        m.level = 0;
        x = ssr_march_x(r, m);
        y = ssr_march_y(r, m);
        if (depth < 1e-6f && r.end > 0.0f && cell_at(s, 0, x, y).nearest == 0.0f)
            ray->state = LOBE_SSR_SKY;
    }
    if (m.state == SSR_MARCH_HIT) ray->state = LOBE_SSR_HIT;
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
    const lobe_reflection_draw_f32 draw = draw_ray(s, &surface, x, y);
    const v3 direction =
        v3_combine(surface.x, draw.wo.x, surface.y, draw.wo.y, surface.z, draw.wo.z);
    ray.direction = (lobe_vec3_f32){direction.x, direction.y, direction.z};
    ray.pdf = draw.pdf;
    ray.weight = draw.weight;
    ray.state = LOBE_SSR_REJECTED;
    if (!(draw.wo.z >= least) || !(draw.weight >= least)) return ray;
    /* against meeting itself: toward the viewer, the more the flatter it is seen */
    const float pull = 1.0f - 0.001f / k_max(surface.to_viewer.z, 1e-3f);
    const float z = lobe_ssr_z_at(f, pixel) * k_max(pull, 1e-3f);
    march(s, ssr_ray_of(*c, (float)x + 0.5f, (float)y + 0.5f, z, direction), slab, &ray);
    return ray;
}

void lobe_ssr_pass_trace(lobe_ssr *s, const lobe_ssr_frame *f, lobe_ssr_statistics *statistics) {
    const ssr_camera c = lobe_ssr_kernel_camera(s, &f->camera);
    const ssr_slab slab = ssr_slab_of(c, s->options.thickness);
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
