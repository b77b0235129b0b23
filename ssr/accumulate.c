/* Accumulate: the reflection of the frame before, found again where the surface was, held to the range of
 * the present neighbourhood, and blended. */
#include <string.h>

#include "pipeline.h"

/* The last frame's reflection between pixels; `p` in pixels, on the screen. */
static ssr_reflected history_at(const lobe_ssr *s, const float p[2]) {
    const ssr_between b = ssr_between_of(p[0], p[1]);
    ssr_reflected sum = ssr_no_reflected();
    for (int k = 0; k < 4; k++) {
        const size_t x = (size_t)ssr_inside(ssr_corner_x(b, k), s->width);
        const size_t y = (size_t)ssr_inside(ssr_corner_y(b, k), s->height);
        sum = ssr_add_reflected(sum, ssr_reflected_at(s->history + 4 * (y * (size_t)s->width + x)),
                                ssr_share(b, k));
    }
    return sum;
}

static ssr_range range_around(const lobe_ssr *s, int x, int y) {
    ssr_range range = ssr_no_range();
    for (int ny = y - 1; ny <= y + 1; ny++)
        for (int nx = x - 1; nx <= x + 1; nx++) {
            if (nx < 0 || ny < 0 || nx >= s->width || ny >= s->height) continue;
            const size_t neighbour = (size_t)ny * (size_t)s->width + (size_t)nx;
            range = ssr_widen(range, ssr_reflected_at(s->resolved + 4 * neighbour));
        }
    return range;
}

/* Pixels that something moved since the last frame. */
static float speed_at(const lobe_ssr *s, const lobe_ssr_frame *f, size_t pixel) {
    float m[2];
    lobe_ssr_motion_at(f, pixel, m);
    return ssr_speed(m[0], m[1], (float)s->width, (float)s->height);
}

/* Where the surface was in the last frame, in pixels; 0: not seen there. */
static int was_at(const lobe_ssr *s, const lobe_ssr_frame *f, const ssr_camera *now,
                  const ssr_camera *last, int x, int y, float p[2]) {
    const size_t pixel = (size_t)y * (size_t)s->width + (size_t)x;
    const float z = lobe_ssr_z_at(f, pixel);
    if (s->frame == 0 || !(z > 0.0f)) return 0;
    float m[2];
    lobe_ssr_motion_at(f, pixel, m);
    const ssr_place before = ssr_pixel_before((float)x + 0.5f, (float)y + 0.5f, *now, m[0], m[1]);
    p[0] = before.x;
    p[1] = before.y;
    if (!ssr_on_screen(*last, p[0], p[1])) return 0;
    const size_t there = (size_t)p[1] * (size_t)s->width + (size_t)p[0];
    const float expected = ssr_expected_z(*now, *last, (float)x + 0.5f, (float)y + 0.5f, z);
    return expected > 0.0f && ssr_is_same_surface(expected, s->last_z[there]);
}

static void accumulate_pixel(const lobe_ssr *s, const lobe_ssr_frame *f, const ssr_camera *now,
                             const ssr_camera *last, int x, int y, float out[4]) {
    const size_t pixel = (size_t)y * (size_t)s->width + (size_t)x;
    const lobe_ssr_options *o = &s->options;
    const lobe_ssr_ray *ray = &s->rays[pixel];
    float p[2];
    memcpy(out, s->resolved + 4 * pixel, 4 * sizeof *out);
    if (ray->state == LOBE_SSR_NO_RAY || !was_at(s, f, now, last, x, y, p)) return;
    const ssr_reflected history = ssr_held(history_at(s, p), range_around(s, x, y));
    const float reflected =
        ray->x < 0 ? 0.0f : speed_at(s, f, (size_t)ray->y * (size_t)s->width + (size_t)ray->x);
    const float share = ssr_new_share(o->accumulation, speed_at(s, f, pixel), reflected,
                                      o->speed_rejection * o->speed_scale);
    ssr_put_reflected(out, ssr_blend(history, ssr_reflected_at(out), share));
}

void lobe_ssr_pass_accumulate(lobe_ssr *s, const lobe_ssr_frame *f) {
    const ssr_camera now = lobe_ssr_kernel_camera(s, &f->camera);
    const ssr_camera last = lobe_ssr_kernel_camera(s, &f->previous_camera);
    float *swapped = s->history; /* what was the reflection is history now */
    s->history = s->reflection;
    s->reflection = swapped;
#pragma omp parallel for schedule(dynamic, 4) num_threads(s->threads)
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++)
            accumulate_pixel(s, f, &now, &last, x, y,
                             s->reflection + 4 * ((size_t)y * (size_t)s->width + (size_t)x));
#pragma omp parallel for num_threads(s->threads)
    for (size_t i = 0; i < ssr_pixels(s); i++) s->last_z[i] = lobe_ssr_z_at(f, i);
}
