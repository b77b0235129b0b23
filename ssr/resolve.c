/* Resolve: the colour of a pixel from its own ray and those of its neighbours. */
#include "bands.h"
#include "block.h"

/* ---- What rays found ------------------------------------------------------------------------- */

enum { REACH = 2, ROWS = 2 * REACH + 1 }; /* of any way */
enum { AROUND = BLOCK + 16 }; /* a block, REACH pixels on either side, and whole vectors */

/* Rays of a row from REACH pixels before the block to as many after; off the screen there is none. */
typedef struct row {
    float x[AROUND], y[AROUND], z[AROUND], pdf[AROUND]; /* direction in the world, density */
    float r[AROUND], g[AROUND], b[AROUND], fade[AROUND];
    kint state[AROUND];
} row;

static void read_ray(const lobe_ssr *s, row *to, int i, int x, int y) {
    if (x < 0 || y < 0 || x >= s->width || y >= s->height) {
        to->x[i] = to->y[i] = to->z[i] = to->pdf[i] = 0.0f;
        to->r[i] = to->g[i] = to->b[i] = to->fade[i] = 0.0f;
        to->state[i] = SSR_NO_RAY;
        return;
    }
    const size_t pixel = (size_t)y * (size_t)s->width + (size_t)x;
    const lobe_ssr_ray *ray = &s->rays[pixel];
    to->x[i] = ray->direction.x;
    to->y[i] = ray->direction.y;
    to->z[i] = ray->direction.z;
    to->pdf[i] = ray->pdf;
    to->state[i] = ray->state;
    const float *found = s->found + 4 * pixel;
    to->r[i] = found[0];
    to->g[i] = found[1];
    to->b[i] = found[2];
    to->fade[i] = found[3];
}

static void read_row(const lobe_ssr *s, row *to, int x, int y, int n) {
    for (int i = 0; i < n + 2 * REACH; i++) read_ray(s, to, i, x - REACH + i, y);
}

/* ---- Sums over them -------------------------------------------------------------------------- */

/* What ssr_resolved has of a pixel beside its surface. */
typedef struct bases {
    v3_block wi, world_to_viewer;
    float ax[BLOCK], ay[BLOCK], inv_ax[BLOCK], inv_ay[BLOCK];
    float t_i[BLOCK], d_peak[BLOCK], value_scale[BLOCK];
    kint valid[BLOCK], mirror[BLOCK];
} bases;

typedef struct around {
    surfaces at;
    bases bases;
    row rows[ROWS]; /* row y in row_at */
    v3_block color;
    float opacity[BLOCK], weight[BLOCK];
} around;

K_FN row *row_at(around *a, int y) {
    return &a->rows[(y + ROWS) % ROWS];
}

static void make_bases(around *a, int n) {
    bases *b = &a->bases;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const ssr_resolved p = ssr_resolved_of(surface_in(&a->at, i));
        put_v3(&b->wi, i, p.g.wi);
        put_v3(&b->world_to_viewer, i, p.world_to_viewer);
        b->ax[i] = p.g.ax;
        b->ay[i] = p.g.ay;
        b->inv_ax[i] = p.g.inv_ax;
        b->inv_ay[i] = p.g.inv_ay;
        b->t_i[i] = p.g.t_i;
        b->d_peak[i] = p.g.d_peak;
        b->value_scale[i] = p.g.value_scale;
        b->valid[i] = p.g.valid;
        b->mirror[i] = p.g.mirror;
    }
}

K_FN ssr_resolved resolved_in(const around *a, int i) {
    const bases *b = &a->bases;
    return (ssr_resolved){.surface = surface_in(&a->at, i),
                          .world_to_viewer = v3_in(&b->world_to_viewer, i),
                          .g = {.wi = v3_in(&b->wi, i),
                                .ax = b->ax[i],
                                .ay = b->ay[i],
                                .inv_ax = b->inv_ax[i],
                                .inv_ay = b->inv_ay[i],
                                .t_i = b->t_i[i],
                                .d_peak = b->d_peak[i],
                                .value_scale = b->value_scale[i],
                                .valid = b->valid[i],
                                .mirror = b->mirror[i],
                                .plane = v3_of(0.0f, 0.0f, 1.0f)}};
}

K_FN ssr_reflected found_in(const row *r, int i) {
    return (ssr_reflected){.color = v3_of(r->r[i], r->g[i], r->b[i]), .opacity = r->fade[i]};
}

K_FN ssr_sum sum_in(const around *a, int i) {
    return (ssr_sum){
        .color = v3_in(&a->color, i), .opacity = a->opacity[i], .weight = a->weight[i]};
}

K_FN void put_sum(around *a, int i, ssr_sum sum) {
    put_v3(&a->color, i, sum.color);
    a->opacity[i] = sum.opacity;
    a->weight[i] = sum.weight;
}

/* HDRP's own weight, beside the ways of passes/resolve.h. */
enum { AS_HDRP = SSR_OWN + 1 };

/* Adds to the sums of n pixels, whole vectors, the rays of a row from element `first` on. */
K_FN void add_rays(around *a, int n, const row *r, int first, bool is_own, bool mirrors, kint way) {
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const ssr_resolved p = resolved_in(a, i);
        const int k = first + i;
        const v3 direction = v3_of(r->x[k], r->y[k], r->z[k]);
        const float weight = way == AS_HDRP ? ssr_hdrp_weight(p, r->state[k], direction)
                                            : ssr_ray_weight(p, r->state[k], direction, r->pdf[k],
                                                             is_own, mirrors, way);
        put_sum(a, i, ssr_add_ray(sum_in(a, i), found_in(r, k), weight));
    }
}

K_FN void add_neighbours(around *a, int y, int n, bool mirrors, kint way) {
    const int reach = ssr_gather_reach(way);
    for (int dy = -reach; dy <= reach; dy++)
        for (int dx = -reach; dx <= reach; dx++)
            if (ssr_gathers(dx, dy))
                add_rays(a, n, row_at(a, y + dy), REACH + dx, dx == 0 && dy == 0, mirrors, way);
}

/* The pixel's own ray alone. */
static void take_own(around *a, int y, int n) {
    const row *own = row_at(a, y);
#pragma omp simd
    for (int i = 0; i < n; i++)
        put_sum(a, i, ssr_add_ray(ssr_no_sum(), found_in(own, i + REACH), 1.0f));
}

static void clear_sums(around *a, int n) {
    for (int i = 0; i < n; i++) put_sum(a, i, ssr_no_sum());
}

/* A way to weigh, a loop: each becomes vectors by itself. */
static void add_all(around *a, int y, int n, const lobe_ssr_options *o) {
    const bool mirrors = o->mode == LOBE_SSR_MIRROR;
    clear_sums(a, n);
    if (ssr_is_alone((kint)o->resolve)) {
        take_own(a, y, n);
        return;
    }
    make_bases(a, n);
    if (o->as_hdrp)
        add_neighbours(a, y, n, mirrors, AS_HDRP);
    else if (o->resolve == LOBE_SSR_NEIGHBOURHOOD)
        add_neighbours(a, y, n, mirrors, SSR_NEIGHBOURHOOD);
    else if (o->resolve == LOBE_SSR_NEIGHBOURHOOD_RATIO)
        add_neighbours(a, y, n, mirrors, SSR_NEIGHBOURHOOD_RATIO);
    else
        add_neighbours(a, y, n, mirrors, SSR_CONFIDENCE);
}

/* From sums to means; 0 where there is no ray. */
static void make_means(around *a, int y, int n, const lobe_ssr_options *o) {
    const row *own = row_at(a, y);
    const float start = o->fade_start, end = o->fade_end;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const float fade = ssr_roughness_fade(a->at.roughness[i], start, end);
        const ssr_reflected mean = ssr_mean_of(sum_in(a, i), fade);
        const bool is_used = k_and(own->state[i + REACH] != SSR_NO_RAY, k_is(a->at.seen[i]));
        put_v3(&a->color, i, v3_select(is_used, mean.color, v3_of(0.0f, 0.0f, 0.0f)));
        a->opacity[i] = k_select(is_used, mean.opacity, 0.0f);
    }
}

/* ---- Pixels ---------------------------------------------------------------------------------- */

static int has_ray(const row *r, int n) {
    int any = 0;
    for (int i = REACH; i < n + REACH; i++) any |= r->state[i] != SSR_NO_RAY;
    return any;
}

static void write_pixels(const around *a, int n, float *out) {
    for (int i = 0; i < n; i++) {
        out[4 * i] = a->color.x[i];
        out[4 * i + 1] = a->color.y[i];
        out[4 * i + 2] = a->color.z[i];
        out[4 * i + 3] = a->opacity[i];
    }
}

/* n pixels of row y from x on; of the rows around, the last one is still to be read. */
static void resolve_block(const ssr_band *b, const ssr_camera *c, around *a, int x, int y, int n) {
    const size_t pixel = (size_t)y * (size_t)b->s->width + (size_t)x;
    float *out = b->s->resolved + 4 * pixel;
    read_row(b->s, row_at(a, y + REACH), x, y + REACH, n);
    if (!has_ray(row_at(a, y), n)) {
        memset(out, 0, 4 * (size_t)n * sizeof *out);
        return;
    }
    read_surfaces(&a->at, b->f, pixel, x, y, n);
    const int whole = whole_vectors(n);
    make_surfaces(&a->at, whole, c, b->f);
    add_all(a, y, whole, &b->s->options);
    make_means(a, y, whole, &b->s->options);
    write_pixels(a, n, out);
}

void SSR_SYMBOL(resolve)(const ssr_band *b) {
    const ssr_camera c = lobe_ssr_kernel_camera(b->s, &b->f->camera);
    around a;
    memset(&a, 0, sizeof a);
    for (int x = 0; x < b->s->width; x += BLOCK) {
        const int n = b->s->width - x < BLOCK ? b->s->width - x : BLOCK;
        for (int y = b->first - REACH; y < b->first + REACH; y++)
            read_row(b->s, row_at(&a, y), x, y, n);
        for (int y = b->first; y < b->end; y++) resolve_block(b, &c, &a, x, y, n);
    }
}
