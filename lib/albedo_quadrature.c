/* lib/albedo_quadrature.c: the albedo of a microsurface by quadrature.
 *
 * Over the slopes s = rho (ax cos psi, ay sin psi) of the normals m along (s, 1). Those that reflect i
 * above the surface fill, for i_z > 0, the disk |s - i_xy/i_z| < 1/i_z (docs/optimal-caps.md has the
 * sign of the slope turned), for i_z <= 0 the half plane s.i_xy > |i_z|: on every ray from the origin
 * an interval of rho. D cos dm = du dpsi/2 pi with u the cumulative distribution along the ray, and
 *   E = integral of F 4 (i.m) f cos/(D m_z) du dpsi/2 pi,
 * smooth inside, with steep turns toward the ends at grazing angles: the double exponential rule. D is
 * that of GGX also for another distribution, whose f cos then brings its own. */
#include "../kernel/bind/c_f64.h"

#include "lobe/albedo.h"

#include "../kernel/fresnel.h"
#include "../kernel/ggx.h"

#include <stddef.h>

typedef struct node {
    double x, rest, weight;
} node;

static const node nodes[] = {
#include "albedo_nodes.inc"
};
enum { NODE_COUNT = sizeof nodes / sizeof nodes[0] };

typedef struct integrand {
    ggx_base base;
    bool is_ggx;               /* Smith-GGX; else the value is that of `model`, */
    lobe_reflection_f64 model; /* over the same variables */
    lobe_reflectance f;
    int first, stride; /* of the nodes in use; as many are left out at the other end */
} integrand;

/* A stretch of the cumulative distribution u: from its lower end, and 1 - u at its upper end. */
typedef struct stretch {
    double start, rest, length;
} stretch;

/* GGX: u = rho^2/(1 + rho^2). `a`, `b`: |c|^2 and c.i_xy of the ray s = rho c. */
static stretch stretch_of(double a, double b, double i_z) {
    stretch r = {0.0, 0.0, 0.0};
    if (i_z > 0.0) {
        const double slope = b / i_z, root = k_sqrt(slope * slope + a);
        const double last = slope < 0.0 ? 1.0 / (root - slope) : (root + slope) / a;
        r.rest = 1.0 / (1.0 + last * last);
        r.length = last < 1e100 ? last * last * r.rest : 1.0;
    } else if (b > 0.0) {
        const double first = -i_z / b;
        r.length = 1.0 / (1.0 + first * first);
        r.start = 1.0 - r.length;
    }
    return r;
}

/* lobe_reflectance_at, inlined: it is half of the work. */
static double reflectance(const lobe_reflectance *f, double cos_im) {
    switch (f->law) {
    case LOBE_REFLECTANCE_ONE:
        return 1.0;
    case LOBE_REFLECTANCE_DIELECTRIC:
        return fresnel_dielectric(f->a, cos_im);
    default:
        return lobe_reflectance_at(*f, cos_im);
    }
}

/* F 4 (i.m) f cos/(D m_z) of the normal along (x, y, 1) */
static double value_at(const integrand *q, double x, double y) {
    const v3 i = q->base.wi;
    const double along = i.z + i.x * x + i.y * y; /* i.m/m_z */
    const double mz2 = 1.0 / (1.0 + x * x + y * y), mz = k_sqrt(mz2), twice = 2.0 * along * mz2;
    facet_pair pair;
    pair.m = v3_of(x * mz, y * mz, mz);
    pair.wo = v3_of(twice * x - i.x, twice * y - i.y, twice - i.z);
    pair.cos_im = along * mz;
    pair.d = 1.0; /* f cos is in proportion to D, which the variables carry */
    pair.leaves = pair.wo.z > 0.0 && along > 0.0;
    if (!q->is_ggx && pair.leaves) {
        const lobe_vec3_f64 m = {pair.m.x, pair.m.y, pair.m.z};
        return 4.0 * along * reflectance(&q->f, pair.cos_im) *
               lobe_reflection_eval_m_f64(&q->model, m).f_cos / ggx_d(q->base, pair.m);
    }
    return pair.leaves ? 4.0 * along * ggx_f_cos(q->base, pair) * reflectance(&q->f, pair.cos_im)
                       : 0.0;
}

/* Along the ray of direction (cosine, sine) in the plane where D is round. */
static double along_ray(const integrand *q, double cosine, double sine) {
    const double x = q->base.ax * cosine, y = q->base.ay * sine;
    const stretch r = stretch_of(x * x + y * y, x * q->base.wi.x + y * q->base.wi.y, q->base.wi.z);
    if (!(r.length > 0.0)) return 0.0;
    double sum = 0.0;
    for (int k = q->first; k < NODE_COUNT - q->first; k += q->stride) {
        const double u = r.start + r.length * nodes[k].x, rest = r.rest + r.length * nodes[k].rest;
        const double rho = k_sqrt(u / rest);
        sum += nodes[k].weight * value_at(q, rho * x, rho * y);
    }
    return sum * r.length;
}

/* Over the angle between two unit vectors less than half a turn apart, by the tangent of half of it. */
static double between(const integrand *q, facet_azimuth p, facet_azimuth r) {
    const double last = (p.x * r.y - p.y * r.x) / (1.0 + p.x * r.x + p.y * r.y);
    if (!(last > 1e-12)) return 0.0;
    double sum = 0.0;
    for (int k = q->first; k < NODE_COUNT - q->first; k += q->stride) {
        const double t = last * nodes[k].x, inverse = 1.0 / (1.0 + t * t);
        const double c = (1.0 - t * t) * inverse, s = 2.0 * t * inverse;
        sum += nodes[k].weight * inverse * along_ray(q, c * p.x - s * p.y, c * p.y + s * p.x);
    }
    return sum * 2.0 * last;
}

static facet_azimuth turned(facet_azimuth p) {
    const facet_azimuth r = {-p.y, p.x, p.rho};
    return r;
}

/* All around. The rays turn steeply where they are across from i in the plane where D is round, and
 * toward the axes of the roughness: no piece has either inside, but for a coarse sum. A surface that is symmetric about the
 * plane of incidence needs one half. */
static double around(const integrand *q) {
    const bool is_round = q->base.ax == q->base.ay || q->stride == 4;
    const bool symmetric = q->base.ax == q->base.ay || q->base.wi.y == 0.0;
    facet_azimuth to_i =
        facet_azimuth_of(v3_of(q->base.ax * q->base.wi.x, q->base.ay * q->base.wi.y, 0.0));
    facet_azimuth axis = {1.0, 0.0, 1.0};
    while (!is_round && !(to_i.x > 0.0 && to_i.y >= 0.0)) to_i = turned(to_i);
    double sum = 0.0;
    for (int quarter = 0; quarter < (symmetric ? 2 : 4); ++quarter) {
        const facet_azimuth next = turned(axis);
        sum += is_round ? between(q, to_i, turned(to_i))
                        : between(q, axis, to_i) + between(q, to_i, next);
        to_i = turned(to_i);
        axis = next;
    }
    return sum * q->stride * q->stride * (symmetric ? K_INV_PI : 0.5 * K_INV_PI);
}

static double not_a_number(void) {
    return __builtin_nan("");
}

static integrand integrand_of(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 wi,
                              lobe_effort effort) {
    integrand q;
    q.is_ggx = s.ndf == LOBE_NDF_GGX && s.masking == LOBE_MASKING_SMITH;
    q.base = ggx_base_of(v3_of(wi.x, wi.y, wi.z), s.alpha_x, s.alpha_y,
                         facet_options_of(s.g2 == LOBE_G2_SEPARABLE, false));
    q.f = f;
    q.stride = effort == LOBE_EFFORT_COARSE ? 4 : effort == LOBE_EFFORT_MEDIUM ? 2 : 1;
    q.first = effort == LOBE_EFFORT_COARSE ? 12 : 0; /* the outer ones weigh 1e-5 */
    if (q.is_ggx) return q;
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = (lobe_model){s.ndf, s.masking, lobe_best_method(s.ndf, s.masking)};
    options.g2 = s.g2;
    q.model = lobe_reflection_prepare_f64(options, wi, s.alpha_x, s.alpha_y);
    q.base.valid = q.base.valid && q.model.is_valid;
    return q;
}

double lobe_albedo(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 wi, lobe_effort effort) {
    const integrand q = integrand_of(s, f, wi, effort);
    if (!q.base.valid) return not_a_number();
    if (q.base.mirror) return wi.z > 0.0 ? lobe_reflectance_at(f, wi.z) : 0.0;
    return around(&q);
}

/* 2 * integral of E mu dmu along one azimuth */
static double average_along(lobe_microsurface s, lobe_reflectance f, double x, double y,
                            lobe_effort effort) {
    const int stride = effort == LOBE_EFFORT_COARSE ? 4 : 2;
    double sum = 0.0;
    for (int k = 0; k < NODE_COUNT; k += stride) {
        const double mu = nodes[k].x, plane = k_sqrt(nodes[k].rest * (1.0 + mu));
        const lobe_vec3_f64 wi = {plane * x, plane * y, mu};
        sum += nodes[k].weight * 2.0 * mu * lobe_albedo(s, f, wi, effort);
    }
    return sum * stride;
}

/* Over a quarter of the azimuths where they differ, by the tangent of half the angle. */
double lobe_albedo_average(lobe_microsurface s, lobe_reflectance f, lobe_effort effort) {
    if (s.alpha_x == s.alpha_y) return average_along(s, f, 1.0, 0.0, effort);
    const int stride = effort == LOBE_EFFORT_COARSE ? 4 : 2;
    double sum = 0.0;
    for (int k = 0; k < NODE_COUNT; k += stride) {
        const double t = nodes[k].x, inverse = 1.0 / (1.0 + t * t);
        const double x = (1.0 - t * t) * inverse, y = 2.0 * t * inverse;
        sum += nodes[k].weight * inverse * average_along(s, f, x, y, effort);
    }
    return sum * stride * 4.0 * K_INV_PI;
}
