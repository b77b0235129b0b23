#include "shading.h"

#include "row_loops.h"

/* ---- One by one ------------------------------------------------------------------------------ */

/* What few surfaces have, and all would pay for. */
typedef struct layers {
    glass glass;
    clearcoat clearcoat;
} layers;

/* The front of a solid, and both sides of all else. */
static void add_clearcoat(const integrator *k, const shading_point *p, surface *s,
                          clearcoat *room) {
    const lobe_scene *scene = k->scene;
    const hit_point *h = &p->hit;
    const material *m = h->material;
    if (!(m->clearcoat > 0.0f) || (h->is_back && is_solid(m))) return;
    const float share = m->clearcoat * hit_map(scene, &m->clearcoat_map, h, v3_all(1.0f)).x;
    const float roughness =
        m->clearcoat_roughness * hit_map(scene, &m->clearcoat_roughness_map, h, v3_all(1.0f)).y;
    const vec3 normal =
        lobe_hit_normal(scene, h, &m->clearcoat_normal_map, m->clearcoat_normal_scale);
    const frame f = frame_of(v3_scale(normal, h->is_back ? -1.0f : 1.0f), h->smooth.x);
    if (share > 0.0f)
        lobe_surface_add_clearcoat(s, room, &k->surface, k->coats[scene->material_count], f,
                                   p->to_viewer, share, roughness);
}

static uint64_t walk_seed(const integrator *k, const shading_point *p) {
    if (k->surface.multiscatter != LOBE_MULTISCATTER_WALK) return 0;
    const sampler_point point = lobe_sampler_next(p->numbers);
    return (uint64_t)point.bits[0] << 32 | point.bits[1];
}

static void make_surface(const integrator *k, const shading_point *p, surface *s, layers *room) {
    const hit_point *h = &p->hit;
    const material *m = h->material;
    const hit_looks *l = &p->looks;
    if (m->is_matte) {
        lobe_surface_make_matte(s, h->shading, h->geometric, l->base_color);
        return;
    }
    const uint64_t random = walk_seed(k, p);
    float metallic = l->metallic;
    /* of what is not glass, the same amount is metal */
    if (l->transmission > 0.0f) metallic /= maxf(1.0f - l->transmission, 1e-6f);
    surface_options options = k->surface;
    options.coat = k->coats[h->triangle->material];
    options.tint = lobe_hit_tint(k->scene, h);
    lobe_surface_make(s, &options, h->shading, h->geometric, p->to_viewer, l->base_color,
                      minf(metallic, 1.0f), l->roughness, l->anisotropy, random);
    if (l->transmission > 0.0f) {
        const float alpha = l->roughness * l->roughness;
        const glass_material g = {l->transmission,
                                  m->ior,
                                  !is_solid(m),
                                  l->base_color,
                                  alpha * (1.0f + l->anisotropy),
                                  alpha * (1.0f - l->anisotropy)};
        lobe_surface_add_glass(s, &room->glass, &k->surface, g, p->to_viewer, h->is_back);
    }
    add_clearcoat(k, p, s, &room->clearcoat);
}

static void shade_alone(const integrator *k, shading_point *p, int is_first) {
    surface s;
    layers room;
    make_surface(k, p, &s, &room);
    if (is_first && k->keeps_vndf_integral)
        p->vndf_integral = s.is_matte ? 1.0f : lobe_reflection_vndf_integral_f32(&s.ggx);
    p->has_glass = s.glass != NULL;
    /* the base below a coat that is a mirror still sees the lamps */
    p->value = v3_all(0.0f);
    if (p->light.pdf > 0.0f && !lobe_surface_is_clear(&s))
        p->value = lobe_surface_value(&s, p->light.direction, &p->value_pdf);
    p->roll = lobe_sampler_next(p->numbers);
    float side = 0.0f;
    if (s.glass) side = sampler_unit(lobe_sampler_next(p->numbers).bits[0]);
    p->draw = lobe_surface_draw(&s, sampler_unit(p->roll.bits[0]), sampler_unit(p->roll.bits[1]),
                                sampler_unit(p->roll.bits[2]), side);
}

/* ---- Side by side ---------------------------------------------------------------------------- */

/* Which loop shades a point. */
enum { ALONE = -1, MATTE = 2 * ROW_KERNEL_COUNT, CLASSES };

static int is_white(const coat_tint *t) {
    return t->most_one == 0.0f && t->one.x == 0.0f && t->one.y == 0.0f && t->one.z == 0.0f;
}

/* Whether the rows know all that a material may ask for. */
static int is_plain(const integrator *k, const material *m) {
    return k->surface.multiscatter == LOBE_MULTISCATTER_NONE &&
           (!k->surface.metal || k->surface.metal->law.law == LOBE_METAL_SCHLICK) &&
           !(m->transmission > 0.0f) && !(m->clearcoat > 0.0f) &&
           m->specular_map.texture == NO_TEXTURE && m->specular_color_map.texture == NO_TEXTURE &&
           is_white(&m->tint);
}

static int class_of(const integrator *k, const row_loops *loops, const shading_point *p,
                    int is_first) {
    const hit_point *h = &p->hit;
    const hit_looks *l = &p->looks;
    if (is_first && k->keeps_vndf_integral) return ALONE;
    if (h->material->is_matte) return MATTE;
    if (!is_plain(k, h->material)) return ALONE;
    const float alpha = l->roughness * l->roughness;
    if (!(alpha * (1.0f - fabsf(l->anisotropy)) >= ROW_ALPHA_MIN)) return ALONE;
    const float metallic = minf(l->metallic, 1.0f);
    const int kernel = lobe_row_kernel(loops, &k->surface.ggx.model, metallic, alpha,
                                       v3_dot(h->geometric, h->shading.z));
    if (kernel < 0 || metallic >= 1.0f) return kernel;
    const int is_round = l->anisotropy == 0.0f;
    const int is_common = k->coats[h->triangle->material] == k->coats[k->scene->material_count];
    return is_round && is_common ? kernel + ROW_KERNEL_COUNT : ALONE;
}

static void put(float to[3][ROWS], int i, vec3 v) {
    to[0][i] = v.x;
    to[1][i] = v.y;
    to[2][i] = v.z;
}

static vec3 get(float from[3][ROWS], int i) {
    return v3(from[0][i], from[1][i], from[2][i]);
}

static void write_row(shade_rows *r, int i, const shading_point *p) {
    const hit_point *h = &p->hit;
    const hit_looks *l = &p->looks;
    const float alpha = l->roughness * l->roughness;
    put(r->x, i, h->shading.x);
    put(r->y, i, h->shading.y);
    put(r->z, i, h->shading.z);
    put(r->geometric, i, h->geometric);
    put(r->to_viewer, i, p->to_viewer);
    put(r->to_light, i, p->light.direction);
    put(r->base_color, i, l->base_color);
    r->metallic[i] = minf(l->metallic, 1.0f);
    r->alpha_x[i] = alpha * (1.0f + l->anisotropy);
    r->alpha_y[i] = alpha * (1.0f - l->anisotropy);
    r->coat[i] = h->material->tint.most_own;
    for (int c = 0; c < 3; c++) r->u[c][i] = sampler_unit(p->roll.bits[c]);
}

static void read_row(shade_rows *r, int i, shading_point *p) {
    p->value = get(r->value, i);
    p->value_pdf = r->value_pdf[i];
    p->draw = (surface_draw){.direction = get(r->direction, i),
                             .weight = get(r->weight, i),
                             .pdf = r->pdf[i],
                             .is_ggx = r->is_ggx[i]};
}

static row_loop *loop_of(const row_loops *loops, int class) {
    if (class == MATTE) return loops->matte;
    return class < ROW_KERNEL_COUNT ? loops->metal[class] : loops->coated[class - ROW_KERNEL_COUNT];
}

static row_options options_of(const integrator *k) {
    const lobe_reflection_options *ggx = &k->surface.ggx;
    const coat_table *coat = k->coats[k->scene->material_count];
    return (row_options){.ior = coat->ior,
                         .coat_albedo = coat->round_albedo,
                         .coat_average = coat->round_average,
                         .floor_share = (float)ggx->floor,
                         .separable = ggx->g2 == LOBE_G2_SEPARABLE,
                         .previous = ggx->normalization == LOBE_NORMALIZATION_PREVIOUS};
}

/* Of one class. */
typedef struct group {
    int count;
    shading_point *points[WAVE_PATHS];
} group;

static void shade_group(const group *g, row_loop *loop, const row_options *o) {
    shade_rows rows;
    for (int first = 0; first < g->count; first += ROWS) {
        const int rest = g->count - first, n = rest < ROWS ? rest : ROWS;
        for (int i = 0; i < n; i++) write_row(&rows, i, g->points[first + i]);
        /* numbers in the rows between, whatever they are */
        for (int i = n; i & 15; i++) write_row(&rows, i, g->points[first]);
        loop(&rows, n, o);
        for (int i = 0; i < n; i++) read_row(&rows, i, g->points[first + i]);
    }
}

/* A vector takes longer than a point alone. */
enum { WORTH_A_VECTOR = 2 };

void lobe_shade(const integrator *k, shading_point *points, int count, int is_first) {
    const row_loops *loops = lobe_row_loops_in_use();
    group groups[CLASSES];
    for (int c = 0; c < CLASSES; c++) groups[c].count = 0;
    for (int i = 0; i < count; i++) {
        const int class = class_of(k, loops, &points[i], is_first);
        if (class == ALONE)
            shade_alone(k, &points[i], is_first);
        else
            groups[class].points[groups[class].count++] = &points[i];
    }
    const row_options o = options_of(k);
    for (int c = 0; c < CLASSES; c++) {
        const group *g = &groups[c];
        if (g->count < WORTH_A_VECTOR) {
            for (int i = 0; i < g->count; i++) shade_alone(k, g->points[i], is_first);
            continue;
        }
        for (int i = 0; i < g->count; i++) {
            g->points[i]->roll = lobe_sampler_next(g->points[i]->numbers);
            g->points[i]->has_glass = 0;
        }
        shade_group(g, loop_of(loops, c), &o);
    }
}
