/* lib/albedo_quadrature.c: the albedo of a microsurface by quadrature.
 *
 * Over the slopes s = rho (ax cos psi, ay sin psi) of the normals m along (s, 1). Those that reflect i
 * above the surface fill, for i_z > 0, the disk |s - i_xy/i_z| < 1/i_z (docs/optimal-caps.md has the
 * sign of the slope turned), for i_z <= 0 the half plane s.i_xy > |i_z|: on every ray from the origin
 * an interval of rho. D cos dm = du dpsi/2 pi with u the cumulative distribution along the ray, and
 *   E = integral of F 4 (i.m) f cos/(D m_z) du dpsi/2 pi,
 * smooth inside, with steep turns toward the ends at grazing angles: the double exponential rule. */
#include "../kernel/bind/c_f64.h"

#include "lobe/albedo.h"

#include "../kernel/fresnel.h"
#include "../kernel/ggx.h"

#include <stddef.h>

typedef struct node {
    double x, rest, weight, cosine, sine;
} node;

static const node nodes[] = {
#include "albedo_nodes.inc"
};
enum { NODE_COUNT = sizeof nodes / sizeof nodes[0] };

typedef struct integrand {
    ggx_base base;
    lobe_reflectance f;
    int stride; /* between the nodes in use */
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
    return pair.leaves ? 4.0 * along * ggx_f_cos(q->base, pair) * reflectance(&q->f, pair.cos_im)
                       : 0.0;
}

/* Along the ray of direction (cosine, sine) in the plane where D is round. */
static double along_ray(const integrand *q, double cosine, double sine) {
    const double x = q->base.ax * cosine, y = q->base.ay * sine;
    const stretch r = stretch_of(x * x + y * y, x * q->base.wi.x + y * q->base.wi.y, q->base.wi.z);
    if (!(r.length > 0.0)) return 0.0;
    double sum = 0.0;
    for (int k = 0; k < NODE_COUNT; k += q->stride) {
        const double u = r.start + r.length * nodes[k].x, rest = r.rest + r.length * nodes[k].rest;
        const double rho = k_sqrt(u / rest);
        sum += nodes[k].weight * value_at(q, rho * x, rho * y);
    }
    return sum * r.length;
}

/* Four quarter turns from the azimuth of i in the round plane; the mirrored two where the surface is
 * symmetric about the plane of incidence. */
static double around(const integrand *q) {
    const facet_azimuth to_i =
        facet_azimuth_of(v3_of(q->base.ax * q->base.wi.x, q->base.ay * q->base.wi.y, 0.0));
    const bool symmetric = q->base.ax == q->base.ay || q->base.wi.x == 0.0 || q->base.wi.y == 0.0;
    const int quarters = symmetric ? 2 : 4;
    double sum = 0.0, x = to_i.x, y = to_i.y;
    for (int turn = 0; turn < quarters; ++turn) {
        for (int k = 0; k < NODE_COUNT; k += q->stride) {
            const double c = nodes[k].cosine, s = nodes[k].sine;
            sum += nodes[k].weight * along_ray(q, x * c - y * s, x * s + y * c);
        }
        const double previous = x;
        x = -y;
        y = previous;
    }
    return sum * q->stride * q->stride / quarters;
}

static double not_a_number(void) {
    return __builtin_nan("");
}

static integrand integrand_of(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 wi,
                              lobe_effort effort) {
    integrand q;
    q.base = ggx_base_of(v3_of(wi.x, wi.y, wi.z), s.alpha_x, s.alpha_y,
                         facet_options_of(s.g2 == LOBE_G2_SEPARABLE, false));
    q.f = f;
    q.stride = effort == LOBE_EFFORT_COARSE ? 4 : effort == LOBE_EFFORT_MEDIUM ? 2 : 1;
    return q;
}

double lobe_albedo(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 wi, lobe_effort effort) {
    const integrand q = integrand_of(s, f, wi, effort);
    if (!q.base.valid) return not_a_number();
    if (q.base.mirror) return wi.z > 0.0 ? lobe_reflectance_at(f, wi.z) : 0.0;
    return around(&q);
}

/* 2 * integral of E mu dmu along one azimuth */
static double average_along(lobe_microsurface s, lobe_reflectance f, const node *azimuth,
                            lobe_effort effort) {
    const int stride = effort == LOBE_EFFORT_COARSE ? 4 : 2;
    double sum = 0.0;
    for (int k = 0; k < NODE_COUNT; k += stride) {
        const double mu = nodes[k].x, plane = k_sqrt(nodes[k].rest * (1.0 + mu));
        const lobe_vec3_f64 wi = {plane * azimuth->cosine, plane * azimuth->sine, mu};
        sum += nodes[k].weight * 2.0 * mu * lobe_albedo(s, f, wi, effort);
    }
    return sum * stride;
}

double lobe_albedo_average(lobe_microsurface s, lobe_reflectance f, lobe_effort effort) {
    if (s.alpha_x == s.alpha_y) return average_along(s, f, &nodes[0], effort);
    const int stride = effort == LOBE_EFFORT_COARSE ? 4 : 2;
    double sum = 0.0;
    for (int k = 0; k < NODE_COUNT; k += stride)
        sum += nodes[k].weight * average_along(s, f, &nodes[k], effort);
    return sum * stride;
}
