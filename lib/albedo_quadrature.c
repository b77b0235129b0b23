/* lib/albedo_quadrature.c: the albedo of a microsurface by quadrature.
 *
 * Over the slopes s = rho (ax cos psi, ay sin psi) of the normals m along (s, 1). Those that reflect i
 * above the surface fill, for i_z > 0, the disk |s - i_xy/i_z| < 1/i_z (docs/optimal-caps.md has the
 * sign of the slope turned), for i_z <= 0 the half plane s.i_xy > |i_z|: on every ray from the origin
 * an interval of rho. D cos dm = du dpsi/2 pi with u the cumulative distribution along the ray, and
 *   E = integral of F 4 (i.m) f cos/(D m_z) du dpsi/2 pi,
 * smooth inside, with steep turns toward the ends at grazing angles: the double exponential rule; for V-cavities
 * on the pieces between the creases of G2.
 *
 * Above a geometric plane too, o.g > 0 cuts another convex piece out, on a ray another interval. */
#include "../kernel/bind/c_f64.h"

#include "lobe/albedo.h"

#include "../kernel/beckmann_vcavity_family.h"
#include "../kernel/fresnel.h"
#include "../kernel/ggx_vcavity_family.h"
#include "../kernel/log.h"

#include <stddef.h>

typedef struct node {
    double x, rest, weight;
} node;

static const node nodes[] = {
#include "albedo_nodes.inc"
};
enum { NODE_COUNT = sizeof nodes / sizeof nodes[0] };

typedef enum family { GGX_SMITH, BECKMANN_SMITH, GGX_VCAVITY, BECKMANN_VCAVITY } family;

typedef struct integrand {
    family family;
    ggx_base base;          /* the variables, whatever the family */
    beckmann_base beckmann; /* these where the family has them */
    vcavity_base cavity;
    lobe_reflectance f;
    int first, stride; /* of the nodes in use; as many are left out at the other end */
    bool has_plane;
    v3 plane;     /* geometric normal g, */
    double cos_g; /* and i.g */
} integrand;

/* A ray s = rho c from the origin: `a` |c|^2, `b` c.i_xy. */
typedef struct ray {
    double x, y, a, b;
} ray;

/* A stretch of a ray, in rho^2. */
typedef struct stretch {
    double first2, last2;
} stretch;

static const double FAR2 = 1e200;

/* What of the ray reflects i above the surface. */
static stretch stretch_of(ray c, double i_z) {
    stretch r = {0.0, 0.0};
    if (i_z > 0.0) {
        const double slope = c.b / i_z, root = k_sqrt(slope * slope + c.a);
        const double last = slope < 0.0 ? 1.0 / (root - slope) : (root + slope) / c.a;
        r.last2 = k_min(last * last, FAR2);
    } else if (c.b > 0.0) {
        const double first = -i_z / c.b;
        r.first2 = k_min(first * first, FAR2);
        r.last2 = FAR2;
    }
    return r;
}

/* o.g/m_z^2 = constant + 2 half rho + square rho^2 of the normal along (rho c, 1) */
typedef struct plane_terms {
    double constant, half, square;
} plane_terms;

static double height_above(plane_terms t, double rho) {
    return t.constant + rho * (2.0 * t.half + rho * t.square);
}

static plane_terms plane_terms_of(const integrand *q, ray c) {
    const v3 i = q->base.wi, g = q->plane;
    const double along_g = c.x * g.x + c.y * g.y;
    const plane_terms t = {2.0 * i.z * g.z - q->cos_g, c.b * g.z + along_g * i.z,
                           2.0 * c.b * along_g - c.a * q->cos_g};
    return t;
}

/* What of a stretch reflects i above the plane: convex, so one of the pieces between its roots. */
static stretch above_plane(const integrand *q, ray c, stretch r) {
    const plane_terms t = plane_terms_of(q, c);
    const double square = t.half * t.half - t.constant * t.square;
    double end[4] = {k_sqrt(r.first2)};
    int count = 1;
    if (square > 0.0) {
        const double sum = -(t.half + (t.half < 0.0 ? -k_sqrt(square) : k_sqrt(square)));
        const double root[2] = {t.constant / sum, sum / t.square};
        const bool swaps = !(root[0] <= root[1]);
        for (int k = 0; k < 2; ++k) {
            const double rho = root[swaps ? 1 - k : k];
            if (rho > end[count - 1] && rho * rho < r.last2) end[count++] = rho;
        }
    }
    end[count] = k_sqrt(r.last2);
    for (int k = 0; k < count; ++k) {
        const double middle =
            end[k + 1] * end[k + 1] < FAR2 ? 0.5 * (end[k] + end[k + 1]) : 2.0 * end[k] + 1.0;
        if (height_above(t, middle) > 0.0) {
            const stretch piece = {end[k] * end[k], k_min(end[k + 1] * end[k + 1], FAR2)};
            return piece;
        }
    }
    const stretch nothing = {0.0, 0.0};
    return nothing;
}

/* The variable of a stretch, from 0 to 1: u less u of its start over `length`. GGX: u = rho^2/(1 + rho^2).
 * Beckmann: u = 1 - exp(first^2 - rho^2), D without its value at the start, which `scale` gives back. */
typedef struct variable {
    bool is_ggx;
    double first2, start, rest, length, scale; /* u at the start, 1 - u at the end */
} variable;

static variable variable_of(const integrand *q, stretch r) {
    variable v = {q->family == GGX_SMITH || q->family == GGX_VCAVITY, r.first2, 0.0, 0.0, 0.0, 1.0};
    if (v.is_ggx) {
        const double before = 1.0 / (1.0 + r.first2);
        v.start = r.first2 * before;
        v.rest = 1.0 / (1.0 + r.last2);
        v.length = r.last2 < FAR2 ? (r.last2 - r.first2) * before * v.rest : before;
    } else {
        v.rest = k_exp(-k_min(r.last2 - r.first2, 700.0));
        v.length = 1.0 - v.rest;
        v.scale = k_exp(-k_min(r.first2 - q->beckmann.shift, 700.0));
    }
    return v;
}

/* rho^2 at a place of the variable, `rest` the place from its end. */
static double rho2_at(variable v, double place, double rest) {
    const double left = v.rest + v.length * rest;
    return v.is_ggx ? (v.start + v.length * place) / left
                    : v.first2 + k_max(-k_log(k_max(left, K_TINY)), 0.0);
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

/* f cos/D of a pair that leaves: f cos is in proportion to D, which the variables carry. */
static double value_of(const integrand *q, facet_pair pair) {
    switch (q->family) {
    case GGX_SMITH:
        return ggx_f_cos(q->base, pair);
    case BECKMANN_SMITH:
        return beckmann_f_cos(q->beckmann, pair);
    default:
        return vcavity_f_cos(q->cavity, pair);
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
    pair.d = 1.0;
    pair.leaves = pair.wo.z > 0.0 && along > 0.0;
    return pair.leaves ? 4.0 * along * value_of(q, pair) * reflectance(&q->f, pair.cos_im) : 0.0;
}

static double along_stretch(const integrand *q, ray c, stretch r) {
    const variable v = variable_of(q, r);
    double sum = 0.0;
    for (int k = q->first; k < NODE_COUNT - q->first; k += q->stride) {
        const double rho = k_sqrt(rho2_at(v, nodes[k].x, nodes[k].rest));
        sum += nodes[k].weight * value_at(q, rho * c.x, rho * c.y);
    }
    return sum * v.length * v.scale;
}

/* (4 m_z^2 - 1) i.m - 2 m_z i_z of the normal at rho, over m_z^3: 0 where 2 m_z o_z = i.m. */
static double crease_at(ray c, double i_z, double rho) {
    const double along = i_z + c.b * rho, inv_mz2 = 1.0 + c.a * rho * rho;
    return (4.0 - inv_mz2) * along - 2.0 * i_z * inv_mz2;
}

/* It has one root, along any ray, where i is reflected above the surface: with h = atan(c.i/(|c| i_z)) at
 * tan(theta) = |c| rho, theta = (pi/2 + h)/3, for i_z < 0 pi/2 - |h|/3. Found by halving `place`,
 * |c| rho = place/(1 - place); the end of the stretch where that does not have it. */
static double crease_in(ray c, double i_z, stretch r) {
    enum { HALVINGS = 52 };
    const double unit = k_sqrt(c.a), first = unit * k_sqrt(r.first2), last = unit * k_sqrt(r.last2);
    double low = first / (1.0 + first), high = last / (1.0 + last);
    for (int k = 0; k < HALVINGS; ++k) {
        const double middle = 0.5 * (low + high);
        if (crease_at(c, i_z, middle / ((1.0 - middle) * unit)) > 0.0)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high) / (k_max(1.0 - high, K_EPS) * unit);
}

enum { CREASES = 3 };

/* Where G2 of a V-cavity turns, and with it the pieces of a stretch:
 *   2 m_z |i_z| = i.m    2 m_z o_z = i.m    |i_z| = o_z */
static int find_creases(const integrand *q, ray c, stretch r, stretch pieces[CREASES + 1]) {
    const double i_z = q->base.wi.z, masked = 2.0 * k_abs(i_z) - i_z;
    double found[CREASES], rho[CREASES];
    int count = 0;
    found[0] = crease_in(c, i_z, r);
    found[1] = c.b > 0.0 ? masked / c.b : 0.0;
    found[2] = c.b > 0.0 && i_z > 0.0 ? c.b / (c.a * i_z) : 0.0;
    for (int k = 0; k < CREASES; ++k) {
        if (!(found[k] * found[k] > r.first2 && found[k] * found[k] < r.last2)) continue;
        int place = count++;
        for (; place > 0 && rho[place - 1] > found[k]; --place) rho[place] = rho[place - 1];
        rho[place] = found[k];
    }
    double first2 = r.first2;
    for (int k = 0; k < count; ++k) {
        const double next2 = rho[k] * rho[k];
        pieces[k] = (stretch){first2, next2};
        first2 = next2;
    }
    pieces[count] = (stretch){first2, r.last2};
    return count + 1;
}

/* Along the ray of direction (cosine, sine) in the plane where D is round. */
static double along_ray(const integrand *q, double cosine, double sine) {
    ray c = {q->base.ax * cosine, q->base.ay * sine, 0.0, 0.0};
    c.a = c.x * c.x + c.y * c.y;
    c.b = c.x * q->base.wi.x + c.y * q->base.wi.y;
    stretch r = stretch_of(c, q->base.wi.z);
    if (!(r.last2 > r.first2)) return 0.0;
    if (q->has_plane) r = above_plane(q, c, r);
    if (!(r.last2 > r.first2)) return 0.0;
    if (q->family == GGX_SMITH || q->family == BECKMANN_SMITH) return along_stretch(q, c, r);
    stretch pieces[CREASES + 1];
    const int count = find_creases(q, c, r, pieces);
    double sum = 0.0;
    for (int k = 0; k < count; ++k)
        if (pieces[k].last2 > pieces[k].first2) sum += along_stretch(q, c, pieces[k]);
    return sum;
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

static bool is_symmetric(const integrand *q) {
    return q->base.ax == q->base.ay || q->base.wi.y == 0.0;
}

static facet_azimuth azimuth_of(const integrand *q) {
    return facet_azimuth_of(v3_of(q->base.ax * q->base.wi.x, q->base.ay * q->base.wi.y, 0.0));
}

/* Beckmann from deep below: exp(-c^2 tan^2) of the angle from i leaves only rays within 6/c of it. Over the
 * tangent t of half the angle. */
static double around_deep(const integrand *q) {
    const facet_azimuth p = azimuth_of(q);
    const double last = k_min(3.0 / k_sqrt(q->beckmann.shift), 1.0);
    const int sides = is_symmetric(q) ? 1 : 2;
    double sum = 0.0;
    for (int k = 0; k < NODE_COUNT; k += q->stride) {
        const double t = last * nodes[k].x, inverse = 1.0 / (1.0 + t * t);
        const double c = (1.0 - t * t) * inverse, s = 2.0 * t * inverse;
        const double step = nodes[k].weight * last * 2.0 * inverse;
        for (int side = 0; side < sides; ++side) {
            const double turn = side == 0 ? s : -s;
            sum += step * along_ray(q, c * p.x - turn * p.y, c * p.y + turn * p.x);
        }
    }
    return sum * q->stride * q->stride * K_INV_PI / sides;
}

/* All around. The rays turn steeply where they are across from i in the plane where D is round, and
 * toward the axes of the roughness: no piece has either inside, but for a coarse sum. A surface that is symmetric about the
 * plane of incidence needs one half. */
static double around(const integrand *q) {
    const bool is_round = q->base.ax == q->base.ay || q->stride == 4;
    const bool symmetric = is_symmetric(q);
    facet_azimuth to_i = azimuth_of(q);
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

/* ---- Above a geometric plane, and V-cavities ------------------------------------------------- */

/* Unit vectors in the plane where D is round, by angle; between two the integral along a ray is smooth. */
enum { TURNS_MAX = 20 };

typedef struct turns {
    facet_azimuth at[TURNS_MAX];
    double order[TURNS_MAX]; /* grows with the angle, from -2 to 2 */
    int count;
} turns;

static void add_turn(turns *t, double x, double y) {
    const facet_azimuth p = facet_azimuth_of(v3_of(x, y, 0.0));
    const double share = p.x / (k_abs(p.x) + k_abs(p.y)),
                 order = p.y < 0.0 ? share - 1.0 : 1.0 - share;
    int place = t->count++;
    for (; place > 0 && t->order[place - 1] > order; --place) {
        t->at[place] = t->at[place - 1];
        t->order[place] = t->order[place - 1];
    }
    t->at[place] = p;
    t->order[place] = order;
}

/* The ray through the slopes (x, y) */
static void add_ray(turns *t, const integrand *q, double x, double y) {
    add_turn(t, x * q->base.ay, y * q->base.ax);
}

/* Toward i, the axes of the roughness, and across. */
static void add_quarters(turns *t, const integrand *q) {
    facet_azimuth to_i = azimuth_of(q), axis = {1.0, 0.0, 1.0};
    for (int quarter = 0; quarter < 4; ++quarter) {
        add_turn(t, axis.x, axis.y);
        add_turn(t, to_i.x, to_i.y);
        axis = turned(axis);
        to_i = turned(to_i);
    }
}

/* The rays through the normals that reflect i along the line where both planes meet. */
static void add_corners(turns *t, const integrand *q) {
    const v3 i = q->base.wi, g = q->plane;
    const double length = k_sqrt(g.x * g.x + g.y * g.y);
    if (!(length > 0.0)) return;
    const double sign = i.z < 0.0 ? -1.0 : 1.0; /* slopes are m_xy/m_z */
    const double x = g.y / length, y = g.x / length;
    add_ray(t, q, sign * (i.x - x), sign * (i.y + y));
    add_ray(t, q, sign * (i.x + x), sign * (i.y - y));
}

/* The rays that touch the normals that reflect i into the geometric plane: where half^2 - constant square of
 * plane_terms, a quadratic form of the ray's x and y, is zero. */
static void add_tangents(turns *t, const integrand *q) {
    const v3 i = q->base.wi, g = q->plane;
    const double constant = 2.0 * i.z * g.z - q->cos_g;
    const double hx = i.x * g.z + g.x * i.z, hy = i.y * g.z + g.y * i.z;
    const double xx = hx * hx - constant * (2.0 * i.x * g.x - q->cos_g);
    const double xy = hx * hy - constant * (i.x * g.y + i.y * g.x);
    const double yy = hy * hy - constant * (2.0 * i.y * g.y - q->cos_g);
    const double square = xy * xy - xx * yy;
    if (!(square > 0.0)) return;
    const double sum = -(xy + (xy < 0.0 ? -k_sqrt(square) : k_sqrt(square)));
    add_ray(t, q, sum, xx); /* x/y = sum/xx, and yy/sum */
    add_ray(t, q, -sum, -xx);
    add_ray(t, q, yy, sum);
    add_ray(t, q, -yy, -sum);
}

/* Beckmann from deep below: the ends of around_deep. */
static void add_deep(turns *t, const integrand *q) {
    const bool is_beckmann = q->family == BECKMANN_SMITH || q->family == BECKMANN_VCAVITY;
    if (!is_beckmann || !(q->beckmann.shift > 1.0)) return;
    const facet_azimuth p = azimuth_of(q);
    const double half = k_min(3.0 / k_sqrt(q->beckmann.shift), 1.0),
                 inverse = 1.0 / (1.0 + half * half);
    const double c = (1.0 - half * half) * inverse, s = 2.0 * half * inverse;
    add_turn(t, c * p.x - s * p.y, c * p.y + s * p.x);
    add_turn(t, c * p.x + s * p.y, c * p.y - s * p.x);
}

/* The two rays, if any, on which c.i/(|c| i_z) is `tangent`: a quadratic form is zero there too. */
static void add_order(turns *t, const integrand *q, double tangent) {
    const double ax = q->base.ax, ay = q->base.ay, level = tangent * q->base.wi.z;
    const double x = ax * q->base.wi.x, y = ay * q->base.wi.y, xy = x * y;
    const double xx = x * x - level * level * ax * ax, yy = y * y - level * level * ay * ay;
    const double square = xy * xy - xx * yy;
    if (!(square > 0.0)) return;
    const double sum = -(xy + (xy < 0.0 ? -k_sqrt(square) : k_sqrt(square)));
    const double first = sum * x + xx * y < 0.0 ? -1.0 : 1.0;
    const double second = yy * x + sum * y < 0.0 ? -1.0 : 1.0;
    add_turn(t, first * sum, first * xx);
    add_turn(t, second * yy, second * sum);
}

/* Above, the creases of V-cavities change their order where c.i = |c| i_z, and the first one leaves what reflects i
 * above the surface at 1/sqrt(3) of that. */
static void add_orders(turns *t, const integrand *q) {
    const bool is_vcavity = q->family == GGX_VCAVITY || q->family == BECKMANN_VCAVITY;
    if (!is_vcavity || !(q->base.wi.z > 0.0)) return;
    add_order(t, q, 1.0);
    add_order(t, q, 0.57735026918962576451);
}

static double around_above(const integrand *q) {
    turns t;
    t.count = 0;
    add_quarters(&t, q);
    add_deep(&t, q);
    add_corners(&t, q);
    add_tangents(&t, q);
    add_orders(&t, q);
    double sum = 0.0;
    for (int k = 0; k < t.count; ++k) sum += between(q, t.at[k], t.at[(k + 1) % t.count]);
    return sum * q->stride * q->stride * 0.5 * K_INV_PI;
}

/* The same without a plane. */
static double around_vcavity(const integrand *q) {
    turns t;
    t.count = 0;
    add_quarters(&t, q);
    add_orders(&t, q);
    const bool symmetric = is_symmetric(q);
    const facet_azimuth to_i = azimuth_of(q);
    double sum = 0.0;
    for (int k = 0; k < t.count; ++k) {
        const facet_azimuth p = t.at[k], r = t.at[(k + 1) % t.count];
        const double side = to_i.x * (p.y + r.y) - to_i.y * (p.x + r.x);
        if (!symmetric || side > 0.0) sum += between(q, p, r);
    }
    return sum * q->stride * q->stride * (symmetric ? K_INV_PI : 0.5 * K_INV_PI);
}

/* ---- Entrances ------------------------------------------------------------------------------- */

static double not_a_number(void) {
    return __builtin_nan("");
}

/* The family's part, and whether it can see anything from wi. */
static bool add_family(integrand *q, lobe_microsurface s, v3 wi, facet_options options) {
    const bool is_beckmann = s.ndf == LOBE_NDF_BECKMANN,
               is_vcavity = s.masking == LOBE_MASKING_VCAVITY;
    q->family = is_vcavity    ? is_beckmann ? BECKMANN_VCAVITY : GGX_VCAVITY
                : is_beckmann ? BECKMANN_SMITH
                              : GGX_SMITH;
    switch (q->family) {
    case GGX_SMITH:
        return k_is(q->base.valid);
    case BECKMANN_SMITH:
        q->beckmann = beckmann_base_of(wi, s.alpha_x, s.alpha_y, options);
        return k_is(q->beckmann.valid);
    case GGX_VCAVITY: {
        const ggx_vcavity_base g = ggx_vcavity_base_of(wi, s.alpha_x, s.alpha_y, options);
        q->cavity = g.cavity;
        return k_is(g.valid);
    }
    case BECKMANN_VCAVITY: {
        const beckmann_vcavity_base g = beckmann_vcavity_base_of(wi, s.alpha_x, s.alpha_y, options);
        q->beckmann = g.beckmann;
        q->cavity = g.cavity;
        return k_is(g.valid);
    }
    }
    return false;
}

static integrand integrand_of(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 w,
                              lobe_effort effort) {
    const v3 wi = v3_of(w.x, w.y, w.z);
    const facet_options options = facet_options_of(s.g2 == LOBE_G2_SEPARABLE, false);
    const bool known = (unsigned)s.ndf < LOBE_NDF_COUNT && (unsigned)s.masking < LOBE_MASKING_COUNT;
    integrand q;
    q.base = ggx_base_of(wi, s.alpha_x, s.alpha_y, options);
    q.f = f;
    q.has_plane = false;
    q.stride = effort == LOBE_EFFORT_COARSE ? 4 : effort == LOBE_EFFORT_MEDIUM ? 2 : 1;
    q.first = effort == LOBE_EFFORT_COARSE ? 12 : 0; /* the outer ones weigh 1e-5 */
    q.base.valid = k_flag(known && add_family(&q, s, wi, options) && k_is(q.base.valid));
    return q;
}

double lobe_albedo(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 wi, lobe_effort effort) {
    const integrand q = integrand_of(s, f, wi, effort);
    if (!q.base.valid) return not_a_number();
    if (q.base.mirror) return wi.z > 0.0 ? lobe_reflectance_at(f, wi.z) : 0.0;
    const bool is_beckmann = s.ndf == LOBE_NDF_BECKMANN;
    if (is_beckmann && q.beckmann.shift > 1.0) return around_deep(&q);
    return s.masking == LOBE_MASKING_VCAVITY && wi.z > 0.0 && effort != LOBE_EFFORT_COARSE
               ? around_vcavity(&q)
               : around(&q);
}

double lobe_albedo_above(lobe_microsurface s, lobe_reflectance f, lobe_vec3_f64 wi,
                         lobe_vec3_f64 geometric_normal, lobe_effort effort) {
    const v3 g = v3_of(geometric_normal.x, geometric_normal.y, geometric_normal.z);
    integrand q = integrand_of(s, f, wi, effort);
    q.has_plane = true;
    q.plane = g;
    q.cos_g = v3_dot(q.base.wi, g);
    if (!q.base.valid || !(q.cos_g > 0.0 && q.cos_g < 2.0)) return not_a_number();
    if (q.base.mirror) {
        const double height = 2.0 * wi.z * g.z - q.cos_g;
        return wi.z > 0.0 && height > 0.0 ? lobe_reflectance_at(f, wi.z) : 0.0;
    }
    return around_above(&q);
}

static double sinh_of(double x) {
    const double e = k_exp(x);
    return 0.5 * (e - 1.0 / e);
}

/* 2 * integral of E mu dmu along one azimuth. E turns where mu is about the roughness a toward it, however
 * small: over x, mu = a sinh(L x), 1 - mu = 2 a cosh(L - L (1 - x)/2) sinh(L (1 - x)/2). */
static double average_along(lobe_microsurface s, lobe_reflectance f, double x, double y,
                            lobe_effort effort) {
    const int stride = effort == LOBE_EFFORT_COARSE ? 4 : effort == LOBE_EFFORT_MEDIUM ? 2 : 1;
    const double ax = s.alpha_x * x, ay = s.alpha_y * y;
    const double a = k_min(k_max(k_sqrt(ax * ax + ay * ay), LOBE_ALPHA_MIN), 1.0);
    const double length = k_log((1.0 + k_sqrt(1.0 + a * a)) / a);
    double sum = 0.0;
    for (int k = 0; k < NODE_COUNT; k += stride) {
        const double half = 0.5 * length * nodes[k].rest, e = k_exp(length - half);
        const double rest = a * (e + 1.0 / e) * sinh_of(half);
        const double mu = a * sinh_of(length * nodes[k].x), plane = k_sqrt(rest * (1.0 + mu));
        const lobe_vec3_f64 wi = {plane * x, plane * y, mu};
        const double step = nodes[k].weight * length * k_sqrt(a * a + mu * mu);
        sum += step * 2.0 * mu * lobe_albedo(s, f, wi, effort);
    }
    return sum * stride;
}

/* Over a quarter of the azimuths where they differ, by the tangent of half the angle. */
double lobe_albedo_average(lobe_microsurface s, lobe_reflectance f, lobe_effort effort) {
    if (!(s.alpha_x >= 0.0 && s.alpha_y >= 0.0)) return not_a_number();
    if (s.alpha_x < LOBE_ALPHA_MIN && s.alpha_y < LOBE_ALPHA_MIN)
        return lobe_reflectance_average(f);
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
