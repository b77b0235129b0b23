#include "light.h"

#include "hit.h"

float lobe_light_sky_probability(const lobe_scene *s) {
    int sky = s->has_sky && s->sky.table.cells, lamps = s->light_table.cells != NULL;
    return sky ? (lamps ? 0.5f : 1.0f) : 0.0f;
}

/* Probability of choosing an emissive triangle. */
static float share_of(const lobe_scene *s, const lit_place *lit, uint32_t light) {
    if (!lit->has_tree) return s->light_table.shares[light];
    return (1.0f - s->far_share) *
           lobe_light_tree_probability(&s->light_tree, lit->place, lit->facing, light);
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

static uint32_t choose(const lobe_scene *s, const lit_place *lit, uint32_t bits,
                       float *probability) {
    if (!lit->has_tree) {
        const uint32_t light = alias_draw(&s->light_table, bits);
        *probability = s->light_table.shares[light];
        return light;
    }
    const double u = (double)bits * 0x1p-32, far = (double)s->far_share;
    if (u < far || far == 1.0) return choose_far(s, (float)u, probability);
    const uint32_t light = lobe_light_tree_draw(&s->light_tree, lit->place, lit->facing,
                                                (u - far) / (1.0 - far), probability);
    *probability *= 1.0f - s->far_share;
    return light;
}

float lobe_light_lamp_pdf(const lobe_scene *s, const lit_place *lit, const hit_point *h,
                          vec3 direction) {
    const int32_t light = h->triangle->light;
    if (light < 0 || !s->light_table.cells) return 0.0f;
    float share = share_of(s, lit, (uint32_t)light) * (1.0f - lobe_light_sky_probability(s));
    float cosine = fabsf(v3_dot(h->geometric, direction));
    return share * h->distance * h->distance / maxf(s->light_areas[light] * cosine, 1e-20f);
}

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

static light_sample draw_lamp(const lobe_scene *s, const lit_place *lit, vec3 from,
                              sampler_point point) {
    float probability = 0.0f;
    const uint32_t light = choose(s, lit, point.bits[1], &probability);
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

light_sample lobe_light_draw(const lobe_scene *s, const lit_place *lit, vec3 from,
                             sampler_point point) {
    float sky = lobe_light_sky_probability(s);
    if (sampler_unit(point.bits[0]) < sky) {
        const sky_draw d = lobe_environment_draw(&s->sky, point.bits + 1);
        return (light_sample){d.direction, d.radiance, INFINITY, d.pdf * sky, 0};
    }
    light_sample l = draw_lamp(s, lit, from, point);
    l.pdf *= 1.0f - sky;
    return l;
}
