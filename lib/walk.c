/* lib/walk.c: random walks on a Smith microsurface.
 *
 * Heitz et al. 2016 draw heights; a height matters only through the share c of the surface below it,
 * and c only through the depth l = -ln c: along a direction w the ray meets a facet at
 *   l' = l - e w_z/area,   e exponential, area = V(-w)/2 what it sees of the facets,
 * and has left where l' < 0: area/w_z is Lambda(w) for a ray that ascends, -(1 + Lambda(-w)) for one that
 * descends. The facet is drawn from the normals visible from where the ray comes.
 * A ray that a facet refracts goes on below the surface, which is the same surface turned about a point:
 * there w becomes -w and c becomes 1 - c. */
#include "../kernel/bind/c_f64.h"

#include "lobe/random.h"
#include "lobe/walk.h"

#include "../kernel/dielectric.h"
#include "../kernel/dielectric_masking.h"
#include "walk_sight.h"

#include <stddef.h>

typedef struct walker {
    lobe_microsurface s;
    walk_sight sight;
    v3 w;         /* of the ray, seen from its side of the surface */
    double depth; /* l */
    lobe_random4 random;
    uint64_t seed, index;
    uint64_t bounces; /* so far */
} walker;

static double unit(uint32_t word) {
    return (word + 0.5) * 0x1p-32;
}

/* false: only Smith has a random walk, or an input is unusable. wi: above the surface. */
static bool begin(walker *k, lobe_microsurface s, v3 wi, uint64_t seed, uint64_t index) {
    const bool known = (unsigned)s.ndf < LOBE_NDF_COUNT && s.masking == LOBE_MASKING_SMITH;
    const bool usable = facet_inputs_usable(wi, s.alpha_x, s.alpha_y, v3_of(0.0, 0.0, 1.0));
    k->s = s;
    k->w = v3_scale(wi, -1.0);
    k->depth = 0.0;
    k->seed = seed;
    k->index = index;
    k->bounces = 0;
    return known && usable && wi.z > 0.0;
}

/* To the next facet; false: the ray leaves. */
static bool fly(walker *k) {
    k->random = lobe_random(k->seed, k->index, k->bounces);
    k->sight = walk_sight_of(k->s, v3_scale(k->w, -1.0));
    if (k->sight.is_blind) return false;
    const double exponential = -k_log(1.0 - unit(k->random.word[0]));
    k->depth -= k->w.z * exponential / k_max(k->sight.area, K_TINY);
    return !(k->depth < 0.0);
}

static facet_draw meet(const walker *k) {
    return walk_sight_draw(&k->sight, unit(k->random.word[1]), unit(k->random.word[2]));
}

static void go_on(walker *k, v3 w) {
    k->w = v3_normalize(w);
    k->bounces++;
}

static void fill(double *values, int count, double value) {
    for (int k = 0; k < count; ++k) values[k] = value;
}

static v3 inward(lobe_vec3_f64 w) {
    return v3_of(w.x, w.y, w.z);
}

static lobe_vec3_f64 outward(v3 w) {
    return (lobe_vec3_f64){w.x, w.y, w.z};
}

static const lobe_walk cut = {{0.0, 0.0, 1.0}, 0};

lobe_walk lobe_walk_sample(lobe_microsurface s, const lobe_reflectance *f, int count,
                           lobe_vec3_f64 wi, uint64_t seed, uint64_t index, int most,
                           double *weights) {
    walker k;
    fill(weights, count, 0.0);
    if (!begin(&k, s, inward(wi), seed, index)) return cut;
    fill(weights, count, 1.0);
    while (fly(&k)) {
        if (k.bounces >= (uint64_t)most) {
            fill(weights, count, 0.0);
            return cut;
        }
        const facet_draw draw = meet(&k);
        for (int j = 0; j < count; ++j) weights[j] *= lobe_reflectance_at(f[j], draw.cos_im);
        go_on(&k, draw.wo);
    }
    return (lobe_walk){outward(k.w), (int)k.bounces};
}

/* What every law reflects to wo after one scattering: the density times 1/(1 + Lambda(i) + Lambda(o)) over
 * 1/(1 + Lambda(i)). */
static void add_first(const walker *k, const lobe_reflectance *f, int count, v3 wo, double lambda,
                      double *values) {
    double cos_im;
    const walk_sight sight = walk_sight_of(k->s, v3_scale(k->w, -1.0));
    const double density = walk_sight_toward(&sight, wo, &cos_im);
    const double seen = sight.area / (sight.area - k->w.z * lambda);
    for (int j = 0; j < count; ++j) values[j] += density * seen * lobe_reflectance_at(f[j], cos_im);
}

/* What a facet that was met reflects to wo, and how likely that leaves from there. */
static void add_next(const walker *k, const lobe_reflectance *f, int count, v3 wo, double lambda,
                     const double *weights, double *values) {
    double cos_im;
    const double density =
        walk_sight_toward(&k->sight, wo, &cos_im) * k_exp(-k_min(k->depth * lambda, 700.0));
    if (!(density > 0.0)) return;
    for (int j = 0; j < count; ++j)
        values[j] += weights[j] * density * lobe_reflectance_at(f[j], cos_im);
}

int lobe_walk_eval(lobe_microsurface s, const lobe_reflectance *f, int count, lobe_vec3_f64 wi,
                   lobe_vec3_f64 wo, uint64_t seed, uint64_t index, int most, double *values) {
    enum { LAWS_AT_ONCE = 64 };
    double weights[LAWS_AT_ONCE];
    walker k;
    fill(values, count, 0.0);
    const v3 o = inward(wo);
    const bool usable = facet_inputs_usable(o, 1.0, 1.0, v3_of(0.0, 0.0, 1.0)) && o.z > 0.0;
    if (count > LAWS_AT_ONCE || !usable || !begin(&k, s, inward(wi), seed, index)) return 0;
    const double lambda = walk_lambda(s, o);
    add_first(&k, f, count, o, lambda, values);
    fill(weights, count, 1.0);
    while (k.bounces < (uint64_t)most && fly(&k)) {
        if (k.bounces > 0) add_next(&k, f, count, o, lambda, weights, values);
        const facet_draw draw = meet(&k);
        for (int j = 0; j < count; ++j) weights[j] *= lobe_reflectance_at(f[j], draw.cos_im);
        go_on(&k, draw.wo);
    }
    return 1;
}

/* l below the surface of l above it: -ln(1 - exp(-l)), by its series where the difference cancels. */
static double depth_below(double depth) {
    const double l = k_max(depth, K_TINY);
    const double share =
        l < 1e-3 ? l * (1.0 - l * (0.5 - l * (1.0 / 6.0 - l / 24.0))) : 1.0 - k_exp(-l);
    return -k_log(share);
}

/* A direction as it is seen from a side of the surface. */
static v3 from_side(v3 w, bool inside) {
    return v3_scale(w, inside ? -1.0 : 1.0);
}

static bool begin_dielectric(walker *k, lobe_microsurface s, double ior, lobe_vec3_f64 wi,
                             uint64_t seed, uint64_t index) {
    const bool known = ior >= 1e-3 && ior <= 1e3;
    return begin(k, s, from_side(inward(wi), wi.z < 0.0), seed, index) && known;
}

/* Reflects or refracts; whether the ray is inside then. */
static bool scatter(walker *k, double ior, bool inside) {
    const facet_draw draw = meet(k);
    const refract_index n = refract_index_of(ior, inside);
    const refract_light light = refract_at(n, draw.cos_im);
    if (unit(k->random.word[3]) < light.reflectance) {
        go_on(k, draw.wo);
        return inside;
    }
    const v3 through = refract_out(n, light, v3_scale(k->w, -1.0), draw.m);
    go_on(k, v3_scale(through, -1.0));
    k->depth = depth_below(k->depth);
    return !inside;
}

lobe_walk lobe_walk_dielectric_sample(lobe_microsurface s, double ior, lobe_vec3_f64 wi,
                                      uint64_t seed, uint64_t index, int most) {
    walker k;
    bool inside = wi.z < 0.0;
    if (!begin_dielectric(&k, s, ior, wi, seed, index)) return cut;
    while (fly(&k)) {
        if (k.bounces >= (uint64_t)most) return cut;
        inside = scatter(&k, ior, inside);
    }
    return (lobe_walk){outward(from_side(k.w, inside)), (int)k.bounces};
}

/* What the facets that a ray sees scatter to o, on either side of the surface, shadowing left out. */
static double scattered(const walk_sight *sight, double ior, bool inside, v3 i, v3 o) {
    const refract_index n = refract_index_of(ior, inside);
    double cos_im;
    if (o.z > 0.0) {
        const double density = walk_sight_toward(sight, o, &cos_im);
        return density * refract_at(n, cos_im).reflectance;
    }
    /* equal indices: a point mass */
    if (k_abs(n.excess) <= DIELECTRIC_MATCHED) return 0.0;
    const v3 m = v3_normalize(refract_half_vector(n, i, o));
    const double density = walk_sight_density(sight, m, &cos_im), cos_om = v3_dot(o, m);
    if (!(density > 0.0 && cos_om < 0.0)) return 0.0;
    const refract_light light = refract_toward(n, cos_im, cos_om);
    return k_usable(density * refract_jacobian(n, light) * light.transmittance);
}

/* The first scattering exactly: reflected 1/(1 + Lambda(i) + Lambda(o)), through the surface
 * B(1 + Lambda(i), 1 + Lambda(o)), both over 1/(1 + Lambda(i)). */
static double first_value(const walker *k, double ior, bool inside, v3 o, double lambda) {
    const v3 i = v3_scale(k->w, -1.0);
    const walk_sight sight = walk_sight_of(k->s, i);
    const double once = 1.0 + walk_lambda(k->s, i);
    const double seen =
        o.z > 0.0 ? once / (once + lambda) : once * dielectric_beta(once - 1.0, lambda);
    return seen * scattered(&sight, ior, inside, i, o);
}

/* From the facet that was met. */
static double next_value(const walker *k, double ior, bool inside, v3 o, double lambda) {
    const double depth = o.z > 0.0 ? k->depth : depth_below(k->depth);
    return k_exp(-k_min(depth * lambda, 700.0)) *
           scattered(&k->sight, ior, inside, v3_scale(k->w, -1.0), o);
}

int lobe_walk_dielectric_eval(lobe_microsurface s, double ior, lobe_vec3_f64 wi, lobe_vec3_f64 wo,
                              uint64_t seed, uint64_t index, int most, double *value) {
    walker k;
    bool inside = wi.z < 0.0;
    const v3 o = inward(wo);
    *value = 0.0;
    const bool usable = facet_inputs_usable(o, 1.0, 1.0, v3_of(0.0, 0.0, 1.0)) && o.z != 0.0;
    if (!usable || !begin_dielectric(&k, s, ior, wi, seed, index)) return 0;
    const double lambda = walk_lambda(s, from_side(o, o.z < 0.0));
    double sum = first_value(&k, ior, inside, from_side(o, inside), lambda);
    while (k.bounces < (uint64_t)most && fly(&k)) {
        if (k.bounces > 0) sum += next_value(&k, ior, inside, from_side(o, inside), lambda);
        inside = scatter(&k, ior, inside);
    }
    *value = sum;
    return 1;
}
