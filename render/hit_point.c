#include "hit_point.h"

#include "cone.h"
#include "hit.h"

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
                             ? hit_map(s, map, h, v3_all(1.0f))
                             : hit_directions(s, map, h, v3_all(1.0f)));
}

float lobe_hit_opacity(const lobe_scene *s, const ray_hit *hit) {
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

vec3 lobe_hit_normal(const lobe_scene *s, const hit_point *h, const texture_map *map, float scale) {
    const frame *f = &h->smooth;
    if (map->texture == NO_TEXTURE) return f->z;
    vec3 t = hit_directions(s, map, h, v3_all(0.0f));
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
    const vec3 mapped = lobe_hit_normal(s, h, &m->normal_map, m->normal_scale);
    h->shading = frame_of(v3_scale(mapped, side), tangent);
}

static vec3 emission_at(const lobe_scene *s, const hit_point *h) {
    const material *m = h->material;
    if (m->is_unlit) return base_color_at(s, h);
    if (!(v3_max(m->emission) > 0.0f)) return v3_all(0.0f);
    return v3_mul(m->emission, hit_map(s, &m->emission_map, h, v3_all(1.0f)));
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
void lobe_hit_point_find(const lobe_scene *s, const ray_hit *hit, vec3 direction, float width,
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

/* KHR_materials_anisotropy, in the terms of lobe_surface_at: alpha grows toward 1 along a direction of
 * the tangent plane, which becomes the frame's x. */
static void stretch(const lobe_scene *s, hit_point *h, hit_looks *l) {
    const material *m = h->material;
    frame *f = &h->shading;
    const vec3 t = hit_directions(s, &m->stretch_map, h, v3(1.0f, 0.5f, 1.0f));
    const float x = 2.0f * t.x - 1.0f, y = 2.0f * t.y - 1.0f, strength = m->stretch * t.z;
    const float along = m->stretch_x * x - m->stretch_y * y;
    const float across = (m->stretch_y * x + m->stretch_x * y) * h->turn;
    *f = frame_of(f->z, v3_add(v3_scale(f->x, along), v3_scale(f->y, across)));
    const float alpha_y = maxf(l->roughness * l->roughness, 0.001f);
    const float alpha_x = alpha_y + (1.0f - alpha_y) * strength * strength;
    l->roughness = sqrtf(0.5f * (alpha_x + alpha_y));
    l->anisotropy = (alpha_x - alpha_y) / (alpha_x + alpha_y);
}

hit_looks lobe_hit_looks(const lobe_scene *s, hit_point *h) {
    const material *m = h->material;
    hit_looks l = {.base_color = base_color_at(s, h)};
    if (m->is_matte) return l;
    const vec3 one = hit_map(s, &m->roughness_map, h, v3_all(1.0f));
    const vec3 other = m->is_packed ? one : hit_map(s, &m->metallic_map, h, v3_all(1.0f));
    l.metallic = m->metallic * other.z;
    l.roughness = m->roughness * one.y;
    l.anisotropy = m->anisotropy;
    l.transmission = m->transmission;
    if (l.transmission > 0.0f)
        l.transmission *= (1.0f - l.metallic) * hit_map(s, &m->transmission_map, h, v3_all(1.0f)).x;
    if (m->stretch > 0.0f) stretch(s, h, &l);
    return l;
}

coat_tint lobe_hit_tint(const lobe_scene *s, const hit_point *h) {
    const material *m = h->material;
    const texture_map *map = &m->specular_map;
    if (map->texture == NO_TEXTURE && m->specular_color_map.texture == NO_TEXTURE) return m->tint;
    float share = m->specular;
    if (map->texture != NO_TEXTURE)
        share *= lobe_texture_alpha_at(&s->textures[map->texture], map, h->u[map->uv_set],
                                       h->v[map->uv_set]);
    vec3 color = hit_map(s, &m->specular_color_map, h, v3_all(1.0f));
    return lobe_coat_tint(m->ior, share, v3_mul(m->specular_color, color));
}

vec3 lobe_hit_lift(const hit_point *h, int is_beyond) {
    float size = maxf(fabsf(h->position.x), maxf(fabsf(h->position.y), fabsf(h->position.z)));
    float height = 2e-5f * (size + h->distance);
    return v3_add(h->position, v3_scale(h->geometric, is_beyond ? -height : height));
}
