/* tools/numerics/dielectric_sum.h: what a compensated rough dielectric scatters once of even light, both forms of
 * G2 in one pass, for the makers of its tables and for what measures them.
 *
 * Over the visible normals in polar coordinates about i, in the stretched space where they fill a projected disk:
 * with c the cosine from i and phi the azimuth, c dc dphi over pi (1 + i_z)/2 of the normals above the surface.
 * By Gauss's rule over phi, its nodes drawn together where the horizon crosses, and over c between the places where
 * reflection or refraction begins or ends, its nodes drawn together toward small c, where Fresnel's law turns. */
#ifndef TOOLS_DIELECTRIC_SUM_H
#define TOOLS_DIELECTRIC_SUM_H

#include "kernel/bind/c_f64.h"

#include "kernel/arc.h"
#include "kernel/exp.h"
#include "kernel/ggx_dielectric.h"

#include "gauss.h"

static const double SUM_PI = 3.14159265358979323846;

/* For the two forms of G2, in the order of lobe_g2. */
typedef struct both {
    double of[2];
} both;

typedef struct dielectric_sum {
    ggx_base g;
    dielectric_side side;
    double fold; /* the c at which Fresnel's law turns */
    v3 x, y;     /* across i_std, x in the plane of incidence */
    gauss along, piece, around;
} dielectric_sum;

static dielectric_sum sum_rules(int along, int piece, int around) {
    dielectric_sum q;
    q.along = gauss_of(along);
    q.piece = gauss_of(piece);
    q.around = gauss_of(around);
    return q;
}

/* wi above; eta: the far index over the near one. */
static void sum_toward(dielectric_sum *q, v3 wi, double alpha_x, double alpha_y, double eta) {
    const int inside = eta < 1;
    const dielectric_options options = {false, true, false, true};
    q->g = ggx_base_of(wi, alpha_x, alpha_y, facet_options_of(false, false));
    q->side = dielectric_side_of(inside, inside ? 1 / eta : eta, options, false, true);
    const v3 s = q->g.i_std;
    const double rho = k_sqrt(q->g.rho2);
    const double px = rho > 0 ? s.x / rho : 1, py = rho > 0 ? s.y / rho : 0;
    q->x = v3_of(-px * s.z, -py * s.z, rho); /* toward the normal */
    q->y = v3_of(py, -px, 0);
    const double size = k_sqrt(k_abs(q->side.n.gap));
    q->fold = k_min(k_max(size / q->g.t_i * k_min(1.0, k_max(alpha_x, alpha_y)), 1e-3), 2.0);
}

/* The normal of stretched space at c and azimuth. */
static dielectric_facet sum_facet(const dielectric_sum *q, double c, k_sincos turn) {
    const double s = k_sqrt(k_max(1 - c * c, 0));
    const v3 across = v3_add(v3_scale(q->x, s * turn.c), v3_scale(q->y, s * turn.s));
    const v3 h = v3_add(v3_scale(q->g.i_std, c), across);
    const v3 a = v3_of(h.x * q->g.ax, h.y * q->g.ay, k_max(h.z, 0));
    const double size = k_sqrt(v3_dot(a, a));
    return dielectric_facet_of(q->side, q->g.wi, v3_scale(a, 1 / k_max(size, K_TINY)));
}

static void sum_add(const dielectric_sum *q, double c, k_sincos turn, double weight, both *sum) {
    const dielectric_facet f = sum_facet(q, c, turn);
    const ggx_base *g = &q->g;
    if (f.reflects) {
        const double z = f.reflected.z, t = ggx_t(f.reflected, g->ax, g->ay);
        const double part = weight * f.light.reflectance * z;
        sum->of[0] += part * (g->wi.z + g->t_i) / (g->t_i * z + t * g->wi.z);
        sum->of[1] += part * 2 / (z + t);
    }
    if (f.passes) {
        const double part =
            weight * f.light.transmittance / (1 + dielectric_lambda(f.passing, g->ax, g->ay));
        sum->of[0] += part;
        sum->of[1] += part;
    }
}

/* Which of the two directions leave, and whether refraction is possible. */
static int sum_kind(const dielectric_sum *q, double c, k_sincos turn) {
    const dielectric_facet f = sum_facet(q, c, turn);
    return (f.reflected.z > 0) + 2 * (f.passing.z < 0) +
           4 * (q->side.n.gap + f.cos_im * f.cos_im > 0);
}

static void sum_add_piece(const dielectric_sum *q, k_sincos turn, double first, double last,
                          double weight, both *sum) {
    const double low = k_asinh(first / q->fold), length = k_asinh(last / q->fold) - low;
    const gauss *rule = length > 1.5 ? &q->along : &q->piece;
    for (int k = 0; k < rule->count; ++k) {
        /* y^2 (3 - 2 y): roots at the ends */
        const double y = rule->x[k], x = y * y * (3 - 2 * y), step = 6 * y * (1 - y);
        const double e = k_exp(low + length * x), inverse = 1 / e;
        const double c = q->fold * 0.5 * (e - inverse), root = q->fold * 0.5 * (e + inverse);
        sum_add(q, c, turn, weight * rule->weight[k] * step * length * root * c, sum);
    }
}

static void sum_add_line(const dielectric_sum *q, double angle, double weight, both *sum) {
    enum { SCAN = 12, HALVINGS = 30 };
    const k_sincos turn = k_sincos_2pi(angle / (2 * SUM_PI));
    const double rho = k_sqrt(q->g.rho2), z = q->g.i_std.z;
    /* above the surface: c z + s rho cos(phi) > 0 */
    const double slope = -rho * turn.c / z,
                 least = turn.c < 0 ? slope / k_sqrt(1 + slope * slope) : 0;
    const double low = k_asinh(least / q->fold), high = k_asinh(1 / q->fold);
    double first = least, a = least;
    int before = sum_kind(q, a + 1e-14, turn);
    for (int k = 1; k <= SCAN; ++k) {
        const double e = k_exp(low + (high - low) * k / SCAN);
        double b = k == SCAN ? 1 : q->fold * 0.5 * (e - 1 / e);
        const int here = sum_kind(q, b, turn);
        if (here != before) {
            double p = a, r = b;
            for (int j = 0; j < HALVINGS; ++j) {
                const double middle = 0.5 * (p + r);
                if (sum_kind(q, middle, turn) == before)
                    p = middle;
                else
                    r = middle;
            }
            sum_add_piece(q, turn, first, p, weight, sum);
            first = p;
        }
        before = here;
        a = b;
    }
    sum_add_piece(q, turn, first, 1, weight, sum);
}

static void sum_add_side(const dielectric_sum *q, double side, double width, both *sum) {
    const double reach = k_asinh(SUM_PI / 2 / width);
    for (int k = 0; k < q->around.count; ++k) {
        const double e = k_exp(reach * q->around.x[k]), inverse = 1 / e;
        const double distance = width * 0.5 * (e - inverse), step = width * 0.5 * (e + inverse);
        sum_add_line(q, SUM_PI / 2 + side * distance, q->around.weight[k] * reach * step, sum);
        if (q->g.ax != q->g.ay && q->g.wi.y != 0 && q->g.wi.x != 0)
            sum_add_line(q, -SUM_PI / 2 + side * distance, q->around.weight[k] * reach * step, sum);
    }
}

static both sum_of(const dielectric_sum *q) {
    const double width = k_min(k_max(q->g.i_std.z, 1e-3), 3);
    const int halves = q->g.ax != q->g.ay && q->g.wi.y != 0 && q->g.wi.x != 0 ? 1 : 2;
    both sum = {{0, 0}};
    sum_add_side(q, -1, width, &sum);
    sum_add_side(q, 1, width, &sum);
    for (int k = 0; k < 2; ++k) sum.of[k] *= halves / (0.5 * SUM_PI * (1 + q->g.i_std.z));
    return sum;
}

#endif
