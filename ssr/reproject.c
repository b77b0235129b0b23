/* Reproject: where what a ray met was on the screen one frame ago, its colour there, and how far the edge
 * of the screen fades it. */
#include "bands.h"
#include "between.h"
#include "block.h"
#include "environment.h"

/* Pixels whose rays met something. */
typedef struct met {
    int count;
    size_t pixel[BLOCK];
    float px[BLOCK], py[BLOCK]; /* what was met: its centre */
    float motion_x[BLOCK], motion_y[BLOCK], roughness[BLOCK];
    float x[BLOCK], y[BLOCK]; /* where it was, in [0, 1] across the screen; 0: not on it */
    kint on_screen[BLOCK];
} met;

/* Nothing was found yet; the next pixels whose rays met something, up to a block. */
static void find_rays(met *m, const ssr_band *b, size_t *pixel, size_t end) {
    const lobe_ssr *s = b->s;
    m->count = 0;
    for (; *pixel < end && m->count < BLOCK; ++*pixel) {
        const lobe_ssr_ray *ray = &s->rays[*pixel];
        memset(s->found + 4 * *pixel, 0, 4 * sizeof *s->found);
        if (!ssr_meets(ray->state)) continue;
        const int i = m->count++;
        const size_t there = (size_t)ray->y * (size_t)s->width + (size_t)ray->x;
        m->pixel[i] = *pixel;
        m->px[i] = (float)ray->x + 0.5f;
        m->py[i] = (float)ray->y + 0.5f;
        m->roughness[i] = b->f->roughness[*pixel];
        m->motion_x[i] = b->f->motion ? b->f->motion[2 * there] : 0.0f;
        m->motion_y[i] = b->f->motion ? b->f->motion[2 * there + 1] : 0.0f;
    }
}

static void find_places(met *m, int n, const lobe_ssr *s) {
    const float width = (float)s->width, height = (float)s->height;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const float x = ssr_usable_motion(m->motion_x[i], m->motion_y[i]);
        const float y = ssr_usable_motion(m->motion_y[i], m->motion_x[i]);
        const ssr_place p = ssr_place_before(m->px[i], m->py[i], width, height, x, y);
        const bool on_screen = ssr_is_on_screen(p);
        m->x[i] = k_select(on_screen, p.x, 0.0f);
        m->y[i] = k_select(on_screen, p.y, 0.0f);
        m->on_screen[i] = k_flag(on_screen);
    }
}

/* APPROX takes the level of the colour pyramid that grows with roughness. */
static v3 color_in_pyramid(const lobe_ssr *s, const lobe_ssr_frame *f, float roughness, float x,
                           float y) {
    const float level = ssr_rough_level(roughness, s->pyramid.levels);
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 2; k++) {
        const int at = ssr_level_at(level, k, s->pyramid.levels);
        const float *rgb = at == 0 ? f->previous_color : s->pyramid.color[at];
        const v3 color = ssr_color_between(rgb, s->pyramid.width[at], s->pyramid.height[at], x, y);
        sum = ssr_add_share(sum, color, ssr_level_share(level, k));
    }
    return sum;
}

static void look_up(const met *m, const ssr_band *b) {
    const lobe_ssr *s = b->s;
    const int approx = s->options.resolve == LOBE_SSR_APPROX;
    for (int i = 0; i < m->count; i++) {
        if (!k_is(m->on_screen[i])) continue;
        const ssr_place p = {m->x[i], m->y[i]};
        const v3 color =
            approx ? color_in_pyramid(s, b->f, m->roughness[i], p.x, p.y)
                   : ssr_color_between(b->f->previous_color, s->width, s->height, p.x, p.y);
        ssr_put_reflected(s->found + 4 * m->pixel[i], ssr_found(p, color, s->options.edge_fade));
    }
}

/* ---- Rays that left the screen --------------------------------------------------------------- */

typedef struct left {
    int count;
    size_t pixel[BLOCK];
    v3_block direction, light;
    float roughness[BLOCK];
} left;

/* The next of them, up to a block. */
static void find_left(left *l, const ssr_band *b, size_t *pixel, size_t end) {
    l->count = 0;
    for (; *pixel < end && l->count < BLOCK; ++*pixel) {
        const lobe_ssr_ray *ray = &b->s->rays[*pixel];
        if (ray->state != LOBE_SSR_MISS) continue;
        const int i = l->count++;
        l->pixel[i] = *pixel;
        l->roughness[i] = b->f->roughness[*pixel];
        put_v3(&l->direction, i, v3_of(ray->direction.x, ray->direction.y, ray->direction.z));
    }
}

static void look_around(left *l, int n, const lobe_ssr_environment *environment) {
    const lobe_ssr_environment e = *environment;
#pragma omp simd
    for (int i = 0; i < n; i++)
        put_v3(&l->light, i, ssr_environment_light(&e, v3_in(&l->direction, i), l->roughness[i]));
}

/* They find the environment in their direction. */
static void light_left(const ssr_band *b, size_t pixel, size_t end) {
    left l;
    memset(&l, 0, sizeof l);
    for (int i = 0; i < BLOCK; i++) l.direction.z[i] = 1.0f; /* what is no ray looks somewhere */
    while (pixel < end) {
        find_left(&l, b, &pixel, end);
        look_around(&l, whole_vectors(l.count), &b->f->environment);
        for (int i = 0; i < l.count; i++)
            ssr_put_reflected(b->s->found + 4 * l.pixel[i], ssr_whole(v3_in(&l.light, i)));
    }
}

/* ---- All ------------------------------------------------------------------------------------- */

void SSR_SYMBOL(reproject)(const ssr_band *b) {
    const size_t width = (size_t)b->s->width, end = (size_t)b->end * width;
    size_t pixel = (size_t)b->first * width;
    met m;
    memset(&m, 0, sizeof m);
    while (pixel < end) {
        find_rays(&m, b, &pixel, end);
        find_places(&m, whole_vectors(m.count), b->s);
        look_up(&m, b);
    }
    if (b->s->options.resolve == LOBE_SSR_CONFIDENCE && b->f->environment.rgb)
        light_left(b, (size_t)b->first * width, end);
}
