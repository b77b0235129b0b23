/* Accumulate: the reflection of the frame before, found again where the surface was, held to the range of
 * the present neighbourhood, and blended. */
#include "bands.h"
#include "block.h"

/* Pixels of a row. */
typedef struct moved {
    float px[BLOCK], z[BLOCK], motion_z[BLOCK];
    float motion_x[BLOCK], motion_y[BLOCK];       /* of the surface */
    float reflected_x[BLOCK], reflected_y[BLOCK]; /* of what the ray met */
    kint used[BLOCK];                             /* 1: has a history */
    kint there[BLOCK];                            /* where the surface was: pixel */
    float before_x[BLOCK], before_y[BLOCK], expected[BLOCK], share[BLOCK];
    /* of the pixels and one more on either side: the range, of 3 rows and then of 3 x 3 */
    float low[4 * (BLOCK + 2)], high[4 * (BLOCK + 2)];
} moved;

/* ---- Where surfaces were --------------------------------------------------------------------- */

static void read_pixel(moved *m, int i, const ssr_band *b, size_t pixel, int x) {
    const lobe_ssr_ray *ray = &b->s->rays[pixel];
    float motion[2] = {0.0f, 0.0f}, reflected[2] = {0.0f, 0.0f};
    if (b->f->motion) {
        memcpy(motion, b->f->motion + 2 * pixel, sizeof motion);
        const size_t met = (size_t)ray->y * (size_t)b->s->width + (size_t)ray->x;
        if (ray->x >= 0) memcpy(reflected, b->f->motion + 2 * met, sizeof reflected);
    }
    m->px[i] = (float)x + 0.5f;
    m->z[i] = b->f->z[pixel];
    m->motion_z[i] = b->f->motion_z ? b->f->motion_z[pixel] : 0.0f;
    m->motion_x[i] = motion[0];
    m->motion_y[i] = motion[1];
    m->reflected_x[i] = reflected[0];
    m->reflected_y[i] = reflected[1];
    m->used[i] = k_flag(ray->state != LOBE_SSR_NO_RAY);
}

/* Pixels a frame. */
K_FN float speed_of(float x, float y, ssr_camera c) {
    return ssr_speed(ssr_usable_motion(x, y), ssr_usable_motion(y, x), c.width, c.height);
}

static void find_places(moved *m, int n, const ssr_band *b, const ssr_camera *now_at,
                        const ssr_camera *last_at, float py) {
    const ssr_camera now = *now_at, last = *last_at;
    const lobe_ssr_options *o = &b->s->options;
    const float accumulation = o->accumulation;
    const float rejection = o->speed_rejection * o->speed_scale;
    const kint width = b->s->width;
    const bool moves = b->f->motion_z != NULL;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const float z = ssr_usable_z(m->z[i], now.near_z, now.far_z);
        const float x = ssr_usable_motion(m->motion_x[i], m->motion_y[i]);
        const float y = ssr_usable_motion(m->motion_y[i], m->motion_x[i]);
        const ssr_place before = ssr_pixel_before(m->px[i], py, now, x, y);
        const bool used =
            k_and(k_and(k_is(m->used[i]), z > 0.0f), ssr_on_screen(last, before.x, before.y));
        m->before_x[i] = k_select(used, before.x, 0.0f);
        m->before_y[i] = k_select(used, before.y, 0.0f);
        m->there[i] = (kint)m->before_y[i] * width + (kint)m->before_x[i];
        m->expected[i] = k_select(moves, ssr_moved_z(z, m->motion_z[i]),
                                  ssr_expected_z(now, last, m->px[i], py, z));
        m->used[i] = k_flag(used);
        m->share[i] = ssr_new_share(accumulation, speed_of(x, y, now),
                                    speed_of(m->reflected_x[i], m->reflected_y[i], now), rejection);
    }
}

/* Not where another surface was. */
static void reject_others(moved *m, int n, const float *last_z) {
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const float expected = m->expected[i];
        const bool same = ssr_is_same_surface(expected, last_z[m->there[i]]);
        m->used[i] = k_flag(k_and(k_is(m->used[i]), k_and(expected > 0.0f, same)));
    }
}

/* ---- What is seen around --------------------------------------------------------------------- */

static void repeat_pixel(moved *m, int to, int from) {
    memcpy(m->low + 4 * to, m->low + 4 * from, 4 * sizeof *m->low);
    memcpy(m->high + 4 * to, m->high + 4 * from, 4 * sizeof *m->high);
}

/* Element 0 of `m->low`, `m->high` is the pixel before the block. Beyond the edge of the screen stands its last
 * pixel once more, which changes no range. */
static void range_of_rows(moved *m, const lobe_ssr *s, int x, int y, int n) {
    const int first = x > 0 ? x - 1 : 0, end = x + n < s->width ? x + n + 1 : s->width;
    const float *rows[3];
    for (int k = 0; k < 3; k++)
        rows[k] = s->resolved +
                  4 * ((size_t)ssr_inside(y + k - 1, s->height) * (size_t)s->width + (size_t)first);
    const int count = 4 * (end - first);
    float *low = m->low + 4 * (first - x + 1), *high = m->high + 4 * (first - x + 1);
#pragma omp simd
    for (int i = 0; i < count; i++) {
        low[i] = k_min(k_min(k_min(K_HUGE, rows[0][i]), rows[1][i]), rows[2][i]);
        high[i] = k_max(k_max(k_max(-K_HUGE, rows[0][i]), rows[1][i]), rows[2][i]);
    }
    if (x == 0) repeat_pixel(m, 0, 1);
    if (end == x + n) repeat_pixel(m, n + 1, n);
}

/* Element i of 3 columns from element i on. */
static void range_of_columns(moved *m, int n) {
#pragma omp simd
    for (int i = 0; i < 4 * n; i++) {
        m->low[i] = k_min(k_min(m->low[i], m->low[i + 4]), m->low[i + 8]);
        m->high[i] = k_max(k_max(m->high[i], m->high[i + 4]), m->high[i + 8]);
    }
}

/* ---- Blending -------------------------------------------------------------------------------- */

/* The last frame's reflection between pixels. */
K_FN ssr_reflected history_at(const lobe_ssr *s, float x, float y) {
    const ssr_between b = ssr_between_of(x, y);
    ssr_reflected sum = ssr_no_reflected();
    K_UNROLL
    for (int k = 0; k < 4; k++) {
        const size_t tx = (size_t)ssr_inside(ssr_corner_x(b, k), s->width);
        const size_t ty = (size_t)ssr_inside(ssr_corner_y(b, k), s->height);
        sum = ssr_add_reflected(
            sum, ssr_reflected_at(s->history + 4 * (ty * (size_t)s->width + tx)), ssr_share(b, k));
    }
    return sum;
}

static void blend(const moved *m, int n, const lobe_ssr *s, const float *resolved, float *out) {
    memcpy(out, resolved, 4 * (size_t)n * sizeof *out);
    for (int i = 0; i < n; i++, out += 4) {
        if (!k_is(m->used[i])) continue;
        const ssr_range range = {ssr_reflected_at(m->low + 4 * i),
                                 ssr_reflected_at(m->high + 4 * i)};
        const ssr_reflected history =
            ssr_held(history_at(s, m->before_x[i], m->before_y[i]), range);
        ssr_put_reflected(out, ssr_blend(history, ssr_reflected_at(out), m->share[i]));
    }
}

/* n pixels of row y from x on. */
static void accumulate_block(const ssr_band *b, const ssr_camera *now, const ssr_camera *last,
                             moved *m, int x, int y, int n) {
    const lobe_ssr *s = b->s;
    const size_t pixel = (size_t)y * (size_t)s->width + (size_t)x;
    for (int i = 0; i < n; i++) read_pixel(m, i, b, pixel + (size_t)i, x + i);
    const int whole = whole_vectors(n);
    find_places(m, whole, b, now, last, (float)y + 0.5f);
    reject_others(m, whole, s->last_z);
    range_of_rows(m, s, x, y, n);
    range_of_columns(m, n);
    blend(m, n, s, s->resolved + 4 * pixel, s->reflection + 4 * pixel);
}

void SSR_SYMBOL(accumulate)(const ssr_band *b) {
    const ssr_camera now = lobe_ssr_kernel_camera(b->s, &b->f->camera);
    const ssr_camera last = lobe_ssr_kernel_camera(b->s, &b->f->previous_camera);
    const size_t width = (size_t)b->s->width, first = (size_t)b->first * width;
    if (b->s->frame == 0) {
        const size_t values = 4 * (size_t)(b->end - b->first) * width;
        memcpy(b->s->reflection + 4 * first, b->s->resolved + 4 * first, values * sizeof(float));
        return;
    }
    moved m;
    memset(&m, 0, sizeof m);
    for (int y = b->first; y < b->end; y++)
        for (int x = 0; x < b->s->width; x += BLOCK)
            accumulate_block(b, &now, &last, &m, x, y,
                             b->s->width - x < BLOCK ? b->s->width - x : BLOCK);
}

/* For the next frame. */
void SSR_SYMBOL(keep_z)(const ssr_band *b) {
    const size_t width = (size_t)b->s->width;
    const float near_z = b->f->camera.near_z, far_z = b->f->camera.far_z;
    const float *z = b->f->z;
    float *last_z = b->s->last_z;
#pragma omp simd
    for (size_t i = (size_t)b->first * width; i < (size_t)b->end * width; i++)
        last_z[i] = ssr_usable_z(z[i], near_z, far_z);
}
