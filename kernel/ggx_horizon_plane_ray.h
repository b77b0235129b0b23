/* kernel/ggx_horizon_plane_ray.h: what two planes leave of the microsurface, ray by ray.
 *
 * The cone half way between those of the shading plane and of the geometric plane, each scaled to the
 * eigenvalue 1, holds all that they have in common, and its axis n lies in both. Seen along n, what
 * leaves is star-shaped: on the ray m = r x + z n, x = c f1 + s f2, (c, s) a unit vector of the disk whose
 * image is the cone's ellipse, plane j is met where z/r falls to the larger root K_j of
 *     A0 K^2 + 2 B K + C,   A0 = n^T Q_j n,  B = x^T Q_j n,  C = x^T Q_j x.
 * With K the larger of the two roots, S = 1/(K^2 + |x|^2), t = r^2/S in [0, 1) and v = 1 - t,
 *     z^2 = S (K^2 + v |x|^2),   v = (z - K r)(z + K r),   m^T Q_j m = A0 (z - K_j r)(z - K'_j r).
 * The frame need not be exact for that: any n inside both cones will do. Where rounding or an extreme
 * case puts n outside, the ellipse itself is the end of every ray, and what it has too much is rejected. */
#ifndef K_GGX_HORIZON_PLANE_RAY_H
#define K_GGX_HORIZON_PLANE_RAY_H

#include "ggx_horizon_plane.h"
#include "ggx_horizon_point.h"

/* One plane in the frame (n, f1, f2): A0, and B and C as forms of (c, s). */
K_STRUCT(ggx_horizon_plane_cone) {
    real a0;
    real b1;
    real b2;
    real c11;
    real c12;
    real c22;
};

/* A shading point with two planes. */
K_STRUCT(ggx_horizon_plane_disk) {
    ggx_horizon_set set;
    ggx_horizon_frame f;
    v3 f1; /* the disk onto the ellipse, in the continuous basis of the frame; */
    v3 f2;
    v3 d1; /* and back: (m.d1, m.d2) = r (c, s) */
    v3 d2;
    real x11; /* |x|^2 as a form of (c, s) */
    real x12;
    real x22;
    real i1; /* i.f1, i.f2 */
    real i2;
    ggx_horizon_plane_cone shading;
    ggx_horizon_plane_cone geometric;
    kint cuts; /* n lies inside both cones */
};

/* A^2 as a form of (n, f1, f2). */
K_STRUCT(ggx_horizon_plane_gram) {
    real nn;
    real n1;
    real n2;
    real f11;
    real f12;
    real f22;
};

K_FN ggx_horizon_plane_gram ggx_horizon_plane_gram_of(ggx_base g, v3 n, v3 f1, v3 f2) {
    v3 an = ggx_stretch(n, g.ax, g.ay);
    v3 a1 = ggx_stretch(f1, g.ax, g.ay);
    v3 a2 = ggx_stretch(f2, g.ax, g.ay);
    ggx_horizon_plane_gram a;
    a.nn = v3_dot(an, an);
    a.n1 = v3_dot(an, a1);
    a.n2 = v3_dot(an, a2);
    a.f11 = v3_dot(a1, a1);
    a.f12 = v3_dot(a1, a2);
    a.f22 = v3_dot(a2, a2);
    return a;
}

/* i and h given by their products with n, f1, f2 */
K_FN ggx_horizon_plane_cone ggx_horizon_plane_cone_of(ggx_horizon_plane_gram a, v3 i, v3 h,
                                                      real c) {
    ggx_horizon_plane_cone k;
    k.a0 = R(2.0) * i.x * h.x - c * a.nn;
    k.b1 = i.x * h.y + i.y * h.x - c * a.n1;
    k.b2 = i.x * h.z + i.z * h.x - c * a.n2;
    k.c11 = R(2.0) * i.y * h.y - c * a.f11;
    k.c12 = i.y * h.z + i.z * h.y - c * a.f12;
    k.c22 = R(2.0) * i.z * h.z - c * a.f22;
    return k;
}

K_FN v3 ggx_horizon_plane_products(v3 a, v3 n, v3 f1, v3 f2) {
    return v3_of(v3_dot(a, n), v3_dot(a, f1), v3_dot(a, f2));
}

K_FN ggx_horizon_plane_disk ggx_horizon_plane_disk_of(ggx_base g) {
    ggx_horizon_plane_form geometric = ggx_horizon_plane_geometric(g);
    ggx_horizon_frame f = ggx_horizon_plane_between(g, geometric);
    real c = k_max(g.i_std.z, R(0.0));
    ggx_horizon_plane_disk d;
    d.f = f;
    d.set = ggx_horizon_set_of(g, f.lambda, f.a * f.b, g.i_std.z);
    d.f1 = v3_sub(v3_scale(f.e1, f.turn_c * f.a), v3_scale(f.e2, f.turn_s * f.b));
    d.f2 = v3_add(v3_scale(f.e1, f.turn_s * f.a), v3_scale(f.e2, f.turn_c * f.b));
    real inv_ab = R(1.0) / (f.a * f.b);
    real inv_a = f.b * inv_ab;
    real inv_b = f.a * inv_ab;
    d.d1 = v3_sub(v3_scale(f.e1, f.turn_c * inv_a), v3_scale(f.e2, f.turn_s * inv_b));
    d.d2 = v3_add(v3_scale(f.e1, f.turn_s * inv_a), v3_scale(f.e2, f.turn_c * inv_b));
    d.x11 = v3_dot(d.f1, d.f1);
    d.x12 = v3_dot(d.f1, d.f2);
    d.x22 = v3_dot(d.f2, d.f2);
    ggx_horizon_plane_gram a = ggx_horizon_plane_gram_of(g, f.n, d.f1, d.f2);
    v3 i = ggx_horizon_plane_products(g.i_std, f.n, d.f1, d.f2);
    v3 h = ggx_horizon_plane_products(geometric.h, f.n, d.f1, d.f2);
    d.i1 = i.y;
    d.i2 = i.z;
    d.shading = ggx_horizon_plane_cone_of(a, i, v3_of(f.n.z, d.f1.z, d.f2.z), c);
    d.geometric = ggx_horizon_plane_cone_of(a, i, h, geometric.c);
    d.cuts = k_flag(k_and(d.shading.a0 > R(0.0), d.geometric.a0 > R(0.0)));
    return d;
}

/* A0 of a plane and the two roots K at one azimuth. */
K_STRUCT(ggx_horizon_plane_crossing) {
    real a0;
    real larger;
    real smaller;
};

K_FN ggx_horizon_plane_crossing ggx_horizon_plane_cross(ggx_horizon_plane_cone q, real c, real s) {
    real b = q.b1 * c + q.b2 * s;
    real cc = (q.c11 * c + R(2.0) * q.c12 * s) * c + q.c22 * s * s;
    real sum = k_abs(b) + k_sqrt(k_max(b * b - q.a0 * cc, R(0.0)));
    real steep = sum / q.a0;
    real shallow = cc / k_max(sum, K_TINY);
    ggx_horizon_plane_crossing x;
    x.a0 = q.a0;
    x.larger = k_select(b > R(0.0), -shallow, steep);
    x.smaller = k_select(b > R(0.0), -steep, shallow);
    return x;
}

K_STRUCT(ggx_horizon_plane_ray) {
    real x2;    /* |x|^2 */
    real k2;    /* K^2 */
    real reach; /* S */
    ggx_horizon_plane_crossing shading;
    ggx_horizon_plane_crossing geometric;
};

K_FN ggx_horizon_plane_ray ggx_horizon_plane_ray_of(ggx_horizon_plane_disk d, real c, real s) {
    ggx_horizon_plane_ray ray;
    ray.x2 = (d.x11 * c + R(2.0) * d.x12 * s) * c + d.x22 * s * s;
    ray.shading = ggx_horizon_plane_cross(d.shading, c, s);
    ray.geometric = ggx_horizon_plane_cross(d.geometric, c, s);
    real k = k_max(k_max(ray.shading.larger, ray.geometric.larger), R(0.0));
    ray.k2 = k_select(k_is(d.cuts), k * k, k_max(R(1.0) - ray.x2, R(0.0)));
    ray.reach = R(1.0) / (ray.k2 + ray.x2);
    return ray;
}

/* A point of a ray. */
K_STRUCT(ggx_horizon_plane_point) {
    real r;
    real z;
};

K_FN ggx_horizon_plane_point ggx_horizon_plane_point_of(ggx_horizon_plane_ray ray, real v, real t) {
    ggx_horizon_plane_point y;
    y.r = k_sqrt(ray.reach * t);
    y.z = k_sqrt(ray.reach * (ray.k2 + v * ray.x2));
    return y;
}

/* m^T Q m; z - K_j r as a quotient of positive numbers where the plane is met */
K_FN real ggx_horizon_plane_value(ggx_horizon_plane_ray ray, ggx_horizon_plane_crossing x,
                                  ggx_horizon_plane_point y, real v) {
    real k2 = x.larger * x.larger;
    bool meets = x.larger > R(0.0);
    real sum = y.z + k_abs(x.larger) * y.r;
    real met = ray.reach * (ray.k2 - k2 + v * (ray.x2 + k2)) / sum;
    return x.a0 * k_select(meets, met, sum) * (y.z - x.smaller * y.r);
}

/* v of one plane alone, from m^T Q m */
K_FN real ggx_horizon_plane_room(ggx_horizon_plane_crossing x, ggx_horizon_plane_point y,
                                 real value) {
    real met = (y.z + x.larger * y.r) * value / (x.a0 * (y.z - x.smaller * y.r));
    return k_select(x.larger > R(0.0), met, y.z * y.z);
}

/* Where a point leads: the pair of the stretched normal m; value = m^T Q m of the shading plane,
 * im = m.i. Both are taken as in kernel/ggx_horizon_point.h. What rounding puts below the geometric
 * plane is lifted back. */
K_FN ggx_horizon_arrival ggx_horizon_plane_arrive(ggx_horizon_plane_disk d, v3 m, real im,
                                                  real value) {
    ggx_horizon_set s = d.set;
    v3 am = ggx_stretch(m, s.g.ax, s.g.ay);
    bool exists = k_or(k_is(d.cuts), k_and(m.z > R(0.0), im > R(0.0)));
    real product = R(0.5) * (value + s.c * v3_dot(am, am));
    real larger = k_max(k_max(m.z, im), K_TINY);
    real smaller = product / larger;
    am.z = k_select(k_and(exists, m.z < R(0.25) * larger), smaller, m.z);
    ggx_horizon_arrival to;
    to.im = k_select(k_and(exists, im < R(0.25) * larger), smaller, im);
    real am2 = v3_dot(am, am);
    real inv = R(1.0) / k_sqrt(am2);
    to.pair.m = v3_scale(am, inv);
    to.pair.cos_im = s.g.t_i * to.im * inv;
    to.pair.d = ggx_d_stretched(s.g, am2);
    v3 wo = v3_sub(v3_scale(to.pair.m, R(2.0) * v3_dot(s.g.wi, to.pair.m)), s.g.wi);
    wo.z = k_select(k_and(k_is(s.front), wo.z < R(0.0625)), s.g.t_i * value * inv * inv, wo.z);
    real sinks = k_select(k_is(d.cuts), R(4.0) * K_EPS - v3_dot(wo, s.g.plane), R(0.0));
    to.pair.wo = v3_add(wo, v3_scale(s.g.plane, k_max(sinks, R(0.0))));
    to.pair.leaves = k_and(exists, facet_leaves(to.pair.wo, s.g.plane));
    return to;
}

#endif
