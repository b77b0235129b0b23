#include "material.h"

#include "circle.h"

/* Of an index that is high F dips on the way to the horizon: a dark tint could take more than there is. */
static vec3 coat_fresnel(const surface *s, float cosine) {
    vec3 own = v3_scale(s->tint.own, lobe_fresnel_dielectric_f32(s->ior, cosine));
    vec3 f = v3_scale(v3_add(s->tint.one, own), 1.0f - s->metallic);
    return v3(maxf(f.x, 0.0f), maxf(f.y, 0.0f), maxf(f.z, 0.0f));
}

static vec3 fresnel(const surface *s, float cosine) {
    if (!(s->metallic > 0.0f)) return coat_fresnel(s, cosine);
    const vec3 metal = v3_mul(lobe_metal_at(s->metal, s->base_color, cosine), s->factor);
    if (s->metallic >= 1.0f) return metal;
    return v3_add(v3_scale(metal, s->metallic), coat_fresnel(s, cosine));
}

/* The albedo of the coat toward a local direction, and its average, in the channel that reflects most. */
static float coat_albedo(const surface *s, vec3 w) {
    float e = s->tint.most_own * lobe_coat_albedo(&s->coat, w);
    if (s->tint.most_one != 0.0f)
        e += s->tint.most_one * (1.0f - lobe_albedo_missing_f32(&s->albedo, w));
    return clampf(e, 0.0f, 1.0f);
}

static float coat_average(const surface *s) {
    float e = s->tint.most_own * lobe_coat_average(&s->coat);
    if (s->tint.most_one != 0.0f) e += s->tint.most_one * (1.0f - s->albedo.missing_average);
    return clampf(e, 0.0f, 0.9999f);
}

static lobe_albedo_f32 albedo_of(const surface *s, const lobe_reflection_options *o) {
    return lobe_albedo_prepare_f32(o->model.ndf, o->model.masking, o->g2, s->ggx.alpha_x,
                                   s->ggx.alpha_y);
}

/* The metal's scatterings after the first; returns the albedo of the second lobe. */
static float compensate(surface *s, lobe_multiscatter multiscatter,
                        const lobe_reflection_options *o) {
    s->rest = v3_all(0.0f);
    s->factor = v3_all(1.0f);
    if (multiscatter == LOBE_MULTISCATTER_NONE || !(s->metallic > 0.0f)) return 0.0f;
    if (multiscatter == LOBE_MULTISCATTER_WALK && !(s->ggx.wi.z > 0.0f)) return 0.0f;
    s->albedo = albedo_of(s, o);
    float missing = lobe_albedo_missing_f32(&s->albedo, s->ggx.wi);
    if (s->ggx.is_mirror || !(missing > 0.0f)) return 0.0f;
    if (multiscatter == LOBE_MULTISCATTER_WALK) {
        s->factor = v3_all(0.0f);
        s->walks = s->ggx.is_valid ? 1.0f : 0.0f;
        s->walk_once = 1.0f - missing;
        return 0.0f;
    }
    const vec3 f0 = s->f0;
    if (multiscatter == LOBE_MULTISCATTER_TURQUIN) {
        s->factor = v3(lobe_multiscatter_turquin_f32(f0.x, missing),
                       lobe_multiscatter_turquin_f32(f0.y, missing),
                       lobe_multiscatter_turquin_f32(f0.z, missing));
        return 0.0f;
    }
    const float average = s->albedo.missing_average;
    const vec3 f_avg = lobe_metal_average(s->metal, s->base_color);
    const vec3 color =
        v3(lobe_multiscatter_fms_f32(f_avg.x, average), lobe_multiscatter_fms_f32(f_avg.y, average),
           lobe_multiscatter_fms_f32(f_avg.z, average));
    float lobe = lobe_multiscatter_kulla_conty_f32(s->metallic, missing, 1.0f, average);
    s->rest = v3_scale(color, lobe);
    return s->metallic * missing * v3_luminance(color);
}

/* In proportion to what each lobe reflects; `rest` by the metal's second lobe. Neither the GGX nor a
 * base is starved, if it is there. */
static float specular_probability(const surface *s, float coat_i, float rest) {
    float base = v3_luminance(s->base_color);
    float specular = s->metallic * v3_luminance(s->f0) + (1.0f - s->metallic) * coat_i;
    float diffuse = (1.0f - s->metallic) * base * (1.0f - coat_i) + rest;
    if (!(specular > 0.0f) && diffuse > 0.0f) return 0.0f;
    return clampf(specular / maxf(specular + diffuse, 1e-6f), 0.1f, 1.0f);
}

/* A metal that walks beside a coat and its base: the three in proportion to what they reflect. */
static void share_walks(surface *s, float coat_i) {
    float base = v3_luminance(s->base_color), rest = 1.0f - s->metallic;
    float metal = s->metallic * v3_luminance(s->f0), diffuse = rest * base * (1.0f - coat_i);
    s->walks = clampf(metal / maxf(metal + rest * coat_i + diffuse, 1e-6f), 0.1f, 0.9f);
    s->specular = clampf(rest * coat_i / maxf(rest * coat_i + diffuse, 1e-6f), 0.1f, 1.0f);
}

/* A metal smoother than this rejects so little that the picture does not show it. */
#define SMOOTH_ALPHA 0.1f
/* From this tilt of the shading normal on, the smaller of two ellipses rejects less than the one of
 * `horizon`, and a table of nodes costs more than it saves. */
#define TILT_COSINE 0.985f

lobe_method lobe_surface_method(lobe_method asked, float metallic, float alpha, float tilt_cosine) {
    if (asked != LOBE_METHOD_COUNT) return asked;
    if (metallic < 0.5f || alpha < SMOOTH_ALPHA) return LOBE_METHOD_BOUNDED;
    return tilt_cosine < TILT_COSINE ? LOBE_METHOD_HORIZON_UNIFORM : LOBE_METHOD_HORIZON;
}

void lobe_surface_make(surface *s, const surface_options *options, frame shading, vec3 geometric,
                       vec3 to_viewer, vec3 base_color, float metallic, float roughness,
                       float anisotropy, uint64_t random) {
    s->frame = shading;
    s->geometric = geometric;
    s->is_matte = 0;
    s->base_color = base_color;
    s->metallic = metallic;
    s->metal = options->metal;
    s->f0 = lobe_metal_f0(s->metal, base_color);
    s->ior = options->coat->ior;
    s->tint = options->tint;
    s->base_share_i = 0.0f;
    s->albedo.is_valid = 0;
    s->walks = s->walk_once = 0.0f;
    s->walk_seed = random;
    s->ndf = options->ggx.model.ndf;
    s->masking = options->ggx.model.masking;
    s->glass = NULL;
    s->clearcoat = NULL;
    const vec3 wi = frame_to_local(&shading, to_viewer);
    const float alpha = roughness * roughness;
    const vec3 plane = frame_to_local(&shading, geometric);
    lobe_reflection_options ggx = options->ggx;
    ggx.model.method = lobe_surface_method(ggx.model.method, metallic, alpha, plane.z);
    lobe_reflection_prepare_at_f32(&s->ggx, &ggx, wi, alpha * (1.0f + anisotropy),
                                   alpha * (1.0f - anisotropy), plane);
    const float rest = compensate(s, options->multiscatter, &options->ggx);
    s->specular = rest > 0.0f ? specular_probability(s, 0.0f, rest) : 1.0f;
    if (metallic >= 1.0f) return;
    s->coat = lobe_coat_at(options->coat, &s->ggx);
    if (s->tint.most_one != 0.0f && !s->albedo.is_valid) s->albedo = albedo_of(s, &options->ggx);
    const float coat_i = coat_albedo(s, wi);
    s->base_share_i = (1.0f - metallic) * (1.0f - coat_i) / (LOBE_PI * (1.0f - coat_average(s)));
    s->specular = specular_probability(s, coat_i, rest);
    if (s->walks > 0.0f) share_walks(s, coat_i);
}

void lobe_surface_make_matte(surface *s, frame shading, vec3 geometric, vec3 base_color) {
    s->frame = shading;
    s->geometric = geometric;
    s->is_matte = 1;
    s->base_color = base_color;
    s->walks = 0.0f;
    s->glass = NULL;
    s->clearcoat = NULL;
}

enum { WALK_BOUNCES = 1000 };

static lobe_vec3_f64 in_double(vec3 v) {
    return (lobe_vec3_f64){(double)v.x, (double)v.y, (double)v.z};
}

static lobe_microsurface microsurface_of(const surface *s) {
    return (lobe_microsurface){s->ndf, s->masking, LOBE_G2_CORRELATED, (double)s->ggx.alpha_x,
                               (double)s->ggx.alpha_y};
}

static vec3 color_of(const double values[3], float share) {
    return v3((float)values[0] * share, (float)values[1] * share, (float)values[2] * share);
}

static vec3 walk_value(const surface *s, vec3 wo) {
    lobe_reflectance laws[3];
    double values[3];
    lobe_metal_reflectances(s->metal, s->base_color, laws);
    lobe_walk_eval(microsurface_of(s), laws, 3, in_double(s->ggx.wi), in_double(wo), s->walk_seed,
                   0, WALK_BOUNCES, values);
    return color_of(values, s->metallic);
}

void lobe_surface_add_glass(surface *s, glass *room, const surface_options *options,
                            glass_material material, vec3 to_viewer, int is_back) {
    const int walks = options->multiscatter == LOBE_MULTISCATTER_WALK;
    /* of thin walls no walk is known */
    const int compensate =
        walks ? material.is_thin : options->multiscatter != LOBE_MULTISCATTER_NONE;
    glass_options o = {options->ggx, compensate, walks, s->walk_seed};
    o.ggx.model.method =
        lobe_surface_method(options->ggx.model.method, 0.0f, material.alpha_x, 1.0f);
    *room = lobe_glass_at(&o, material, s->frame, s->geometric, to_viewer, is_back);
    s->glass = room;
}

static float glass_share(const surface *s) {
    return s->glass ? s->glass->material.share : 0.0f;
}

void lobe_surface_add_clearcoat(surface *s, clearcoat *room, const surface_options *options,
                                const coat_table *table, frame shading, vec3 to_viewer, float share,
                                float roughness) {
    lobe_reflection_options o = options->ggx;
    o.model.method = lobe_surface_method(o.model.method, 0.0f, roughness * roughness, 1.0f);
    const float base = v3_luminance(s->base_color);
    *room = lobe_clearcoat_at(&o, table, shading, s->geometric, to_viewer, share, roughness,
                              base + s->metallic * (v3_luminance(s->f0) - base));
    s->clearcoat = room;
}

static int is_clear_below(const surface *s) {
    if (s->is_matte) return 0;
    float share = glass_share(s);
    if (share > 0.0f && !lobe_glass_is_clear(s->glass)) return 0;
    return share >= 1.0f || (s->ggx.is_mirror && s->specular >= 1.0f);
}

int lobe_surface_is_clear(const surface *s) {
    return (!s->clearcoat || s->clearcoat->ggx.is_mirror) && is_clear_below(s);
}

/* What the GGX alone makes of a direction. */
typedef struct ggx_value {
    float f_cos, pdf, cos_im;
} ggx_value;

/* All opaque lobes but a walk, and the density of drawing any of them. */
static vec3 value_beside(const surface *s, vec3 wo, ggx_value ggx, float *pdf) {
    vec3 value = v3_scale(fresnel(s, ggx.cos_im), ggx.f_cos);
    *pdf = s->specular * ggx.pdf + (1.0f - s->specular) * wo.z / LOBE_PI;
    if (v3_max(s->rest) > 0.0f)
        value = v3_add(value, v3_scale(s->rest, lobe_albedo_missing_f32(&s->albedo, wo) * wo.z));
    if (!(s->base_share_i > 0.0f)) return value;
    float share = s->base_share_i * (1.0f - coat_albedo(s, wo)) * wo.z;
    return v3_add(value, v3_scale(s->base_color, share));
}

/* The density of every opaque lobe, what stands for that of a walk included. */
static float density(const surface *s, float ggx_pdf, vec3 wo, float beside) {
    float walk = s->walk_once * ggx_pdf + (1.0f - s->walk_once) * wo.z / LOBE_PI;
    return s->walks * walk + (1.0f - s->walks) * beside;
}

static int leaves(const surface *s, vec3 wo, vec3 direction) {
    return wo.z > 0.0f && v3_dot(direction, s->geometric) > 0.0f;
}

static ggx_value ggx_at(const surface *s, vec3 wo) {
    lobe_reflection_eval_f32 e = lobe_reflection_eval_wo_f32(&s->ggx, wo);
    return (ggx_value){e.f_cos, e.pdf, e.cos_im};
}

static vec3 opaque_value(const surface *s, vec3 direction, float *pdf) {
    *pdf = 0.0f;
    vec3 wo = frame_to_local(&s->frame, direction);
    if (!leaves(s, wo, direction)) return v3_all(0.0f);
    if (s->is_matte) {
        *pdf = wo.z / LOBE_PI;
        return v3_scale(s->base_color, *pdf);
    }
    ggx_value ggx = ggx_at(s, wo);
    float beside;
    vec3 value = value_beside(s, wo, ggx, &beside);
    *pdf = density(s, ggx.pdf, wo, beside);
    return s->walks > 0.0f ? v3_add(value, walk_value(s, wo)) : value;
}

/* Of all below a clear coat. */
static vec3 value_below(const surface *s, vec3 direction, float *pdf) {
    float share = glass_share(s);
    if (!(share > 0.0f)) return opaque_value(s, direction, pdf);
    vec3 value = v3_scale(lobe_glass_value(s->glass, direction, pdf), share);
    if (share >= 1.0f) return value;
    float pdf_of_rest;
    vec3 rest = opaque_value(s, direction, &pdf_of_rest);
    *pdf = share * *pdf + (1.0f - share) * pdf_of_rest;
    return v3_add(value, v3_scale(rest, 1.0f - share));
}

vec3 lobe_surface_value(const surface *s, vec3 direction, float *pdf) {
    vec3 value = value_below(s, direction, pdf);
    const clearcoat *c = s->clearcoat;
    if (!c) return value;
    float coat_pdf, coat = lobe_clearcoat_value(c, direction, &coat_pdf);
    *pdf = c->probability * coat_pdf + (1.0f - c->probability) * *pdf;
    return v3_add(v3_scale(value, c->keeps), v3_all(coat));
}

static surface_draw rejected(int is_ggx) {
    return (surface_draw){.is_ggx = is_ggx};
}

/* A direction drawn beside the walks, weighed with all that is there. */
static surface_draw weigh(const surface *s, vec3 direction, vec3 wo, ggx_value ggx, int is_ggx) {
    float beside;
    vec3 value = value_beside(s, wo, ggx, &beside);
    if (!(beside > 0.0f)) return rejected(is_ggx);
    return (surface_draw){.direction = direction,
                          .weight = v3_scale(value, 1.0f / ((1.0f - s->walks) * beside)),
                          .pdf = density(s, ggx.pdf, wo, beside),
                          .is_ggx = is_ggx};
}

static surface_draw draw_ggx(const surface *s, float u1, float u2, float u3) {
    lobe_reflection_draw_f32 d = lobe_reflection_sample_f32(&s->ggx, u1, u2, u3);
    if (!(d.pdf > 0.0f)) return rejected(1);
    vec3 direction = frame_to_world(&s->frame, d.wo);
    if (s->ggx.is_mirror || (s->specular >= 1.0f && !(s->walks > 0.0f)))
        /* the weight of the draw itself: exact, no density is divided out */
        return (surface_draw){.direction = direction,
                              .weight = v3_scale(fresnel(s, d.cos_im), d.weight / s->specular),
                              .pdf = d.pdf,
                              .is_mirror = s->ggx.is_mirror,
                              .is_ggx = 1};
    /* the draw knows the GGX's value and density: nothing is evaluated again */
    return weigh(s, direction, d.wo, (ggx_value){d.weight * d.pdf, d.pdf, d.cos_im}, 1);
}

static surface_draw draw_base(const surface *s, float u1, float u2) {
    float radius = sqrtf(u1), sine, cosine;
    circle_at(u2, &sine, &cosine);
    vec3 wo = {radius * cosine, radius * sine, sqrtf(1.0f - u1)};
    vec3 direction = frame_to_world(&s->frame, wo);
    if (!leaves(s, wo, direction)) return rejected(0);
    if (s->is_matte)
        return (surface_draw){
            .direction = direction, .weight = s->base_color, .pdf = wo.z / LOBE_PI};
    return weigh(s, direction, wo, ggx_at(s, wo), 0);
}

static surface_draw draw_walk(const surface *s) {
    lobe_reflectance laws[3];
    double weights[3];
    lobe_metal_reflectances(s->metal, s->base_color, laws);
    lobe_walk walk = lobe_walk_sample(microsurface_of(s), laws, 3, in_double(s->ggx.wi),
                                      s->walk_seed, 1, WALK_BOUNCES, weights);
    vec3 wo = v3((float)walk.wo.x, (float)walk.wo.y, (float)walk.wo.z);
    vec3 direction = frame_to_world(&s->frame, wo);
    if (walk.bounces == 0 || !leaves(s, wo, direction)) return rejected(1);
    float pdf = ggx_at(s, wo).pdf;
    float beside = s->specular * pdf + (1.0f - s->specular) * wo.z / LOBE_PI;
    return (surface_draw){.direction = direction,
                          .weight = color_of(weights, s->metallic / s->walks),
                          .pdf = maxf(density(s, pdf, wo, beside), 1e-30f),
                          .is_ggx = 1};
}

static surface_draw draw_opaque(const surface *s, float choice, float u1, float u2) {
    if (s->is_matte) return draw_base(s, u1, u2);
    if (choice < s->walks) return draw_walk(s);
    /* what is left of a choice is a number of its own */
    choice = (choice - s->walks) / (1.0f - s->walks);
    if (choice < s->specular) return draw_ggx(s, u1, u2, choice / s->specular);
    return draw_base(s, u1, u2);
}

/* A walk has no density to divide by: beside one, every lobe is weighed alone. */
static int has_walks(const surface *s) {
    return s->walks > 0.0f || (s->glass && s->glass->walk_once > 0.0f);
}

/* A draw of the glass or of the rest, weighed as one of both. Of a point mass nothing else can be drawn, and
 * its share is its probability. */
static surface_draw among_others(const surface *s, surface_draw d, float probability) {
    if (!(d.pdf > 0.0f)) return d;
    if (d.is_mirror) {
        d.pdf *= probability;
        return d;
    }
    vec3 value = value_below(s, d.direction, &d.pdf);
    if (has_walks(s)) return d;
    d.weight = d.pdf > 0.0f ? v3_scale(value, 1.0f / d.pdf) : v3_all(0.0f);
    return d;
}

static surface_draw draw_below(const surface *s, float choice, float u1, float u2, float side) {
    float share = glass_share(s);
    if (!(share > 0.0f)) return draw_opaque(s, choice, u1, u2);
    if (!(choice < share))
        return among_others(s, draw_opaque(s, (choice - share) / (1.0f - share), u1, u2),
                            1.0f - share);
    glass_draw g = lobe_glass_draw(s->glass, u1, u2, choice / share, side);
    surface_draw d = {g.direction, g.weight, g.pdf, g.is_point, 1};
    return share < 1.0f ? among_others(s, d, share) : d;
}

surface_draw lobe_surface_draw(const surface *s, float choice, float u1, float u2, float side) {
    const clearcoat *c = s->clearcoat;
    if (!c) return draw_below(s, choice, u1, u2, side);
    float probability = c->probability;
    surface_draw d;
    if (choice < probability) {
        clearcoat_draw above = lobe_clearcoat_draw(c, u1, u2, choice / probability);
        d = (surface_draw){above.direction, v3_all(above.weight / probability), above.pdf,
                           c->ggx.is_mirror, 1};
    } else {
        choice = (choice - probability) / (1.0f - probability);
        d = draw_below(s, choice, u1, u2, side);
        d.weight = v3_scale(d.weight, c->keeps / (1.0f - probability));
    }
    if (!(d.pdf > 0.0f) || d.is_mirror) return d;
    vec3 value = lobe_surface_value(s, d.direction, &d.pdf);
    if (!has_walks(s)) d.weight = d.pdf > 0.0f ? v3_scale(value, 1.0f / d.pdf) : v3_all(0.0f);
    return d;
}
