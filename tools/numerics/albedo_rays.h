/* tools/numerics/albedo_rays.h: 1 - E of a microsurface with F = 1, both forms of G2 in one pass, for the maker of
 * lib/albedo_table.inc. wi above the surface.
 *
 * The integral of lib/albedo_quadrature.c in its coordinates, slopes rho (ax cos psi, ay sin psi) in which D is
 * round: D cos dm = du dpsi/2 pi. By Gauss's rule between all creases:
 *   along a ray   GGX over asinh(rho), then asinh of a multiple of 1/rho; Beckmann over rho; V-cavities also
 *                 between the creases of G2
 *   around        between the axes of the roughness, the rays across from i and those where the creases change
 *                 their order; nodes drawn together toward an end in proportion to how steep it is there
 *
 * V-cavities: c = (ax cos psi, ay sin psi), h = atan(c.i/(|c| i_z)), tan(theta) = |c| rho. The last normal
 * that reflects i above the surface is at theta = pi/4 + h/2, G2 turns at
 *   pi/2 - h       where 2 m_z i_z = i.m   (if h > pi/6: before the last normal)
 *   (pi/2 + h)/3   where 2 m_z o_z = i.m
 *   h              where i_z = o_z         (if h > pi/4: else i and o see the whole facet)
 * which is the geometry of one groove; all three meet at h = pi/4.
 *
 * Nothing of the C library but the square root: the same numbers on every machine, if the compiler contracts no
 * product and sum. */
#ifndef TOOLS_ALBEDO_RAYS_H
#define TOOLS_ALBEDO_RAYS_H

#include "kernel/bind/c_f64.h"

#include "kernel/arc.h"
#include "kernel/beckmann.h"
#include "kernel/ggx.h"
#include "kernel/trig.h"

#include "gauss.h"

#include "lobe/reflection.h"

static const double RAYS_PI = 3.14159265358979323846;

/* For the two forms of G2, in the order of lobe_g2. */
typedef struct both {
    double of[2];
} both;

typedef struct rays {
    lobe_ndf ndf;
    lobe_masking masking;
    ggx_base ggx;
    beckmann_base beckmann;
    gauss along, piece, around,
        sector; /* a ray, a short piece of one, the turn, a short piece of it */
} rays;

/* What does not depend on the place; then rays_toward for each. */
static rays rays_of(lobe_ndf ndf, lobe_masking masking, int along, int piece, int around) {
    rays q;
    q.ndf = ndf;
    q.masking = masking;
    q.along = gauss_of(along);
    q.piece = gauss_of(piece);
    q.around = gauss_of(around);
    q.sector = gauss_of((2 * around + 2) / 3);
    return q;
}

static void rays_toward(rays *q, v3 wi, double alpha_x, double alpha_y) {
    const facet_options options = facet_options_of(false, false);
    q->ggx = ggx_base_of(wi, alpha_x, alpha_y, options);
    q->beckmann = beckmann_base_of(wi, alpha_x, alpha_y, options);
}

/* ---- Along a ray ----------------------------------------------------------------------------- */

/* Slopes rho (x, y): a = x^2 + y^2, b = (x, y).i; `last`: rho of the last normal that counts. */
typedef struct rays_line {
    double x, y, a, b, last;
} rays_line;

static rays_line rays_line_of(const rays *q, double cosine, double sine) {
    rays_line c;
    c.x = q->ggx.ax * cosine;
    c.y = q->ggx.ay * sine;
    c.a = c.x * c.x + c.y * c.y;
    c.b = c.x * q->ggx.wi.x + c.y * q->ggx.wi.y;
    const double slope = c.b / q->ggx.wi.z, root = k_sqrt(slope * slope + c.a);
    c.last = slope < 0 ? 1 / (root - slope) : (root + slope) / c.a;
    return c;
}

/* A normal and what it reflects i to. */
typedef struct rays_normal {
    double along; /* i.m/m_z */
    double x, y;  /* (ax ox, ay oy), */
    double z;     /* oz */
} rays_normal;

static rays_normal rays_normal_at(const rays *q, rays_line c, double rho) {
    const ggx_base *g = &q->ggx;
    rays_normal n;
    n.along = g->wi.z + c.b * rho;
    const double twice = 2 * n.along / (1 + c.a * rho * rho);
    n.x = g->ax * (twice * rho * c.x - g->wi.x);
    n.y = g->ay * (twice * rho * c.y - g->wi.y);
    n.z = k_max(twice - g->wi.z, 0);
    return n;
}

/* Each adds 4 (i.m) f cos/(D m_z) times the weight. */
static void rays_add_ggx(const rays *q, rays_normal n, double weight, both *sum) {
    const double i_z = q->ggx.wi.z, t_i = q->ggx.t_i,
                 t_o = k_sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    const double part = weight * 4 * n.along * q->ggx.value_scale * n.z;
    sum->of[LOBE_G2_CORRELATED] += part * (i_z + t_i) / (t_i * n.z + t_o * i_z);
    sum->of[LOBE_G2_SEPARABLE] += part * 2 / (n.z + t_o);
}

static void rays_add_beckmann(const rays *q, rays_normal n, double weight, both *sum) {
    const double visible = q->beckmann.visible, b2 = n.x * n.x + n.y * n.y;
    const double part = weight * 2 * n.along * n.z;
    double hidden = 0; /* z Lambda(o): below the last digit where o is steep */
    if (n.z * n.z < 36 * b2) {
        const double b = k_sqrt(b2), cot = n.z / b;
        hidden = 0.5 * K_INV_SQRT_PI * b * k_exp(-cot * cot) * k_erfcx_defect(cot);
    }
    sum->of[LOBE_G2_CORRELATED] += part / (visible * n.z + 2 * q->ggx.wi.z * hidden);
    sum->of[LOBE_G2_SEPARABLE] += part / (visible * (n.z + hidden));
}

static void rays_add_vcavity(const rays *q, rays_normal n, double weight, both *sum) {
    const double i_z = q->ggx.wi.z;
    const double seen_i = k_min(1 / i_z, 2 / n.along), seen_o = k_min(1, 2 * n.z / n.along);
    sum->of[LOBE_G2_CORRELATED] += weight * n.along * k_min(seen_i, seen_o / i_z);
    sum->of[LOBE_G2_SEPARABLE] += weight * n.along * seen_i * seen_o;
}

static void rays_add(const rays *q, rays_line c, double rho, double weight, both *sum) {
    const rays_normal n = rays_normal_at(q, c, rho);
    if (q->masking == LOBE_MASKING_VCAVITY)
        rays_add_vcavity(q, n, weight, sum);
    else if (q->ndf == LOBE_NDF_GGX)
        rays_add_ggx(q, n, weight, sum);
    else
        rays_add_beckmann(q, n, weight, sum);
}

/* By the length of a piece in its variable. */
static const gauss *rays_rule(const rays *q, double length) {
    return length > 1.5 ? &q->along : &q->piece;
}

/* GGX, u = rho^2/(1 + rho^2): over v, rho = sinh v. */
static void rays_add_near(const rays *q, rays_line c, double first, double last, both *sum) {
    const double low = k_asinh(first), length = k_asinh(last) - low;
    const gauss *rule = rays_rule(q, length);
    for (int k = 0; k < rule->count; ++k) {
        const double e = k_exp(low + length * rule->x[k]), inverse = 1 / e;
        const double rho = 0.5 * (e - inverse), root = 0.5 * (e + inverse);
        rays_add(q, c, rho, rule->weight[k] * length * 2 * rho / (root * root * root), sum);
    }
}

/* Over v, 1/rho = unit sinh v: down to the last normal however far it is, as G2 is. */
static void rays_add_far(const rays *q, rays_line c, double first, double last, both *sum) {
    const double one = k_sqrt(c.a), unit = k_min(k_max(1 / c.last, 1e-5 * one), one);
    const double low = k_asinh(1 / (unit * last)), length = k_asinh(1 / (unit * first)) - low;
    const gauss *rule = rays_rule(q, length);
    for (int k = 0; k < rule->count; ++k) {
        const double e = k_exp(low + length * rule->x[k]), inverse = 1 / e;
        const double w = 0.5 * unit * (e - inverse), step = 0.5 * unit * (e + inverse);
        const double rest = 1 / (1 + w * w);
        rays_add(q, c, 1 / w, rule->weight[k] * length * step * 2 * w * rest * rest, sum);
    }
}

/* Beckmann, u = 1 - exp(-rho^2): over rho. */
static void rays_add_gaussian(const rays *q, rays_line c, double first, double last, both *sum) {
    const double length = k_min(last, 5) - first; /* exp(-5^2) = 1e-11 */
    const gauss *rule = rays_rule(q, length);
    for (int k = 0; k < rule->count && length > 0; ++k) {
        const double rho = first + length * rule->x[k];
        rays_add(q, c, rho, rule->weight[k] * length * 2 * rho * k_exp(-rho * rho), sum);
    }
}

static void rays_add_piece(const rays *q, rays_line c, double first, double last, both *sum) {
    if (q->ndf == LOBE_NDF_BECKMANN) {
        rays_add_gaussian(q, c, first, last, sum);
        return;
    }
    const double middle =
        1 / k_sqrt(k_sqrt(c.a)); /* between D, at 1, and the slopes of 1, at 1/|c| */
    if (first < middle) rays_add_near(q, c, first, k_min(last, middle), sum);
    if (last > middle) rays_add_far(q, c, k_max(first, middle), last, sum);
}

/* Where G2 of V-cavities turns, in rho; how many. Lambda of Beckmann is smooth where o is straight up, but no
 * power series: there a ray toward i is cut too. */
static int rays_creases(const rays *q, rays_line c, double at[3]) {
    const v3 i = q->ggx.wi;
    const double unit = k_sqrt(c.a), tangent = c.b / (unit * i.z), h = k_angle(tangent, 1);
    if (q->masking == LOBE_MASKING_SMITH) {
        at[0] = k_sqrt(i.x * i.x + i.y * i.y) / ((1 + i.z) * unit);
        return q->ndf == LOBE_NDF_BECKMANN && c.b > 0 && at[0] < 4;
    }
    const k_sincos third = k_sincos_2pi((RAYS_PI / 2 + h) / (6 * RAYS_PI));
    const double seen = third.s / (third.c * unit);
    if (h > RAYS_PI / 4) {
        at[0] = 1 / (tangent * unit);
        at[1] = seen;
        at[2] = tangent / unit;
        return 3;
    }
    at[0] = seen;
    at[1] = h > RAYS_PI / 6 ? 1 / (tangent * unit) : c.last;
    return 2;
}

static void rays_add_line(const rays *q, double angle, double weight, both *sum) {
    const k_sincos turn = k_sincos_2pi(angle / (2 * RAYS_PI));
    const rays_line c = rays_line_of(q, turn.c, turn.s);
    double at[3], first = 0;
    both line = {{0, 0}};
    const int count = rays_creases(q, c, at);
    for (int k = 0; k <= count; ++k) {
        const double next = k < count ? k_min(k_max(at[k], first), c.last) : c.last;
        if (next > first) rays_add_piece(q, c, first, next, &line);
        first = next;
    }
    for (int k = 0; k < 2; ++k) sum->of[k] += weight * line.of[k];
}

/* ---- Around ---------------------------------------------------------------------------------- */

/* An angle where a piece ends, and how wide what happens there is. */
typedef struct rays_end {
    double angle, width;
} rays_end;

static const double RAYS_SMOOTH = 10; /* a width beyond any piece */

/* From `end` on, to that side: over v, distance = width sinh v. */
static void rays_add_side(const rays *q, rays_end end, double length, double side, both *sum) {
    const double reach = k_asinh(length / end.width);
    const gauss *rule = length < 0.5 && reach < 2 ? &q->sector : &q->around;
    for (int k = 0; k < rule->count; ++k) {
        const double e = k_exp(reach * rule->x[k]), inverse = 1 / e;
        const double distance = end.width * 0.5 * (e - inverse);
        const double step = reach * end.width * 0.5 * (e + inverse);
        rays_add_line(q, end.angle + side * distance, rule->weight[k] * step, sum);
    }
}

/* Nodes are drawn together at both ends where both need it. */
static void rays_add_between(const rays *q, rays_end a, rays_end b, both *sum) {
    const double length = b.angle - a.angle;
    if (!(length > 1e-13)) return;
    const int at_both = a.width < length && b.width < length;
    if (at_both || a.width < b.width) rays_add_side(q, a, at_both ? 0.5 * length : length, 1, sum);
    if (at_both || a.width >= b.width)
        rays_add_side(q, b, at_both ? 0.5 * length : length, -1, sum);
}

static double rays_angle(double y, double x) {
    return x < 0 ? (y < 0 ? -RAYS_PI : RAYS_PI) - k_angle(y, -x) : k_angle(y, x);
}

enum { RAYS_ENDS = 16 };

typedef struct rays_turn {
    rays_end at[RAYS_ENDS + 1];
    int count;
} rays_turn;

/* In order; the angle into [0, 2 pi). */
static void rays_add_end(rays_turn *t, double angle, double width) {
    const double turn = 2 * RAYS_PI, up = angle < 0 ? angle + turn : angle;
    const rays_end end = {up >= turn ? up - turn : up, width};
    int place = t->count++;
    for (; place > 0 && t->at[place - 1].angle > end.angle; --place)
        t->at[place] = t->at[place - 1];
    t->at[place] = end;
}

/* The two rays, if any, where tan h is `tangent`, above 0: xx c^2 + 2 xy c s + yy s^2 = 0. */
static void rays_add_order(rays_turn *t, const rays *q, double tangent, double width) {
    const ggx_base *g = &q->ggx;
    const double x = g->ax * g->wi.x, y = g->ay * g->wi.y, level = tangent * g->wi.z;
    const double xx = x * x - level * level * g->ax * g->ax;
    const double yy = y * y - level * level * g->ay * g->ay, square = x * y * x * y - xx * yy;
    if (!(square > 0)) return;
    const double sum = -(x * y + (x * y < 0 ? -k_sqrt(square) : k_sqrt(square)));
    const double found[2][2] = {{sum, xx}, {yy, sum}};
    for (int k = 0; k < 2; ++k) {
        const double side = found[k][0] * x + found[k][1] * y < 0 ? -1 : 1;
        rays_add_end(t, rays_angle(side * found[k][1], side * found[k][0]), width);
    }
}

/* The last end is the first, a turn later. */
static rays_turn rays_turn_of(const rays *q, double to_i) {
    const ggx_base *g = &q->ggx;
    const double x = g->ax * g->wi.x, y = g->ay * g->wi.y;
    const double toward2 = k_max(x * x + y * y, 1e-300);
    const double across2 = (g->ax * y) * (g->ax * y) + (g->ay * x) * (g->ay * x);
    const double width = k_min(k_max(g->wi.z * k_sqrt(across2) / toward2, 1e-3), RAYS_SMOOTH);
    const double narrow = k_max(k_min(g->ax, g->ay) / k_max(g->ax, g->ay), 1e-3);
    rays_turn t = {.count = 0};
    for (int k = 0; k < 4; ++k) {
        const int is_narrow = (k % 2 == 1) == (g->ax > g->ay);
        rays_add_end(&t, to_i + k * RAYS_PI / 2, k % 2 == 1 ? width : RAYS_SMOOTH);
        if (g->ax != g->ay) rays_add_end(&t, k * RAYS_PI / 2, is_narrow ? narrow : RAYS_SMOOTH);
    }
    if (q->masking == LOBE_MASKING_VCAVITY) {
        rays_add_order(&t, q, 1, width);
        rays_add_order(&t, q, 0.57735026918962576451 /* tan(pi/6) */, width);
    }
    t.at[t.count] = (rays_end){t.at[0].angle + 2 * RAYS_PI, t.at[0].width};
    return t;
}

/* Whether a piece lies on the side of growing angles from i. */
static int rays_is_ahead(rays_end a, rays_end b, double to_i) {
    return k_sincos_2pi((0.5 * (a.angle + b.angle) - to_i) / (2 * RAYS_PI)).s > 0;
}

/* A surface that is symmetric about the plane of incidence needs one half of the turn. */
static both rays_missing(const rays *q) {
    const ggx_base *g = &q->ggx;
    const int symmetric = g->ax == g->ay || g->wi.y == 0 || g->wi.x == 0;
    const double x = g->ax * g->wi.x, y = g->ay * g->wi.y;
    const double to_i = x * x + y * y > 0 ? rays_angle(y, x) : 0;
    const rays_turn t = rays_turn_of(q, to_i);
    both sum = {{0, 0}};
    for (int k = 0; k < t.count; ++k)
        if (!symmetric || rays_is_ahead(t.at[k], t.at[k + 1], to_i))
            rays_add_between(q, t.at[k], t.at[k + 1], &sum);
    for (int k = 0; k < 2; ++k) sum.of[k] = 1 - (symmetric ? 2 : 1) * sum.of[k] / (2 * RAYS_PI);
    return sum;
}

#endif
