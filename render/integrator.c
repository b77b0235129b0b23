#include "integrator.h"

/* A hit, ready to shade. */
typedef struct hit_point {
    vec3 position, geometric; /* geometric: toward the viewer */
    frame shading;
    float distance;
    const triangle *triangle;
    const material *material;
    float u, v;
    vec3 emission;
} hit_point;

/* State of a path. */
typedef struct path {
    const integrator *k;
    sampler *points;
    vec3 origin, direction, throughput;
    float pdf;     /* of `direction`; a point mass: infinite */
    int is_camera; /* no surface yet: light is taken as it is */
    film_sample sample;
    uint64_t rays;
} path;

static vec3 sample_texture(const lobe_scene *s, int index, const hit_point *h, vec3 missing) {
    return index == NO_TEXTURE ? missing : lobe_texture_at(&s->textures[index], h->u, h->v);
}

static vec3 interpolate(const vec3 a, const vec3 b, const vec3 c, float u, float v) {
    return v3_add(v3_scale(a, 1.0f - u - v), v3_add(v3_scale(b, u), v3_scale(c, v)));
}

/* The shading normal from the normal map, in world space. */
static vec3 mapped_normal(const lobe_scene *s, const hit_point *h, const frame *f,
                          float handedness) {
    const material *m = h->material;
    if (m->normal_texture == NO_TEXTURE) return f->z;
    vec3 t = lobe_texture_at(&s->textures[m->normal_texture], h->u, h->v);
    float x = (2.0f * t.x - 1.0f) * m->normal_scale, y = (2.0f * t.y - 1.0f) * m->normal_scale;
    vec3 local = {x, y * handedness, 2.0f * t.z - 1.0f};
    return v3_normalize_or(frame_to_world(f, local), f->z);
}

static hit_point hit_point_of(const lobe_scene *s, const ray_hit *hit, vec3 direction) {
    const triangle *t = &s->triangles[hit->triangle];
    const vertex *a = &s->vertices[t->vertex[0]], *b = &s->vertices[t->vertex[1]],
                 *c = &s->vertices[t->vertex[2]];
    float u = hit->u, v = hit->v, w = 1.0f - u - v;
    hit_point h = {
        .distance = hit->distance, .triangle = t, .material = &s->materials[t->material]};
    h.u = w * a->u + u * b->u + v * c->u;
    h.v = w * a->v + u * b->v + v * c->v;
    h.position = interpolate(a->position, b->position, c->position, u, v);
    vec3 edge = v3_sub(b->position, a->position), other = v3_sub(c->position, a->position);
    vec3 face = v3_normalize_or(v3_cross(edge, other), v3(0.0f, 1.0f, 0.0f));
    /* surfaces are two-sided: both normals turn with the side that is seen */
    float side = v3_dot(face, direction) > 0.0f ? -1.0f : 1.0f;
    h.geometric = v3_scale(face, side);
    vec3 normal = v3_normalize_or(interpolate(a->normal, b->normal, c->normal, u, v), face);
    vec3 tangent = interpolate(a->tangent, b->tangent, c->tangent, u, v);
    frame smooth = frame_of(normal, tangent);
    vec3 mapped = mapped_normal(s, &h, &smooth, a->handedness);
    h.shading = frame_of(v3_scale(mapped, side), tangent);
    h.emission = v3_mul(h.material->emission,
                        sample_texture(s, h.material->emission_texture, &h, v3_all(1.0f)));

    return h;
}

static surface surface_of(const integrator *k, const hit_point *h, vec3 to_viewer) {
    const material *m = h->material;
    vec3 color = v3_mul(m->base_color, sample_texture(k->scene, m->base_texture, h, v3_all(1.0f)));
    vec3 packed = sample_texture(k->scene, m->surface_texture, h, v3_all(1.0f));
    return lobe_surface_at(&k->surface, h->shading, h->geometric, to_viewer, color,
                           m->metallic * packed.z, m->roughness * packed.y, m->anisotropy);
}

/* Share of a sample of density a when b could have made it too. */
static float weigh(lobe_heuristic heuristic, float a, float b, int is_light) {
    if (heuristic == LOBE_HEURISTIC_BSDF_ONLY) return is_light ? 0.0f : 1.0f;
    if (heuristic == LOBE_HEURISTIC_LIGHT_ONLY) return is_light ? 1.0f : 0.0f;
    float ratio = b / a;
    return 1.0f / (1.0f + (heuristic == LOBE_HEURISTIC_POWER ? ratio * ratio : ratio));
}

/* Probability of asking the environment rather than a lamp. */
static float sky_probability(const lobe_scene *s) {
    int sky = s->has_sky && s->sky.table.cells, lamps = s->light_table.cells != NULL;
    return sky ? (lamps ? 0.5f : 1.0f) : 0.0f;
}

static float lamp_pdf(const lobe_scene *s, const hit_point *h, vec3 direction) {
    int32_t light = h->triangle->light;
    if (light < 0 || !s->light_table.cells) return 0.0f;
    float share = s->light_table.cells[light].share * (1.0f - sky_probability(s));
    float cosine = fabsf(v3_dot(h->geometric, direction));
    return share * h->distance * h->distance / fmaxf(s->light_areas[light] * cosine, 1e-20f);
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
    float pdf = lobe_environment_pdf(&s->sky, p->direction) * sky_probability(s);
    add_met_light(p, lobe_environment_at(&s->sky, p->direction), pdf);
}

/* A place off the surface, so that a ray does not meet it again. */
static vec3 lift(const hit_point *h) {
    float size = fmaxf(fabsf(h->position.x), fmaxf(fabsf(h->position.y), fabsf(h->position.z)));
    return v3_add(h->position, v3_scale(h->geometric, 2e-5f * (size + h->distance)));
}

/* One point of light: direction, distance, radiance and density over directions. */
typedef struct light_sample {
    vec3 direction, radiance;
    float distance, pdf;
} light_sample;

static light_sample draw_lamp(const lobe_scene *s, vec3 from, sampler_point point) {
    uint32_t light = alias_draw(
        &s->light_table, point.bits[1],
        (float)((uint32_t)((uint64_t)point.bits[1] * s->light_table.count) >> 8) * 0x1p-24f);
    const triangle *t = &s->triangles[s->lights[light]];
    float root = sqrtf(sampler_unit(point.bits[2])), v = sampler_unit(point.bits[3]) * root;
    vec3 a = s->vertices[t->vertex[0]].position, b = s->vertices[t->vertex[1]].position,
         c = s->vertices[t->vertex[2]].position;
    vec3 place = interpolate(a, b, c, root - v, v);
    vec3 to = v3_sub(place, from);
    light_sample l = {.distance = v3_length(to)};
    l.direction = v3_normalize_or(to, v3(0.0f, 1.0f, 0.0f));
    vec3 normal = v3_normalize_or(v3_cross(v3_sub(b, a), v3_sub(c, a)), l.direction);
    float cosine = fabsf(v3_dot(normal, l.direction));
    float share = s->light_table.cells[light].share;
    l.pdf = share * l.distance * l.distance / fmaxf(s->light_areas[light] * cosine, 1e-20f);
    l.radiance = s->materials[t->material].emission;
    return l;
}

static light_sample draw_light(const lobe_scene *s, vec3 from, sampler_point point) {
    float sky = sky_probability(s);
    if (sampler_unit(point.bits[0]) < sky) {
        light_sample l = {.distance = INFINITY};
        l.direction = lobe_environment_draw(&s->sky, point.bits + 1, &l.pdf);
        l.radiance = lobe_environment_at(&s->sky, l.direction);
        l.pdf *= sky;
        return l;
    }
    light_sample l = draw_lamp(s, from, point);
    l.pdf *= 1.0f - sky;
    return l;
}

/* Next-event estimation. */
static void add_drawn_light(path *p, const hit_point *h, const surface *surface) {
    const lobe_scene *s = p->k->scene;
    sampler_point point = lobe_sampler_next(p->points);
    if (p->k->heuristic == LOBE_HEURISTIC_BSDF_ONLY) return;
    /* nothing but a point mass; the base below a coat that is a mirror still sees the lamps */
    if (surface->ggx.is_mirror && surface->specular >= 1.0f) return;
    if (!s->light_table.cells && sky_probability(s) == 0.0f) return;
    vec3 from = lift(h);
    light_sample l = draw_light(s, from, point);
    if (!(l.pdf > 0.0f)) return;
    float pdf;
    vec3 value = lobe_surface_value(surface, l.direction, &pdf);
    if (!(v3_max(value) > 0.0f)) return;
    p->rays++;
    if (lobe_tracer_blocked(s->tracer, from, l.direction, l.distance * 0.9999f)) return;
    float share = weigh(p->k->heuristic, l.pdf, pdf, 1);
    vec3 light = v3_mul(p->throughput, v3_mul(value, l.radiance));
    p->sample.radiance = v3_add(p->sample.radiance, v3_scale(light, share / l.pdf));
}

static void keep_first_hit(path *p, const hit_point *h, const surface *surface) {
    p->sample.albedo = surface->base_color;
    p->sample.normal = h->shading.z;
    p->sample.depth = h->distance;
}

/* Go on in a drawn direction; 0: the path ends. */
static int scatter(path *p, const hit_point *h, const surface *surface, int scatterings) {
    sampler_point point = lobe_sampler_next(p->points);
    surface_draw d = lobe_surface_draw(surface, sampler_unit(point.bits[0]),
                                       sampler_unit(point.bits[1]), sampler_unit(point.bits[2]));
    p->sample.draws += (uint32_t)d.is_ggx;
    p->sample.rejected += d.is_ggx && !(d.pdf > 0.0f);
    if (!(d.pdf > 0.0f)) return 0;
    p->throughput = v3_mul(p->throughput, d.weight);
    p->pdf = d.is_mirror ? INFINITY : d.pdf;
    p->origin = lift(h);
    p->direction = d.direction;
    p->is_camera = 0;
    if (scatterings < p->k->roulette_depth) return v3_max(p->throughput) > 0.0f;
    float survival = fminf(v3_max(p->throughput), 0.95f);
    if (!(sampler_unit(point.bits[3]) < survival)) return 0;
    p->throughput = v3_scale(p->throughput, 1.0f / survival);
    return 1;
}

film_sample lobe_trace_path(const integrator *k, vec3 origin, vec3 direction, sampler *points,
                            uint64_t *rays) {
    path p = {.k = k,
              .points = points,
              .origin = origin,
              .direction = direction,
              .throughput = v3_all(1.0f),
              .is_camera = 1};
    for (int scatterings = 0;; scatterings++) {
        ray_hit hit;
        p.rays++;
        if (!lobe_tracer_nearest(k->scene->tracer, p.origin, p.direction, &hit)) {
            add_sky(&p);
            break;
        }
        hit_point h = hit_point_of(k->scene, &hit, p.direction);
        add_met_light(&p, h.emission, lamp_pdf(k->scene, &h, p.direction));
        surface s = surface_of(k, &h, v3_neg(p.direction));
        if (scatterings == 0) keep_first_hit(&p, &h, &s);
        if (scatterings == k->depth) break;
        add_drawn_light(&p, &h, &s);
        if (!scatter(&p, &h, &s, scatterings + 1)) break;
    }
    *rays += p.rays;
    return p.sample;
}
