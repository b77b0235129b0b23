/* Truth: the reflection of the same G-buffer by real rays, and what it says of the traced ones. */
#include <math.h>

#include "between.h"
#include "frames.h"
#include "lobe/metrics.h"
#include "lobe/random.h"
#include "message.h"

/* What real rays start from. */
typedef struct real_pixel {
    ssr_surface surface;
    v3 place; /* off the surface, so that a ray does not meet it again */
    v3 geometric;
} real_pixel;

static int real_pixel_at(const lobe_ssr_frames *f, const ssr_camera *c, int x, int y,
                         real_pixel *p) {
    lobe_ray_surface met;
    float length;
    if (!lobe_ssr_surface_at(c, &f->frame, x, y, &p->surface)) return 0;
    const v3 direction =
        ssr_unit(ssr_view_vector(*c, (float)x + 0.5f, (float)y + 0.5f, 1.0f), &length);
    if (!lobe_rays_meet(f->now.rays, ssr_out(c->eye), ssr_out(direction), &met)) return 0;
    p->geometric = ssr_in(met.geometric);
    const float height = 1e-4f * (met.distance + k_sqrt(v3_dot(c->eye, c->eye)));
    p->place = v3_add(ssr_in(met.position), v3_scale(p->geometric, height));
    return 1;
}

/* Whether a place was seen at z by a camera whose depths these are: within two percent. */
static int is_seen(const ssr_camera *c, const float *z, v3 at) {
    if (!(at.z > 0.0f) || !ssr_on_screen(*c, at.x, at.y)) return 0;
    const float there = z[(size_t)at.y * (size_t)c->width + (size_t)at.x];
    return there > 0.0f && fabsf(there - at.z) <= 0.02f * at.z;
}

/* The same for what lies without end in a direction. */
static int is_sky_seen(const ssr_camera *c, const float *z, v3 direction, v3 *at) {
    *at = ssr_project(*c, v3_add(c->eye, v3_scale(direction, 1e6f * c->near_z)));
    return at->z > 0.0f && ssr_on_screen(*c, at->x, at->y) &&
           !(z[(size_t)at->y * (size_t)c->width + (size_t)at->x] > 0.0f);
}

/* The light of a real ray; *screen: it came from the frame before. */
static v3 real_light(const lobe_ssr_frames *f, const ssr_camera *previous, const real_pixel *p,
                     v3 direction, uint64_t stream, int *screen) {
    lobe_ray_surface met;
    v3 at = v3_of(0.0f, 0.0f, 0.0f);
    lobe_vec3_f32 was;
    const int meets = lobe_rays_meet(f->now.rays, ssr_out(p->place), ssr_out(direction), &met);
    if (meets && lobe_rays_find(lobe_ssr_moment_before(f)->rays, f->now.rays, &met.place, &was))
        at = ssr_project(*previous, ssr_in(was));
    *screen = meets ? is_seen(previous, f->previous_z, at)
                    : is_sky_seen(previous, f->previous_z, direction, &at);
    if (*screen)
        return ssr_color_between(f->color, (int)previous->width, (int)previous->height,
                                 at.x / previous->width, at.y / previous->height);
    if (!meets) return ssr_in(lobe_rays_environment(f->now.rays, ssr_out(direction)));
    return ssr_in(lobe_rays_light(f->now.rays, ssr_out(p->place), ssr_out(direction),
                                  f->options.seed + 1, stream, 0, 1));
}

static lobe_reflection_draw_f32 draw_real(const real_pixel *p, lobe_ssr_mode mode, uint64_t stream,
                                          int index, int rays) {
    const v3 v = p->surface.to_viewer;
    if (mode == LOBE_SSR_MIRROR) {
        lobe_reflection_draw_f32 d = {.wo = {-v.x, -v.y, v.z}, .pdf = 1.0f, .weight = 1.0f};
        return d;
    }
    const lobe_reflection_f32 model = lobe_reflection_prepare_f32(
        lobe_reflection_default_options(), (lobe_vec3_f32){v.x, v.y, v.z}, p->surface.alpha_x,
        p->surface.alpha_y);
    const lobe_random4 r = lobe_random(77, stream, (uint64_t)index);
    const float u = ((float)index + lobe_random_unit_f32(r.word[0])) / (float)rays;
    return lobe_reflection_sample_f32(&model, u, lobe_random_unit_f32(r.word[1]), 0.0f);
}

typedef struct truth_work {
    const lobe_ssr_frames *f;
    ssr_camera camera, previous;
    lobe_ssr_mode mode;
    int rays;
    float *rgb, *on_screen;
} truth_work;

static void truth_pixel(const truth_work *w, int x, int y) {
    const size_t pixel = (size_t)y * (size_t)w->camera.width + (size_t)x;
    float *rgb = w->rgb + 3 * pixel;
    rgb[0] = rgb[1] = rgb[2] = w->on_screen[pixel] = 0.0f;
    real_pixel p;
    if (!real_pixel_at(w->f, &w->camera, x, y, &p)) return;
    const int is_mirror = w->mode == LOBE_SSR_MIRROR ||
                          k_max(p.surface.alpha_x, p.surface.alpha_y) < (float)LOBE_ALPHA_MIN;
    const int rays = is_mirror ? 1 : w->rays;
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    float weights = 0.0f, screens = 0.0f;
    for (int i = 0; i < rays; i++) {
        const lobe_reflection_draw_f32 d =
            draw_real(&p, is_mirror ? LOBE_SSR_MIRROR : w->mode, pixel, i, rays);
        const v3 to = v3_combine(p.surface.x, d.wo.x, p.surface.y, d.wo.y, p.surface.z, d.wo.z);
        if (!(d.weight > 0.0f) || !(v3_dot(to, p.geometric) > 0.0f)) continue;
        int screen;
        const v3 light =
            real_light(w->f, &w->previous, &p, to, pixel * (uint64_t)rays + (uint64_t)i, &screen);
        sum = v3_add(sum, v3_scale(light, d.weight));
        weights += d.weight;
        screens += screen ? d.weight : 0.0f;
    }
    if (!(weights > 0.0f)) return;
    rgb[0] = sum.x / weights;
    rgb[1] = sum.y / weights;
    rgb[2] = sum.z / weights;
    w->on_screen[pixel] = screens / weights;
}

static void truth_row(void *work, int y) {
    const truth_work *w = work;
    for (int x = 0; x < w->f->options.width; x++) truth_pixel(w, x, y);
}

lobe_ssr_result lobe_ssr_truth(lobe_ssr_frames *f, lobe_ssr_mode mode, int rays, float *rgb,
                               float *on_screen) {
    if (rays < 1 || rays > 1000000)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "truth: %d rays are out of range; use 1 to 1000000", rays);
    const float width = (float)f->options.width, height = (float)f->options.height;
    truth_work w = {f,
                    lobe_ssr_camera_of(&f->frame.camera, width, height),
                    lobe_ssr_camera_of(&f->frame.previous_camera, width, height),
                    mode,
                    rays,
                    rgb,
                    on_screen};
    if (!lobe_ssr_rows(f, truth_row, &w, 0.0, 1.0))
        return lobe_ssr_fail(LOBE_SSR_INTERRUPTED, "truth: interrupted; start again");
    return LOBE_SSR_OK;
}

/* ---- Judging --------------------------------------------------------------------------------- */

/* How a traced ray ended, against the real one: 0 right, 1 a false hit, 2 a false miss. *distance: of a right
 * hit, from the real place in pixels; negative otherwise. */
static int verdict_of(const lobe_ssr_frames *f, const ssr_camera *c, const real_pixel *p,
                      const lobe_ssr_ray *ray, float *distance) {
    *distance = -1.0f;
    const v3 direction = ssr_in(ray->direction);
    const int claims = ssr_meets(ray->state);
    lobe_ray_surface met;
    v3 at;
    const int meets = lobe_rays_meet(f->now.rays, ssr_out(p->place), ray->direction, &met);
    if (meets) at = ssr_project(*c, ssr_in(met.position));
    const int seen = meets ? is_seen(c, f->z, at) : is_sky_seen(c, f->z, direction, &at);
    if (!claims) return seen ? 2 : 0;
    if (!seen || meets != (ray->state == LOBE_SSR_HIT)) return 1;
    const float across = fabsf(at.x - (float)ray->x - 0.5f),
                down = fabsf(at.y - (float)ray->y - 0.5f);
    if (!(across <= 3.0f && down <= 3.0f)) return 1;
    *distance = hypotf(across, down);
    return 0;
}

static double squared_error(const float *a, const float *b) {
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        const double difference = (double)a[k] - (double)b[k];
        sum += difference * difference / lobe_relative_scale((double)b[k]);
    }
    return sum / 3.0;
}

lobe_ssr_judgement lobe_ssr_judge(const lobe_ssr_frames *f, const lobe_ssr *ssr, const float *rgb,
                                  const float *on_screen) {
    const int width = f->options.width;
    const ssr_camera c =
        lobe_ssr_camera_of(&f->frame.camera, (float)width, (float)f->options.height);
    lobe_ssr_judgement j = {0};
    uint64_t rays = 0, hits = 0, verdicts[3] = {0};
    for (int y = 0; y < f->options.height; y++)
        for (int x = 0; x < width; x++) {
            const size_t pixel = (size_t)y * (size_t)width + (size_t)x;
            const lobe_ssr_ray *ray = &lobe_ssr_rays(ssr)[pixel];
            real_pixel p;
            if (ray->state == LOBE_SSR_NO_RAY || !real_pixel_at(f, &c, x, y, &p)) continue;
            const double error = squared_error(lobe_ssr_radiance(ssr) + 3 * pixel, rgb + 3 * pixel);
            j.relmse += error;
            j.pixels++;
            if (on_screen[pixel] >= 0.5f) {
                j.relmse_onscreen += error;
                j.pixels_onscreen++;
            }
            if (ray->state == LOBE_SSR_REJECTED) continue;
            float distance;
            verdicts[verdict_of(f, &c, &p, ray, &distance)]++;
            if (distance >= 0.0f) {
                j.hit_distance += (double)distance;
                hits++;
            }
            rays++;
        }
    j.relmse /= fmax(1.0, (double)j.pixels);
    j.relmse_onscreen /= fmax(1.0, (double)j.pixels_onscreen);
    j.hit_distance /= fmax(1.0, (double)hits);
    j.false_hits = (double)verdicts[1] / fmax(1.0, (double)rays);
    j.false_misses = (double)verdicts[2] / fmax(1.0, (double)rays);
    return j;
}
