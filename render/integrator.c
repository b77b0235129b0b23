#include "integrator.h"

#include "light.h"
#include "place.h"
#include "shading.h"

/* ---- One path -------------------------------------------------------------------------------- */

/* Share of a sample of density a when b could have made it too. */
static float weigh(lobe_heuristic heuristic, float a, float b, int is_light) {
    if (heuristic == LOBE_HEURISTIC_BSDF_ONLY) return is_light ? 0.0f : 1.0f;
    if (heuristic == LOBE_HEURISTIC_LIGHT_ONLY) return is_light ? 1.0f : 0.0f;
    float ratio = b / a;
    return 1.0f / (1.0f + (heuristic == LOBE_HEURISTIC_POWER ? ratio * ratio : ratio));
}

/* Light met by the path itself, weighed against having drawn it as a lamp. */
static void add_met_light(path *p, vec3 radiance, float light_pdf) {
    float share = 1.0f;
    if (!p->is_camera && isfinite(p->pdf) && light_pdf > 0.0f)
        share = weigh(p->k->heuristic, p->pdf, light_pdf, 0);
    vec3 light = v3_mul(p->throughput, v3_scale(radiance, share));
    p->sample.radiance = v3_add(p->sample.radiance, light);
}

static void add_sky(path *p) {
    const lobe_scene *s = p->k->scene;
    if (!s->has_sky) return;
    if (p->is_camera || isinf(p->pdf)) {
        add_met_light(p, lobe_environment_at(&s->sky, p->direction), 0.0f);
        return;
    }
    float pdf;
    const vec3 radiance = lobe_environment_meet(&s->sky, p->direction, &pdf);
    add_met_light(p, radiance, pdf * lobe_light_sky_probability(s));
}

static int goes_through(const shading_point *at, vec3 direction) {
    return at->has_glass && v3_dot(direction, at->hit.geometric) < 0.0f;
}

/* The solid in which the path goes on. */
static const material *inside_after(const path *p, const hit_point *h, int is_through) {
    if (!is_through || !is_solid(h->material)) return p->inside;
    return h->is_back ? NULL : h->material;
}

/* Beer's law. What leaves a solid that is not closed is not absorbed. */
static vec3 absorbed(const material *inside, vec3 light, float distance) {
    if (!inside || !(v3_max(inside->absorption) > 0.0f) || !isfinite(distance)) return light;
    vec3 a = v3_scale(inside->absorption, -distance);
    return v3_mul(light, v3(expf(a.x), expf(a.y), expf(a.z)));
}

/* Where a ray goes on behind a surface that it passed. */
static float past(float distance) {
    return nextafterf(distance * 1.000001f, INFINITY);
}

static void note_ray(path *p, vec3 origin, vec3 direction, float from, float to, ray_kind kind) {
    p->rays++;
    if (p->k->log) lobe_ray_log_add(p->k->log, (logged_ray){origin, direction, from, to}, kind);
}

/* The share of light that comes from `distance` away. */
static float transmittance(path *p, vec3 from, vec3 direction, float distance) {
    const lobe_scene *s = p->k->scene;
    if (s->is_opaque) {
        note_ray(p, from, direction, 0.0f, -distance, RAY_SHADOW);
        return lobe_tracer_blocked(s->tracer, from, direction, distance) ? 0.0f : 1.0f;
    }
    ray_hit hit;
    float share = 1.0f;
    for (float near = 0.0f; share > 0.0f; near = past(hit.distance)) {
        note_ray(p, from, direction, near, distance, RAY_SHADOW);
        if (!lobe_tracer_nearest(s->tracer, from, direction, near, distance, &hit)) break;
        share *= 1.0f - lobe_hit_opacity(s, &hit);
    }
    return share;
}

/* Next-event estimation. */
static void add_drawn_light(path *p, const shading_point *at) {
    const light_sample *l = &at->light;
    if (!(l->pdf > 0.0f) || !(v3_max(at->value) > 0.0f) || !(v3_max(l->radiance) > 0.0f)) return;
    const int is_through = goes_through(at, l->direction);
    float share =
        transmittance(p, lobe_hit_lift(&at->hit, is_through), l->direction, l->distance * 0.9999f);
    if (!l->is_point_mass) share *= weigh(p->k->heuristic, l->pdf, at->value_pdf, 1);
    if (!(share > 0.0f)) return;
    vec3 light = v3_mul(p->throughput, v3_mul(at->value, l->radiance));
    light = absorbed(inside_after(p, &at->hit, is_through), light, l->distance);
    p->sample.radiance = v3_add(p->sample.radiance, v3_scale(light, share / l->pdf));
}

static void go_on(path *p, const shading_point *at, vec3 direction) {
    const hit_point *h = &at->hit;
    const int is_through = goes_through(at, direction);
    p->origin = lobe_hit_lift(h, is_through);
    p->direction = direction;
    p->is_camera = 0;
    if (!is_through || !is_solid(h->material)) return;
    const float ior2 = h->material->ior * h->material->ior;
    p->spread *= h->is_back ? 1.0f / ior2 : ior2;
    p->inside = inside_after(p, h, 1);
}

/* Go on in the drawn direction; 0: the path ends. */
static int scatter(path *p, const shading_point *at, int scatterings) {
    const surface_draw *d = &at->draw;
    p->sample.draws += (uint32_t)d->is_ggx;
    p->sample.rejected += d->is_ggx && !(d->pdf > 0.0f);
    if (!(d->pdf > 0.0f)) return 0;
    p->throughput = v3_mul(p->throughput, d->weight);
    p->pdf = d->is_mirror ? INFINITY : d->pdf;
    if (!d->is_mirror) cone_scatter(&p->cone, p->k->share, d->pdf);
    go_on(p, at, d->direction);
    if (scatterings < p->k->roulette_depth) return v3_max(p->throughput) > 0.0f;
    const float survival = minf(v3_max(p->throughput) * p->spread, 0.95f);
    if (!(sampler_unit(at->roll.bits[3]) < survival)) return 0;
    p->throughput = v3_scale(p->throughput, 1.0f / survival);
    return 1;
}

/* The next surface; of those that let light through, one is met with the probability of its
 * opacity. */
static int meet_surface(path *p, ray_hit *hit) {
    const lobe_scene *s = p->k->scene;
    for (float near = 0.0f;; near = past(hit->distance)) {
        note_ray(p, p->origin, p->direction, near, INFINITY,
                 p->is_camera ? RAY_CAMERA : RAY_BOUNCE);
        if (!lobe_tracer_nearest(s->tracer, p->origin, p->direction, near, INFINITY, hit)) return 0;
        const float opacity = s->is_opaque ? 1.0f : lobe_hit_opacity(s, hit);
        if (opacity >= 1.0f) return 1;
        if (opacity > 0.0f && sampler_unit(lobe_sampler_next(&p->numbers).bits[0]) < opacity)
            return 1;
    }
}

static lit_place lit_place_of(const path *p) {
    return (lit_place){p->k->has_light_tree, p->place, p->facing};
}

/* Density with which the light that is met could have been drawn. */
static float met_light_pdf(const path *p, const hit_point *h) {
    if (p->is_camera) return 0.0f;
    const lit_place lit = lit_place_of(p);
    return lobe_light_lamp_pdf(p->k->scene, &lit, h, p->direction);
}

/* ---- Many side by side ------------------------------------------------------------------------ */

/* Paths of equal length, some of which have ended. */
typedef struct wave {
    const integrator *k;
    path *going[WAVE_PATHS];
    int count;
    int scatterings;
    ray_hit hits[WAVE_PATHS];
    sampler_point light[WAVE_PATHS];
    shading_point at[WAVE_PATHS];
} wave;

/* Traces all rays. What left the scene has ended. */
static void meet_surfaces(wave *w) {
    const lobe_scene *s = w->k->scene;
    path *missing[WAVE_PATHS];
    int missed = 0, met = 0;
    for (int i = 0; i < w->count; i++) {
        path *p = w->going[i];
        if (!meet_surface(p, &w->hits[met])) {
            missing[missed++] = p;
            continue;
        }
        __builtin_prefetch(&s->triangles[w->hits[met].triangle]);
        w->going[met++] = p;
    }
    w->count = met;
    for (int i = 0; i < missed; i++) add_sky(missing[i]);
}

/* What is read next is far away in memory: it is asked for in time. */
static void ask_for_memory(wave *w) {
    const lobe_scene *s = w->k->scene;
    const int has_sky = s->has_sky && s->sky.table.cells;
    for (int i = 0; i < w->count; i++) {
        const triangle *t = &s->triangles[w->hits[i].triangle];
        for (int c = 0; c < 3; c++) __builtin_prefetch(&s->vertices[t->vertex[c]]);
        w->light[i] = lobe_sampler_next(&w->going[i]->numbers);
        if (has_sky) lobe_environment_prefetch(&s->sky, w->light[i].bits + 1);
    }
}

static void arrive(wave *w) {
    const lobe_scene *s = w->k->scene;
    for (int i = 0; i < w->count; i++) {
        path *p = w->going[i];
        shading_point *at = &w->at[i];
        const hit_point *h = &at->hit;
        cone_travel(&p->cone, w->hits[i].distance);
        lobe_hit_point_find(s, &w->hits[i], p->direction, p->cone.width, &at->hit);
        /* a camera inside */
        if (!p->inside && h->is_back && is_solid(h->material)) p->inside = h->material;
        if (p->inside)
            p->throughput =
                absorbed(p->inside, p->throughput, v3_length(v3_sub(h->position, p->place)));
        add_met_light(p, h->emission, met_light_pdf(p, h));
        at->looks = lobe_hit_looks(s, &at->hit);
        at->to_viewer = v3_neg(p->direction);
        at->numbers = &p->numbers;
    }
}

static void draw_lights(wave *w) {
    const lobe_scene *s = w->k->scene;
    const int has_lights = s->light_table.cells || lobe_light_sky_probability(s) > 0.0f;
    const int are_asked = has_lights && w->k->heuristic != LOBE_HEURISTIC_BSDF_ONLY;
    for (int i = 0; i < w->count; i++) {
        path *p = w->going[i];
        shading_point *at = &w->at[i];
        p->place = at->hit.position;
        p->facing = at->looks.transmission > 0.0f ? v3_all(0.0f) : at->hit.geometric;
        const lit_place lit = lit_place_of(p);
        at->light = are_asked ? lobe_light_draw(s, &lit, lobe_hit_lift(&at->hit, 0), w->light[i])
                              : (light_sample){.pdf = 0.0f};
    }
}

static void keep_first_hits(wave *w) {
    for (int i = 0; i < w->count; i++) {
        film_sample *sample = &w->going[i]->sample;
        const shading_point *at = &w->at[i];
        sample->albedo = at->looks.base_color;
        sample->normal = at->hit.shading.z;
        sample->depth = at->hit.distance;
    }
}

/* The paths that go no further: not after the last scattering, nor from a surface that reflects nothing. */
static void end_here(wave *w) {
    int kept = 0;
    for (int i = 0; i < w->count && w->scatterings < w->k->depth; i++) {
        if (w->at[i].hit.material->is_unlit) continue;
        if (kept < i) {
            w->at[kept] = w->at[i];
            w->going[kept] = w->going[i];
        }
        kept++;
    }
    w->count = kept;
}

static void shade(wave *w) {
    const int is_first = w->scatterings == 0, keeps = is_first && w->k->keeps_vndf_integral;
    if (is_first) keep_first_hits(w);
    if (!keeps) end_here(w);
    draw_lights(w);
    lobe_shade(w->k, w->at, w->count, is_first);
    for (int i = 0; i < w->count && keeps; i++)
        w->going[i]->sample.vndf_integral = w->at[i].vndf_integral;
    if (keeps) end_here(w);
}

static void scatter_all(wave *w) {
    int kept = 0;
    w->scatterings++;
    for (int i = 0; i < w->count; i++) {
        path *p = w->going[i];
        if (scatter(p, &w->at[i], w->scatterings)) w->going[kept++] = p;
    }
    w->count = kept;
}

void lobe_path_begin(path *p, const integrator *k, vec3 origin, vec3 direction, sampler numbers) {
    *p = (path){.k = k,
                .numbers = numbers,
                .sample = {.vndf_integral = 1.0f},
                .origin = origin,
                .place = origin,
                .direction = direction,
                .throughput = v3_all(1.0f),
                .spread = 1.0f,
                .is_camera = 1,
                .cone = cone_of_pixel(k->pixel_angle, k->axis, direction)};
}

void lobe_trace_paths(path *paths, int count) {
    wave w;
    w.k = paths[0].k;
    w.count = count;
    w.scatterings = 0;
    for (int i = 0; i < count; i++) w.going[i] = &paths[i];
    for (;;) {
        meet_surfaces(&w);
        ask_for_memory(&w);
        arrive(&w);
        shade(&w);
        if (w.count == 0) return;
        for (int i = 0; i < w.count; i++) add_drawn_light(w.going[i], &w.at[i]);
        scatter_all(&w);
    }
}

film_sample lobe_trace_path(const integrator *k, vec3 origin, vec3 direction, sampler *numbers,
                            uint64_t *rays) {
    path p;
    lobe_path_begin(&p, k, origin, direction, *numbers);
    lobe_trace_paths(&p, 1);
    *numbers = p.numbers;
    *rays += p.rays;
    return p.sample;
}

int lobe_first_surface(const lobe_scene *s, vec3 origin, vec3 direction,
                       lobe_ray_surface *surface) {
    ray_hit hit;
    float near = 0.0f;
    do {
        if (!lobe_tracer_nearest(s->tracer, origin, direction, near, INFINITY, &hit)) return 0;
        near = past(hit.distance);
    } while (lobe_hit_opacity(s, &hit) < 0.5f);
    hit_point h;
    lobe_hit_point_find(s, &hit, direction, 0.0f, &h);
    const hit_looks l = lobe_hit_looks(s, &h);
    const float step = (h.material->ior - 1.0f) / (h.material->ior + 1.0f);
    const coat_tint tint = lobe_hit_tint(s, &h);
    const vec3 coat_f0 = v3_add(tint.one, v3_scale(tint.own, step * step));
    *surface = (lobe_ray_surface){.distance = h.distance,
                                  .position = h.position,
                                  .normal = h.shading.z,
                                  .geometric = h.geometric,
                                  .f0 = v3_lerp(coat_f0, l.base_color, l.metallic),
                                  .roughness = l.roughness,
                                  .anisotropy = l.anisotropy,
                                  .tangent = h.shading.x,
                                  .place = lobe_place_of(s, &hit)};
    return 1;
}
