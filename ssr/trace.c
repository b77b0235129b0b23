/* Trace: one ray a pixel, drawn from the surface's lobe and marched through the depth pyramid. Rays are drawn
 * a block of pixels at a time and marched in a pool, a step for all; where one ends, another takes its place. */
#include "lobe/batch.h"

#include "bands.h"
#include "block.h"

/* ---- Rays under way -------------------------------------------------------------------------- */

enum { POOL = 2 * BLOCK - 16 };

enum {
    ORIGIN_X,
    ORIGIN_Y,
    ORIGIN_Z,
    DIRECTION_X,
    DIRECTION_Y,
    DIRECTION_Z,
    INVERSE_X,
    INVERSE_Y,
    END,
    AXIS_Z,
    SLOPE,
    NORM,
    AT, /* q of the march */
    FLOATS
};

/* START: of the level, in cells; CELL: what the last step looked at */
enum { LEVEL, START, BELOW, STATE, STEPS, CELL_X, CELL_Y, VALID, PIXEL, INTEGERS };

typedef struct pool {
    int count;
    float f[FLOATS][POOL];
    kint n[INTEGERS][POOL];
} pool;

/* What all rays of a frame share. */
typedef struct march {
    const ssr_cell *cells;
    int last_x, last_y; /* of the finest level */
    int highest, most_steps, as_hdrp;
    float push;
    ssr_slab slab;
} march;

K_FN ssr_ray ray_in(const pool *p, int i, float push) {
    return (ssr_ray){.origin = v3_of(p->f[ORIGIN_X][i], p->f[ORIGIN_Y][i], p->f[ORIGIN_Z][i]),
                     .direction =
                         v3_of(p->f[DIRECTION_X][i], p->f[DIRECTION_Y][i], p->f[DIRECTION_Z][i]),
                     .inverse_x = p->f[INVERSE_X][i],
                     .inverse_y = p->f[INVERSE_Y][i],
                     .end = p->f[END][i],
                     .push = push,
                     .axis_z = p->f[AXIS_Z][i],
                     .slope = p->f[SLOPE][i],
                     .norm = p->f[NORM][i],
                     .valid = p->n[VALID][i]};
}

K_FN ssr_march march_in(const pool *p, int i) {
    return (ssr_march){.q = p->f[AT][i],
                       .level = p->n[LEVEL][i],
                       .below = p->n[BELOW][i],
                       .state = p->n[STATE][i]};
}

K_FN void put_ray(pool *p, int i, ssr_ray r, ssr_march m) {
    p->f[ORIGIN_X][i] = r.origin.x;
    p->f[ORIGIN_Y][i] = r.origin.y;
    p->f[ORIGIN_Z][i] = r.origin.z;
    p->f[DIRECTION_X][i] = r.direction.x;
    p->f[DIRECTION_Y][i] = r.direction.y;
    p->f[DIRECTION_Z][i] = r.direction.z;
    p->f[INVERSE_X][i] = r.inverse_x;
    p->f[INVERSE_Y][i] = r.inverse_y;
    p->f[END][i] = r.end;
    p->f[AXIS_Z][i] = r.axis_z;
    p->f[SLOPE][i] = r.slope;
    p->f[NORM][i] = r.norm;
    p->f[AT][i] = m.q;
    p->n[LEVEL][i] = m.level;
    p->n[BELOW][i] = m.below;
    p->n[STATE][i] = m.state;
    p->n[START][i] = p->n[STEPS][i] = p->n[CELL_X][i] = p->n[CELL_Y][i] = 0;
    p->n[VALID][i] = r.valid;
}

/* The last ray takes the place of ray i. */
static void remove_ray(pool *p, int i) {
    const int last = --p->count;
    for (int k = 0; k < FLOATS; k++) p->f[k][i] = p->f[k][last];
    for (int k = 0; k < INTEGERS; k++) p->n[k][i] = p->n[k][last];
}

/* ---- The march ------------------------------------------------------------------------------- */

static march march_of(const ssr_band *b, const ssr_camera *c) {
    const pyramid *p = &b->s->pyramid;
    const lobe_ssr_options *o = &b->s->options;
    return (march){.cells = p->depth[0],
                   .last_x = b->s->width - 1,
                   .last_y = b->s->height - 1,
                   .highest = o->linear_march ? 0 : p->levels - 1,
                   .most_steps = o->max_iterations,
                   .as_hdrp = o->as_hdrp,
                   .push = ssr_ray_push(*c),
                   .slab = ssr_slab_of(*c, o->thickness)};
}

/* Cells of a level: it covers the one below to its last row and column. */
K_FN kint cells_of(march s, kint level) {
    return (k_down(s.last_x, level) + 1) * (k_down(s.last_y, level) + 1);
}

/* Where the next level starts: they lie behind one another. */
K_FN kint next_start(march s, kint start, kint level, kint next) {
    const kint up = start + cells_of(s, level);
    const kint down = start - cells_of(s, level > 0 ? level - 1 : 0);
    return ssr_pick(next > level, up, ssr_pick(next < level, down, start));
}

/* One step of each ray that goes on. */
static void step_all(const march *shared, pool *p) {
    const march s = *shared;
    const int n = whole_vectors(p->count);
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const ssr_ray r = ray_in(p, i, s.push);
        const ssr_march m = march_in(p, i);
        const bool goes = k_and(m.state == SSR_MARCH_GOES, p->n[STEPS][i] < s.most_steps);
        const kint x = ssr_march_x(r, m), y = ssr_march_y(r, m);
        const kint last_x = k_down(s.last_x, m.level), last_y = k_down(s.last_y, m.level);
        const kint inside_x = x < last_x ? x : last_x, inside_y = y < last_y ? y : last_y;
        const kint start = p->n[START][i];
        const kint cell = start + inside_y * (last_x + 1) + inside_x;
        const float nearest = s.cells[cell].nearest;
        /* without the farthest depth nothing is known of what lies behind */
        const float farthest =
            k_select(k_and(s.as_hdrp != 0, m.level > 0), 0.0f, s.cells[cell].farthest);
        const ssr_march next = ssr_march_step(r, m, s.slab, x, y, nearest, farthest, s.highest);
        p->f[AT][i] = k_select(goes, next.q, m.q);
        p->n[LEVEL][i] = ssr_pick(goes, next.level, m.level);
        p->n[START][i] = ssr_pick(goes, next_start(s, start, m.level, next.level), start);
        p->n[BELOW][i] = ssr_pick(goes, next.below, m.below);
        p->n[STATE][i] = ssr_pick(goes, next.state, m.state);
        p->n[STEPS][i] += k_flag(goes);
        p->n[CELL_X][i] = ssr_pick(goes, x, p->n[CELL_X][i]);
        p->n[CELL_Y][i] = ssr_pick(goes, y, p->n[CELL_Y][i]);
    }
}

/* What the ray in place i met. */
static void finish(const lobe_ssr *s, const march *shared, const pool *p, int i,
                   ssr_counts *counts) {
    const ssr_ray r = ray_in(p, i, shared->push);
    ssr_march m = march_in(p, i);
    int x = p->n[CELL_X][i], y = p->n[CELL_Y][i];
    const int leaves = s->options.reflect_sky && ssr_leaves_far(r, m);
    if (leaves) {
        m = ssr_march_at_end(r, m);
        x = ssr_march_x(r, m);
        y = ssr_march_y(r, m);
    }
    x = ssr_inside(x, s->width);
    y = ssr_inside(y, s->height);
    const size_t met = (size_t)y * (size_t)s->width + (size_t)x;
    const int sees_sky = leaves && shared->cells[met].nearest == 0.0f;
    lobe_ssr_ray *ray = &s->rays[p->n[PIXEL][i]];
    ray->state = ssr_state_of(m, sees_sky);
    ray->steps = p->n[STEPS][i];
    counts->steps += (uint64_t)ray->steps;
    if (!ssr_meets(ray->state)) return;
    counts->hits++;
    ray->x = x;
    ray->y = y;
    ray->length = ssr_march_length(r, m);
}

/* Takes out the rays that have ended. */
static void finish_all(const lobe_ssr *s, const march *shared, pool *p, ssr_counts *counts) {
    for (int i = 0; i < p->count;) {
        if (p->n[STATE][i] == SSR_MARCH_GOES && p->n[STEPS][i] < shared->most_steps) {
            i++;
            continue;
        }
        finish(s, shared, p, i, counts);
        remove_ray(p, i);
    }
}

/* How many steps a ray that has ended may wait for. */
enum { STEPS_BETWEEN = 4 };

/* Until at most `most` rays are under way. */
static void march_to(const lobe_ssr *s, const march *shared, pool *p, int most,
                     ssr_counts *counts) {
    finish_all(s, shared, p, counts);
    while (p->count > most) {
        for (int k = 0; k < STEPS_BETWEEN; k++) step_all(shared, p);
        finish_all(s, shared, p, counts);
    }
}

/* ---- Draws ----------------------------------------------------------------------------------- */

/* Pixels of a row, and what is drawn for them. */
typedef struct drawn {
    surfaces at;
    v3_block u, wo, direction;
    float pdf[BLOCK], weight[BLOCK];
    kint wanted[BLOCK], kept[BLOCK]; /* has a ray; that is traced */
} drawn;

/* Whether any of n pixels has a ray. */
static int find_wanted(const ssr_band *b, drawn *d, size_t pixel, int n) {
    const float start = b->s->options.fade_start, end = b->s->options.fade_end;
#pragma omp simd
    for (int i = 0; i < whole_vectors(n); i++)
        d->wanted[i] = k_flag(
            k_and(k_is(d->at.seen[i]), ssr_roughness_fade(d->at.roughness[i], start, end) > 0.0f));
    for (int i = 0; b->f->mask && i < n; i++)
        d->wanted[i] &= k_flag(b->f->mask[pixel + (size_t)i] != 0);
    kint any = 0;
    for (int i = 0; i < n; i++) any |= d->wanted[i];
    return k_is(any);
}

static void draw_mirrored(drawn *d, int n) {
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const facet_draw mirrored = ssr_mirror_draw(v3_in(&d->at.to_viewer, i));
        put_v3(&d->wo, i, mirrored.wo);
        d->pdf[i] = mirrored.pdf;
        d->weight[i] = mirrored.weight;
    }
}

/* From pixel (x, y) on. */
static void make_noise(const lobe_ssr *s, drawn *d, int x, int y, int n) {
    const ssr_noise_keys keys = s->noise;
    const float bias = s->options.bias;
    const bool by_first = s->options.mode == LOBE_SSR_NDF;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const ssr_noise u =
            ssr_biased(ssr_noise_of(keys, (kword)(x + i), (kword)y), bias, by_first);
        put_v3(&d->u, i, v3_of(u.u1, u.u2, u.u3));
    }
}

static void draw_lobe(const lobe_ssr *s, drawn *d, int x, int y, int n) {
    make_noise(s, d, x, y, n);
    const v3_block *v = &d->at.to_viewer;
    lobe_sample_batch_f32 batch = {.count = (size_t)n,
                                   .options = lobe_reflection_default_options(),
                                   .wi = {{v->x, 1}, {v->y, 1}, {v->z, 1}},
                                   .alpha = {{d->at.alpha_x, 1}, {d->at.alpha_y, 1}},
                                   .u = {{d->u.x, 1}, {d->u.y, 1}, {d->u.z, 1}},
                                   .wo = {{d->wo.x, 1}, {d->wo.y, 1}, {d->wo.z, 1}},
                                   .pdf = {d->pdf, 1},
                                   .weight = {d->weight, 1}};
    batch.options.model.method =
        s->options.mode == LOBE_SSR_NDF ? LOBE_METHOD_NDF : s->options.method;
    lobe_reflection_sample_batch_f32(&batch);
}

/* Puts the rays of the first n draws behind those under way. */
static void start_rays(drawn *d, int n, const ssr_camera *camera, pool *p) {
    const ssr_camera c = *camera;
    const int first = p->count;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const ssr_surface surface = surface_in(&d->at, i);
        const v3 wo = v3_in(&d->wo, i);
        v3 direction = ssr_to_world(surface, wo);
        put_v3(&d->direction, i, direction);
        const bool kept = ssr_is_kept((facet_draw){.wo = wo, .weight = d->weight[i]});
        d->kept[i] = k_flag(k_and(kept, k_is(d->wanted[i])));
        /* what is not traced shares steps for a while: it must lead nowhere that is not there */
        direction = v3_select(k_is(d->kept[i]), direction, v3_of(0.0f, 0.0f, 1.0f));
        const float z = ssr_start_z(surface, d->at.z[i]);
        const ssr_ray r = ssr_ray_of(c, d->at.px[i], d->at.py[i], z, direction);
        put_ray(p, first + i, r, ssr_march_start(r));
    }
}

/* Writes n draws, and takes out again the rays that are not traced. */
static void keep_rays(const drawn *d, int n, size_t pixel, lobe_ssr_ray *rays, pool *p,
                      ssr_counts *counts) {
    const int first = p->count;
    p->count += n;
    for (int i = n - 1; i >= 0; i--) {
        p->n[PIXEL][first + i] = (kint)(pixel + (size_t)i);
        const bool wanted = k_is(d->wanted[i]), kept = k_is(d->kept[i]);
        rays[i] =
            (lobe_ssr_ray){.direction = {d->direction.x[i], d->direction.y[i], d->direction.z[i]},
                           .pdf = d->pdf[i],
                           .weight = d->weight[i],
                           .x = -1,
                           .y = -1,
                           .state = LOBE_SSR_REJECTED};
        if (!wanted) rays[i] = (lobe_ssr_ray){.x = -1, .y = -1, .state = LOBE_SSR_NO_RAY};
        counts->rays += wanted;
        counts->rejected += wanted && !kept;
        if (!kept) remove_ray(p, first + i);
    }
}

/* Draws for n pixels of row y from x on, and starts their rays. */
static void draw_block(const ssr_band *b, const ssr_camera *c, drawn *d, pool *p, int x, int y,
                       int n, ssr_counts *counts) {
    const size_t pixel = (size_t)y * (size_t)b->s->width + (size_t)x;
    lobe_ssr_ray *rays = b->s->rays + pixel;
    const int whole = whole_vectors(n);
    read_surfaces(&d->at, b->f, pixel, x, y, n);
    make_surfaces(&d->at, whole, c, b->f);
    if (!find_wanted(b, d, pixel, n)) {
        for (int i = 0; i < n; i++)
            rays[i] = (lobe_ssr_ray){.x = -1, .y = -1, .state = LOBE_SSR_NO_RAY};
        return;
    }
    if (b->s->options.mode == LOBE_SSR_MIRROR)
        draw_mirrored(d, whole);
    else
        draw_lobe(b->s, d, x, y, whole);
    start_rays(d, whole, c, p);
    keep_rays(d, n, pixel, rays, p, counts);
}

void SSR_SYMBOL(trace)(const ssr_band *b, ssr_counts *counts) {
    const ssr_camera c = lobe_ssr_kernel_camera(b->s, &b->f->camera);
    const march shared = march_of(b, &c);
    const int width = b->s->width;
    pool p;
    memset(&p, 0, sizeof p);
    drawn d;
    memset(&d, 0, sizeof d);
    for (int y = b->first; y < b->end; y++)
        for (int x = 0; x < width; x += BLOCK) {
            draw_block(b, &c, &d, &p, x, y, width - x < BLOCK ? width - x : BLOCK, counts);
            march_to(b->s, &shared, &p, POOL - BLOCK, counts);
        }
    march_to(b->s, &shared, &p, 0, counts);
}
