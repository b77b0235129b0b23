#include "integrator.h"

#include "cone.h"
#include "hit.h"
#include "place.h"

/* A hit, ready to shade. */
typedef struct hit_point {
    vec3 position, geometric; /* geometric: toward the viewer */
    frame shading, smooth;    /* smooth: without normal map, as the triangle faces */
    float distance, handedness;
    const triangle *triangle;
    const material *material;
    float u[2], v[2];
    float footprint[2]; /* for textures, in the planes of u and v */
    float turn;         /* -1: the tangent frame is left-handed */
    int is_back;        /* the triangle faces away */
    vec3 darkening;     /* of the base colour, by the colours of the vertices */
    vec3 emission;
} hit_point;

/* State of a path. */
typedef struct path {
    const integrator *k;
    sampler *points;
    vec3 origin, direction, throughput;
    vec3
        place; /* on the surface where the path was last: what lies in a solid is measured from it */
    vec3 facing;  /* the surface's normal there; 0: it is lit from both sides */
    float pdf;    /* of `direction`; a point mass: infinite */
    cone cone;    /* of `direction` */
    float spread; /* by which refraction has shrunk radiance so far: what returns on leaving */
    const material *inside; /* the solid in which the path is; NULL: none. They do not nest */
    int is_camera;          /* no surface yet: light is taken as it is */
    film_sample *sample;
    uint64_t rays;
} path;

static vec3 sample_map(const lobe_scene *s, const texture_map *map, const hit_point *h,
                       vec3 missing) {
    if (map->texture == NO_TEXTURE) return missing;
    const int set = map->uv_set;
    return lobe_texture_at(&s->textures[map->texture], map, h->u[set], h->v[set],
                           h->footprint[set]);
}

/* Of directions, which are not averaged. */
static vec3 sample_directions(const lobe_scene *s, const texture_map *map, const hit_point *h,
                              vec3 missing) {
    if (map->texture == NO_TEXTURE) return missing;
    const int set = map->uv_set;
    return lobe_texture_at(&s->textures[map->texture], map, h->u[set], h->v[set], 0.0f);
}

static int is_coloured(const vertex *v) {
    return (v->darkening[0] | v->darkening[1] | v->darkening[2]) != 0;
}

/* What the colours of the vertices take away. */
static vec3 darkening_at(const vertex *a, const vertex *b, const vertex *c, float u, float v) {
    if (!is_coloured(a) && !is_coloured(b) && !is_coloured(c)) return v3_all(0.0f);
    const vec3 sum = hit_mean(v3(a->darkening[0], a->darkening[1], a->darkening[2]),
                              v3(b->darkening[0], b->darkening[1], b->darkening[2]),
                              v3(c->darkening[0], c->darkening[1], c->darkening[2]), u, v);
    return v3_scale(sum, 1.0f / 65535.0f);
}

static vec3 base_color_at(const lobe_scene *s, const hit_point *h) {
    const vec3 color = v3_mul(h->material->base_color, v3_sub(v3_all(1.0f), h->darkening));
    const texture_map *map = &h->material->base_map;
    /* of what is cut out, only what is there has a colour */
    return v3_mul(color, h->material->alpha_mode == ALPHA_OPAQUE
                             ? sample_map(s, map, h, v3_all(1.0f))
                             : sample_directions(s, map, h, v3_all(1.0f)));
}

/* The share of light that a surface takes: the rest passes. */
static float opacity_at(const lobe_scene *s, const ray_hit *hit) {
    const triangle *t = &s->triangles[hit->triangle];
    const material *m = &s->materials[t->material];
    if (m->alpha_mode == ALPHA_OPAQUE) return 1.0f;
    const vertex *a = &s->vertices[t->vertex[0]], *b = &s->vertices[t->vertex[1]],
                 *c = &s->vertices[t->vertex[2]];
    const float u = hit->u, v = hit->v, w = 1.0f - u - v;
    const float missing = w * a->darkening[3] + u * b->darkening[3] + v * c->darkening[3];
    float alpha = m->alpha * (1.0f - missing / 65535.0f);
    const texture_map *map = m->opacity_map.texture != NO_TEXTURE ? &m->opacity_map : &m->base_map;
    if (map->texture != NO_TEXTURE) {
        const int second = map->uv_set;
        const float x = second ? w * a->u1 + u * b->u1 + v * c->u1 : w * a->u + u * b->u + v * c->u;
        const float y = second ? w * a->v1 + u * b->v1 + v * c->v1 : w * a->v + u * b->v + v * c->v;
        alpha *= lobe_texture_alpha_at(&s->textures[map->texture], map, x, y);
    }
    if (m->alpha_mode == ALPHA_MASK) return alpha >= m->alpha_cutoff ? 1.0f : 0.0f;
    return alpha;
}

/* The normal that a normal map says, in world space. */
static vec3 mapped_normal(const lobe_scene *s, const hit_point *h, const texture_map *map,
                          float scale) {
    const frame *f = &h->smooth;
    if (map->texture == NO_TEXTURE) return f->z;
    vec3 t = sample_directions(s, map, h, v3_all(0.0f));
    float x = (2.0f * t.x - 1.0f) * scale, y = (2.0f * t.y - 1.0f) * scale;
    vec3 local = {x, y * h->handedness, 2.0f * t.z - 1.0f};
    return v3_normalize_or(frame_to_world(f, local), f->z);
}

/* The frames of a triangle that is seen, its geometric normal turned to the viewer. A surface that is the same all
 * around needs no tangent. */
static void add_frames(const lobe_scene *s, hit_point *h, vec3 normal, vec3 tangent) {
    const material *m = h->material;
    const float side = h->is_back ? -1.0f : 1.0f;
    if (!m->has_direction) {
        const vec3 z = v3_scale(normal, side), x = v3_across(z);
        h->smooth.z = normal;
        h->shading = (frame){x, v3_cross(z, x), z};
        return;
    }
    h->smooth = frame_of(normal, tangent);
    const vec3 mapped = mapped_normal(s, h, &m->normal_map, m->normal_scale);
    h->shading = frame_of(v3_scale(mapped, side), tangent);
}

static vec3 emission_at(const lobe_scene *s, const hit_point *h) {
    const material *m = h->material;
    if (m->is_unlit) return base_color_at(s, h);
    if (!(v3_max(m->emission) > 0.0f)) return v3_all(0.0f);
    return v3_mul(m->emission, sample_map(s, &m->emission_map, h, v3_all(1.0f)));
}

static float cross(float ax, float ay, float bx, float by) {
    return ax * by - ay * bx;
}

static void find_footprint(hit_point *h, const vertex *a, const vertex *b, const vertex *c,
                           float width, float cosine, float area) {
    const float first = cross(b->u - a->u, b->v - a->v, c->u - a->u, c->v - a->v);
    const float second = cross(b->u1 - a->u1, b->v1 - a->v1, c->u1 - a->u1, c->v1 - a->v1);
    h->footprint[0] = cone_footprint(width, cosine, area, fabsf(first));
    h->footprint[1] = cone_footprint(width, cosine, area, fabsf(second));
}

/* Written member by member, where it stays: a copy of what has just been written waits for it. */
static void find_hit_point(const lobe_scene *s, const ray_hit *hit, vec3 direction, float width,
                           hit_point *h) {
    const hit_geometry g = hit_geometry_of(s, hit);
    const triangle *t = g.triangle;
    const vertex *a = &s->vertices[t->vertex[0]], *b = &s->vertices[t->vertex[1]],
                 *c = &s->vertices[t->vertex[2]];
    const float u = hit->u, v = hit->v, w = 1.0f - u - v;
    h->distance = hit->distance;
    h->position = g.position;
    h->triangle = t;
    h->material = &s->materials[t->material];
    h->u[0] = w * a->u + u * b->u + v * c->u;
    h->v[0] = w * a->v + u * b->v + v * c->v;
    h->u[1] = w * a->u1 + u * b->u1 + v * c->u1;
    h->v[1] = w * a->v1 + u * b->v1 + v * c->v1;
    h->footprint[0] = h->footprint[1] = 0.0f;
    if (width > 0.0f && h->material->is_averaged)
        find_footprint(h, a, b, c, width, fabsf(v3_dot(g.face, direction)), g.area);
    h->darkening = darkening_at(a, b, c, u, v);
    /* surfaces are two-sided: both normals turn with the side that is seen */
    const float side = v3_dot(g.face, direction) > 0.0f ? -1.0f : 1.0f;
    h->geometric = v3_scale(g.face, side);
    h->handedness = g.handedness;
    h->turn = side * g.handedness;
    h->is_back = side < 0.0f;
    add_frames(s, h, v3_normalize_or(g.normal, g.face), g.tangent);
    h->emission = emission_at(s, h);
}

static void read_surface(const lobe_scene *s, const hit_point *h, float *roughness,
                         float *metallic) {
    const material *m = h->material;
    const vec3 one = sample_map(s, &m->roughness_map, h, v3_all(1.0f));
    const vec3 other = m->is_packed ? one : sample_map(s, &m->metallic_map, h, v3_all(1.0f));
    *roughness = m->roughness * one.y;
    *metallic = m->metallic * other.z;
}

/* KHR_materials_anisotropy, in the terms of lobe_surface_at: alpha grows toward 1 along a direction of
 * the tangent plane, which becomes the frame's x. */
static void stretch(const lobe_scene *s, const hit_point *h, frame *shading, float *roughness,
                    float *anisotropy) {
    const material *m = h->material;
    const vec3 t = sample_directions(s, &m->stretch_map, h, v3(1.0f, 0.5f, 1.0f));
    const float x = 2.0f * t.x - 1.0f, y = 2.0f * t.y - 1.0f, strength = m->stretch * t.z;
    const float along = m->stretch_x * x - m->stretch_y * y;
    const float across = (m->stretch_y * x + m->stretch_x * y) * h->turn;
    *shading =
        frame_of(shading->z, v3_add(v3_scale(shading->x, along), v3_scale(shading->y, across)));
    const float alpha_y = maxf(*roughness * *roughness, 0.001f);
    const float alpha_x = alpha_y + (1.0f - alpha_y) * strength * strength;
    *roughness = sqrtf(0.5f * (alpha_x + alpha_y));
    *anisotropy = (alpha_x - alpha_y) / (alpha_x + alpha_y);
}

/* Whether the far side is another medium. */
static int is_solid(const material *m) {
    return m->transmission > 0.0f && m->thickness > 0.0f;
}

/* The front of a solid, and both sides of all else. */
static void add_clearcoat(const path *p, const hit_point *h, vec3 to_viewer, surface *s,
                          clearcoat *room) {
    const lobe_scene *scene = p->k->scene;
    const material *m = h->material;
    if (!(m->clearcoat > 0.0f) || (h->is_back && is_solid(m))) return;
    const float share = m->clearcoat * sample_map(scene, &m->clearcoat_map, h, v3_all(1.0f)).x;
    const float roughness =
        m->clearcoat_roughness * sample_map(scene, &m->clearcoat_roughness_map, h, v3_all(1.0f)).y;
    const vec3 normal =
        mapped_normal(scene, h, &m->clearcoat_normal_map, m->clearcoat_normal_scale);
    const frame f = frame_of(v3_scale(normal, h->is_back ? -1.0f : 1.0f), h->smooth.x);
    if (share > 0.0f)
        lobe_surface_add_clearcoat(s, room, &p->k->surface, p->k->coats[scene->material_count], f,
                                   to_viewer, share, roughness);
}

static coat_tint tint_at(const lobe_scene *s, const hit_point *h) {
    const material *m = h->material;
    const texture_map *map = &m->specular_map;
    if (map->texture == NO_TEXTURE && m->specular_color_map.texture == NO_TEXTURE) return m->tint;
    float share = m->specular;
    if (map->texture != NO_TEXTURE)
        share *= lobe_texture_alpha_at(&s->textures[map->texture], map, h->u[map->uv_set],
                                       h->v[map->uv_set]);
    vec3 color = sample_map(s, &m->specular_color_map, h, v3_all(1.0f));
    return lobe_coat_tint(m->ior, share, v3_mul(m->specular_color, color));
}

/* What few surfaces have, and all would pay for. */
typedef struct layers {
    glass glass;
    clearcoat clearcoat;
} layers;

static void surface_of(const path *p, const hit_point *h, vec3 to_viewer, surface *s,
                       layers *room) {
    const integrator *k = p->k;
    const material *m = h->material;
    if (m->is_matte) {
        lobe_surface_make_matte(s, h->shading, h->geometric, base_color_at(k->scene, h));
        return;
    }
    uint64_t random = 0;
    if (k->surface.multiscatter == LOBE_MULTISCATTER_WALK) {
        const sampler_point point = lobe_sampler_next(p->points);
        random = (uint64_t)point.bits[0] << 32 | point.bits[1];
    }
    float roughness, metallic, anisotropy = m->anisotropy;
    read_surface(k->scene, h, &roughness, &metallic);
    vec3 base_color = base_color_at(k->scene, h);
    float transmission = m->transmission;
    if (transmission > 0.0f)
        transmission *=
            (1.0f - metallic) * sample_map(k->scene, &m->transmission_map, h, v3_all(1.0f)).x;
    frame shading = h->shading;
    if (m->stretch > 0.0f) stretch(k->scene, h, &shading, &roughness, &anisotropy);
    /* of what is not glass, the same amount is metal */
    if (transmission > 0.0f) metallic /= maxf(1.0f - transmission, 1e-6f);
    surface_options options = k->surface;
    options.coat = k->coats[h->triangle->material];
    options.tint = tint_at(k->scene, h);
    lobe_surface_make(s, &options, shading, h->geometric, to_viewer, base_color,
                      minf(metallic, 1.0f), roughness, anisotropy, random);
    if (transmission > 0.0f) {
        float alpha = roughness * roughness;
        glass_material g = {transmission,
                            m->ior,
                            !is_solid(m),
                            base_color,
                            alpha * (1.0f + anisotropy),
                            alpha * (1.0f - anisotropy)};
        lobe_surface_add_glass(s, &room->glass, &k->surface, g, to_viewer, h->is_back);
    }
    add_clearcoat(p, h, to_viewer, s, &room->clearcoat);
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

/* Probability of choosing a light where the path was last. */
static float light_share(const path *p, uint32_t light) {
    const lobe_scene *s = p->k->scene;
    if (!p->k->has_light_tree) return s->light_table.shares[light];
    return (1.0f - s->far_share) *
           lobe_light_tree_probability(&s->light_tree, p->place, p->facing, light);
}

/* One of the lamps that shine from infinitely far, by power. */
static uint32_t choose_far(const lobe_scene *s, float u, float *probability) {
    uint32_t chosen = LIGHT_NOWHERE;
    float sum = 0.0f;
    for (uint32_t i = 0; i < s->lamp_count && (chosen == LIGHT_NOWHERE || sum <= u); i++) {
        const float share = s->light_table.shares[s->light_count + i];
        if (s->lamps[i].kind != LAMP_DIRECTIONAL || share == 0.0f) continue;
        sum += share;
        chosen = s->light_count + i;
        *probability = share;
    }
    return chosen;
}

static uint32_t choose_light(const path *p, uint32_t bits, float *probability) {
    const lobe_scene *s = p->k->scene;
    if (!p->k->has_light_tree) {
        const uint32_t light = alias_draw(&s->light_table, bits);
        *probability = s->light_table.shares[light];
        return light;
    }
    const double u = (double)bits * 0x1p-32, far = (double)s->far_share;
    if (u < far || far == 1.0) return choose_far(s, (float)u, probability);
    const uint32_t light = lobe_light_tree_draw(&s->light_tree, p->place, p->facing,
                                                (u - far) / (1.0 - far), probability);
    *probability *= 1.0f - s->far_share;
    return light;
}

static float lamp_pdf(const path *p, const hit_point *h) {
    const lobe_scene *s = p->k->scene;
    const int32_t light = h->triangle->light;
    if (p->is_camera || light < 0 || !s->light_table.cells) return 0.0f;
    float share = light_share(p, (uint32_t)light) * (1.0f - sky_probability(s));
    float cosine = fabsf(v3_dot(h->geometric, p->direction));
    return share * h->distance * h->distance / maxf(s->light_areas[light] * cosine, 1e-20f);
}

/* Light met by the path itself, weighed against having drawn it as a lamp. */
static void add_met_light(path *p, vec3 radiance, float light_pdf) {
    float share = 1.0f;
    if (!p->is_camera && isfinite(p->pdf) && light_pdf > 0.0f)
        share = weigh(p->k->heuristic, p->pdf, light_pdf, 0);
    vec3 light = v3_mul(p->throughput, v3_scale(radiance, share));
    p->sample->radiance = v3_add(p->sample->radiance, light);
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
    add_met_light(p, radiance, pdf * sky_probability(s));
}

/* A place off the surface, on the side of the viewer or beyond, so that a ray does not meet it again. */
static vec3 lift(const hit_point *h, int is_beyond) {
    float size = maxf(fabsf(h->position.x), maxf(fabsf(h->position.y), fabsf(h->position.z)));
    float height = 2e-5f * (size + h->distance);
    return v3_add(h->position, v3_scale(h->geometric, is_beyond ? -height : height));
}

static int goes_through(const hit_point *h, const surface *s, vec3 direction) {
    return s->glass && v3_dot(direction, h->geometric) < 0.0f;
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

/* One point of light: direction, distance, radiance and density over directions. A point mass:
 * radiance is the irradiance across the direction, and the density the probability of the lamp. */
typedef struct light_sample {
    vec3 direction, radiance;
    float distance, pdf;
    int is_point_mass;
} light_sample;

/* The fall-off to 0 at the range and at the edge of the cone that KHR_lights_punctual recommends. */
static light_sample shine(const lamp *l, vec3 from) {
    light_sample d = {.radiance = l->intensity, .is_point_mass = 1};
    if (l->kind == LAMP_DIRECTIONAL) {
        d.direction = v3_neg(l->direction);
        d.distance = INFINITY;
        return d;
    }
    const vec3 to = v3_sub(l->position, from);
    d.distance = v3_length(to);
    d.direction = v3_normalize_or(to, v3(0.0f, 1.0f, 0.0f));
    float share = 1.0f / maxf(d.distance * d.distance, 1e-20f);
    if (l->range > 0.0f) {
        const float ratio = d.distance / l->range, square = ratio * ratio;
        share *= clampf(1.0f - square * square, 0.0f, 1.0f);
    }
    if (l->kind == LAMP_SPOT) {
        const float cosine = -v3_dot(d.direction, l->direction);
        const float edge =
            clampf((cosine - l->cos_outer) / maxf(l->cos_inner - l->cos_outer, 0.001f), 0.0f, 1.0f);
        share *= edge * edge;
    }
    d.radiance = v3_scale(d.radiance, share);
    return d;
}

static light_sample draw_lamp(const path *p, vec3 from, sampler_point point) {
    const lobe_scene *s = p->k->scene;
    float probability = 0.0f;
    const uint32_t light = choose_light(p, point.bits[1], &probability);
    if (light >= s->light_count) {
        light_sample l = shine(&s->lamps[light - s->light_count], from);
        l.pdf = probability;
        return l;
    }
    const triangle *t = &s->triangles[s->lights[light]];
    float root = sqrtf(sampler_unit(point.bits[2])), v = sampler_unit(point.bits[3]) * root;
    vec3 a = s->vertices[t->vertex[0]].position, b = s->vertices[t->vertex[1]].position,
         c = s->vertices[t->vertex[2]].position;
    vec3 place = hit_mean(a, b, c, root - v, v);
    vec3 to = v3_sub(place, from);
    light_sample l = {.distance = v3_length(to)};
    l.direction = v3_normalize_or(to, v3(0.0f, 1.0f, 0.0f));
    vec3 normal = v3_normalize_or(v3_cross(v3_sub(b, a), v3_sub(c, a)), l.direction);
    float cosine = fabsf(v3_dot(normal, l.direction));
    l.pdf = probability * l.distance * l.distance / maxf(s->light_areas[light] * cosine, 1e-20f);
    l.radiance = s->materials[t->material].emission;
    return l;
}

static light_sample draw_light(const path *p, vec3 from, sampler_point point) {
    const lobe_scene *s = p->k->scene;
    float sky = sky_probability(s);
    if (sampler_unit(point.bits[0]) < sky) {
        const sky_draw d = lobe_environment_draw(&s->sky, point.bits + 1);
        return (light_sample){d.direction, d.radiance, INFINITY, d.pdf * sky, 0};
    }
    light_sample l = draw_lamp(p, from, point);
    l.pdf *= 1.0f - sky;
    return l;
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
        share *= 1.0f - opacity_at(s, &hit);
    }
    return share;
}

/* Next-event estimation. */
static void add_drawn_light(path *p, const hit_point *h, const surface *surface,
                            sampler_point point) {
    const lobe_scene *s = p->k->scene;
    if (p->k->heuristic == LOBE_HEURISTIC_BSDF_ONLY) return;
    /* the base below a coat that is a mirror still sees the lamps */
    if (lobe_surface_is_clear(surface)) return;
    if (!s->light_table.cells && sky_probability(s) == 0.0f) return;
    vec3 from = lift(h, 0);
    light_sample l = draw_light(p, from, point);
    if (!(l.pdf > 0.0f)) return;
    float pdf;
    vec3 value = lobe_surface_value(surface, l.direction, &pdf);
    if (!(v3_max(value) > 0.0f)) return;
    if (!(v3_max(l.radiance) > 0.0f)) return;
    int is_through = goes_through(h, surface, l.direction);
    if (is_through) from = lift(h, 1);
    float share = transmittance(p, from, l.direction, l.distance * 0.9999f);
    if (!l.is_point_mass) share *= weigh(p->k->heuristic, l.pdf, pdf, 1);
    if (!(share > 0.0f)) return;
    vec3 light = v3_mul(p->throughput, v3_mul(value, l.radiance));
    light = absorbed(inside_after(p, h, is_through), light, l.distance);
    p->sample->radiance = v3_add(p->sample->radiance, v3_scale(light, share / l.pdf));
}

/* The random numbers of a light, ahead of their use: what they choose is far away in memory. */
static sampler_point begin_light(path *p) {
    const sampler_point point = lobe_sampler_next(p->points);
    const lobe_scene *s = p->k->scene;
    if (s->has_sky && s->sky.table.cells) lobe_environment_prefetch(&s->sky, point.bits + 1);
    return point;
}

static void keep_first_hit(path *p, const hit_point *h, const surface *surface) {
    p->sample->albedo = surface->base_color;
    p->sample->normal = h->shading.z;
    p->sample->depth = h->distance;
    if (p->k->keeps_vndf_integral && !surface->is_matte)
        p->sample->vndf_integral = lobe_reflection_vndf_integral_f32(&surface->ggx);
}

static void go_on(path *p, const hit_point *h, const surface *surface, vec3 direction) {
    int is_through = goes_through(h, surface, direction);
    p->origin = lift(h, is_through);
    p->direction = direction;
    p->is_camera = 0;
    if (!is_through || !is_solid(h->material)) return;
    float ior2 = h->material->ior * h->material->ior;
    p->spread *= h->is_back ? 1.0f / ior2 : ior2;
    p->inside = inside_after(p, h, 1);
}

/* Go on in a drawn direction; 0: the path ends. */
static int scatter(path *p, const hit_point *h, const surface *surface, int scatterings) {
    sampler_point point = lobe_sampler_next(p->points);
    float side = 0.0f;
    if (surface->glass) side = sampler_unit(lobe_sampler_next(p->points).bits[0]);
    surface_draw d =
        lobe_surface_draw(surface, sampler_unit(point.bits[0]), sampler_unit(point.bits[1]),
                          sampler_unit(point.bits[2]), side);
    p->sample->draws += (uint32_t)d.is_ggx;
    p->sample->rejected += d.is_ggx && !(d.pdf > 0.0f);
    if (!(d.pdf > 0.0f)) return 0;
    p->throughput = v3_mul(p->throughput, d.weight);
    p->pdf = d.is_mirror ? INFINITY : d.pdf;
    if (!d.is_mirror) cone_scatter(&p->cone, p->k->share, d.pdf);
    go_on(p, h, surface, d.direction);
    if (scatterings < p->k->roulette_depth) return v3_max(p->throughput) > 0.0f;
    float survival = minf(v3_max(p->throughput) * p->spread, 0.95f);
    if (!(sampler_unit(point.bits[3]) < survival)) return 0;
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
        const float opacity = s->is_opaque ? 1.0f : opacity_at(s, hit);
        if (opacity >= 1.0f) return 1;
        if (opacity > 0.0f && sampler_unit(lobe_sampler_next(p->points).bits[0]) < opacity)
            return 1;
    }
}

film_sample lobe_trace_path(const integrator *k, vec3 origin, vec3 direction, sampler *points,
                            uint64_t *rays) {
    film_sample sample = {.vndf_integral = 1.0f};
    path p = {.k = k,
              .points = points,
              .origin = origin,
              .place = origin,
              .direction = direction,
              .throughput = v3_all(1.0f),
              .spread = 1.0f,
              .is_camera = 1,
              .cone = cone_of_pixel(k->pixel_angle, k->axis, direction),
              .sample = &sample};
    surface s;
    layers room;
    for (int scatterings = 0;; scatterings++) {
        ray_hit hit;
        if (!meet_surface(&p, &hit)) {
            add_sky(&p);
            break;
        }
        const sampler_point light = begin_light(&p);
        hit_point h;
        cone_travel(&p.cone, hit.distance);
        find_hit_point(k->scene, &hit, p.direction, p.cone.width, &h);
        /* a camera inside */
        if (!p.inside && h.is_back && is_solid(h.material)) p.inside = h.material;
        if (p.inside)
            p.throughput = absorbed(p.inside, p.throughput, v3_length(v3_sub(h.position, p.place)));
        add_met_light(&p, h.emission, lamp_pdf(&p, &h));
        surface_of(&p, &h, v3_neg(p.direction), &s, &room);
        if (scatterings == 0) keep_first_hit(&p, &h, &s);
        if (scatterings == k->depth || h.material->is_unlit) break;
        p.place = h.position;
        p.facing = s.glass ? v3_all(0.0f) : h.geometric;
        add_drawn_light(&p, &h, &s, light);
        if (!scatter(&p, &h, &s, scatterings + 1)) break;
    }
    *rays += p.rays;
    return sample;
}

int lobe_first_surface(const lobe_scene *s, vec3 origin, vec3 direction,
                       lobe_ray_surface *surface) {
    ray_hit hit;
    float near = 0.0f;
    do {
        if (!lobe_tracer_nearest(s->tracer, origin, direction, near, INFINITY, &hit)) return 0;
        near = past(hit.distance);
    } while (opacity_at(s, &hit) < 0.5f);
    hit_point h;
    find_hit_point(s, &hit, direction, 0.0f, &h);
    const material *m = h.material;
    float roughness, metallic, anisotropy = m->anisotropy;
    read_surface(s, &h, &roughness, &metallic);
    const float step = (m->ior - 1.0f) / (m->ior + 1.0f);
    const coat_tint tint = tint_at(s, &h);
    const vec3 coat_f0 = v3_add(tint.one, v3_scale(tint.own, step * step));
    frame shading = h.shading;
    if (m->stretch > 0.0f) stretch(s, &h, &shading, &roughness, &anisotropy);
    *surface = (lobe_ray_surface){.distance = h.distance,
                                  .position = h.position,
                                  .normal = h.shading.z,
                                  .geometric = h.geometric,
                                  .f0 = v3_lerp(coat_f0, base_color_at(s, &h), metallic),
                                  .roughness = roughness,
                                  .anisotropy = anisotropy,
                                  .tangent = shading.x,
                                  .place = lobe_place_of(s, &hit)};
    return 1;
}
