#include "glass.h"

#include "lobe/albedo.h"
#include "lobe/fresnel.h"
#include "lobe/walk.h"

#include <math.h>

/* A sheet scatters once what a metal with F = 1 would reflect. */
static float sheet_factor(const glass_options *o, const glass *g) {
    if (!o->compensate || g->sheet.is_mirror) return 1.0f;
    lobe_albedo_f32 albedo = lobe_albedo_prepare_f32(o->ggx.model.ndf, o->ggx.model.masking,
                                                     o->ggx.g2, g->sheet.alpha_x, g->sheet.alpha_y);
    return 1.0f / maxf(1.0f - lobe_albedo_missing_f32(&albedo, g->sheet.wi), 1e-3f);
}

static void prepare_sheet(const glass_options *o, glass *g, vec3 wi) {
    const glass_material *m = &g->material;
    g->sheet = lobe_reflection_prepare_above_f32(o->ggx, wi, m->alpha_x, m->alpha_y,
                                                 frame_to_local(&g->frame, g->geometric));
    g->factor = sheet_factor(o, g);
}

/* What compensation would multiply by tells the share of single scattering. */
static void prepare_walks(const glass_options *o, glass *g, vec3 wi) {
    lobe_dielectric_options options = lobe_dielectric_default_options();
    options.compensate = 1;
    const float factor = lobe_dielectric_prepare_f32(options, wi, g->solid.alpha_x,
                                                     g->solid.alpha_y, g->material.ior)
                             .energy_factor;
    g->walk_once = clampf(1.0f / factor, 0.01f, 0.99f);
    g->walk_seed = o->walk_seed;
    g->wi = (lobe_vec3_f64){(double)wi.x, (double)wi.y, (double)wi.z};
}

static void prepare_solid(const glass_options *o, glass *g, vec3 wi, int is_back) {
    const glass_material *m = &g->material;
    lobe_dielectric_options options = lobe_dielectric_default_options();
    options.g2 = o->ggx.g2;
    options.compensate = o->compensate;
    if (is_back) {
        /* the same frame upside down: outward */
        g->frame.y = v3_neg(g->frame.y);
        g->frame.z = v3_neg(g->frame.z);
        wi.y = -wi.y;
        wi.z = -wi.z;
    }
    g->solid = lobe_dielectric_prepare_f32(options, wi, m->alpha_x, m->alpha_y, m->ior);
    if (o->walks && !g->solid.is_smooth && !g->solid.is_matched) prepare_walks(o, g, wi);
}

glass lobe_glass_at(const glass_options *options, glass_material material, frame shading,
                    vec3 geometric, vec3 to_viewer, int is_back) {
    glass g = {.material = material, .frame = shading, .geometric = geometric};
    vec3 wi = frame_to_local(&shading, to_viewer);
    if (!(wi.z > 0.0f)) {
        /* a shading normal that faces away would turn outside into inside */
        g.frame = frame_of(geometric, shading.x);
        wi = frame_to_local(&g.frame, to_viewer);
    }
    if (material.is_thin)
        prepare_sheet(options, &g, wi);
    else
        prepare_solid(options, &g, wi, is_back);
    return g;
}

int lobe_glass_is_clear(const glass *g) {
    return g->material.is_thin ? g->sheet.is_mirror : g->solid.is_smooth || g->solid.is_matched;
}

/* Whether a direction is on the same side of the triangle as of the shading frame. */
static int is_proper(const glass *g, vec3 direction, int is_transmitted) {
    return (v3_dot(direction, g->geometric) < 0.0f) == (is_transmitted != 0);
}

static vec3 color_of(const glass *g, int is_transmitted) {
    return is_transmitted ? g->material.tint : v3_all(1.0f);
}

static float sheet_reflectance(const glass *g, float cosine) {
    float f = lobe_fresnel_dielectric_f32(g->material.ior, cosine);
    return 2.0f * f / (1.0f + f);
}

enum { WALK_BOUNCES = 1000 };

static lobe_microsurface microsurface_of(const glass *g) {
    return (lobe_microsurface){LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED,
                               (double)g->solid.alpha_x, (double)g->solid.alpha_y};
}

static float walk_density(const glass *g, vec3 wo, float pdf_once) {
    return g->walk_once * pdf_once + (1.0f - g->walk_once) * fabsf(wo.z) / (2.0f * LOBE_PI);
}

/* Tint, and what the boundary does to radiance. */
static vec3 walk_color(const glass *g, int is_transmitted) {
    if (!is_transmitted) return v3_all(1.0f);
    const float squared = g->material.ior * g->material.ior;
    return v3_scale(g->material.tint, g->wi.z < 0.0 ? squared : 1.0f / squared);
}

static int is_across(const glass *g, vec3 wo) {
    return (wo.z < 0.0f) != (g->wi.z < 0.0);
}

static glass_draw draw_walk(const glass *g) {
    const lobe_walk walk = lobe_walk_dielectric_sample(microsurface_of(g), (double)g->material.ior,
                                                       g->wi, g->walk_seed, 3, WALK_BOUNCES);
    const vec3 wo = v3((float)walk.wo.x, (float)walk.wo.y, (float)walk.wo.z);
    const int is_transmitted = is_across(g, wo);
    glass_draw draw = {.direction = frame_to_world(&g->frame, wo)};
    if (walk.bounces == 0 || !is_proper(g, draw.direction, is_transmitted)) return draw;
    const float once = lobe_dielectric_eval_wo_f32(&g->solid, wo).pdf;
    draw.pdf = maxf(walk_density(g, wo, once), 1e-30f);
    draw.weight = walk_color(g, is_transmitted);
    return draw;
}

static vec3 walk_value(const glass *g, vec3 wo, float pdf_once, float *pdf) {
    const lobe_vec3_f64 toward = {(double)wo.x, (double)wo.y, (double)wo.z};
    double value;
    lobe_walk_dielectric_eval(microsurface_of(g), (double)g->material.ior, g->wi, toward,
                              g->walk_seed, 2, WALK_BOUNCES, &value);
    *pdf = walk_density(g, wo, pdf_once);
    return v3_scale(walk_color(g, is_across(g, wo)), (float)value);
}

static glass_draw draw_solid(const glass *g, float u1, float u2, float side) {
    if (g->walk_once > 0.0f) return draw_walk(g);
    lobe_dielectric_draw_f32 d = lobe_dielectric_sample_f32(&g->solid, u1, u2, side);
    glass_draw draw = {.direction = frame_to_world(&g->frame, d.wo), .is_point = d.is_point};
    if (!(d.pdf > 0.0f) || !is_proper(g, draw.direction, d.transmitted)) return draw;
    draw.pdf = d.pdf;
    draw.weight = v3_scale(color_of(g, d.transmitted), d.weight);
    return draw;
}

static glass_draw draw_sheet(const glass *g, float u1, float u2, float u3, float side) {
    lobe_reflection_draw_f32 d = lobe_reflection_sample_f32(&g->sheet, u1, u2, u3);
    float reflectance = sheet_reflectance(g, d.cos_im);
    int is_transmitted = !(side < reflectance);
    if (is_transmitted) d.wo.z = -d.wo.z;
    glass_draw draw = {.direction = frame_to_world(&g->frame, d.wo),
                       .is_point = g->sheet.is_mirror};
    if (!(d.pdf > 0.0f) || !is_proper(g, draw.direction, is_transmitted)) return draw;
    draw.pdf = d.pdf * (is_transmitted ? 1.0f - reflectance : reflectance);
    draw.weight = v3_scale(color_of(g, is_transmitted), d.weight * g->factor);
    return draw;
}

glass_draw lobe_glass_draw(const glass *g, float u1, float u2, float u3, float side) {
    return g->material.is_thin ? draw_sheet(g, u1, u2, u3, side) : draw_solid(g, u1, u2, side);
}

static vec3 sheet_value(const glass *g, vec3 wo, float *pdf) {
    int is_transmitted = wo.z < 0.0f;
    wo.z = fabsf(wo.z);
    lobe_reflection_eval_f32 e = lobe_reflection_eval_wo_f32(&g->sheet, wo);
    float reflectance = sheet_reflectance(g, e.cos_im);
    float share = is_transmitted ? 1.0f - reflectance : reflectance;
    *pdf = e.pdf * share;
    return v3_scale(color_of(g, is_transmitted), e.f_cos * share * g->factor);
}

vec3 lobe_glass_value(const glass *g, vec3 direction, float *pdf) {
    *pdf = 0.0f;
    vec3 wo = frame_to_local(&g->frame, direction);
    if (g->material.is_thin)
        return is_proper(g, direction, wo.z < 0.0f) ? sheet_value(g, wo, pdf) : v3_all(0.0f);
    lobe_dielectric_eval_f32 e = lobe_dielectric_eval_wo_f32(&g->solid, wo);
    if (!is_proper(g, direction, e.transmitted)) return v3_all(0.0f);
    if (g->walk_once > 0.0f) return walk_value(g, wo, e.pdf, pdf);
    *pdf = e.pdf;
    return v3_scale(color_of(g, e.transmitted), e.f_cos);
}
