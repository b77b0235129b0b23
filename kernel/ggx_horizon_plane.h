/* kernel/ggx_horizon_plane.h: the half-space above any plane, seen from the stretched microsurface.
 *
 * A reflection lies above the plane of the unit normal p iff its stretched normal m has
 *     m^T Q m >= 0,   Q = i h^T + h i^T - c A^2,   h = A p,   c = (wi.p)/t_i   (wi.p > 0),
 * i stretched: o.p = t_i m^T Q m/|A m|^2. The shading plane is h = z, c = max(i_z, 0): from behind the
 * reflection of a normal with m_z > 0, m.i > 0 always lies above it, and that is c = 0. Sums of such
 * forms with positive weights are such forms again, so one eigenvalue problem serves a plane, both planes
 * and every cone between them.
 *
 * Q has one positive eigenvalue L. With W = (L + c A^2)^-1, p = i^T W h, q = i^T W i, s = h^T W h,
 *     Q n = L n  <=>  p + sqrt(q s) = 1,   n along W (sqrt(s) i + sqrt(q) h). */
#ifndef K_GGX_HORIZON_PLANE_H
#define K_GGX_HORIZON_PLANE_H

#include "ggx_horizon_frame.h"

/* Steps down the characteristic cubic, then steps to the root of p + sqrt(q s) = 1. */
#define GGX_HORIZON_PLANE_STEPS (5 + K_IS_F64)
#define GGX_HORIZON_PLANE_POLISH (2 + K_IS_F64)

K_STRUCT(ggx_horizon_plane_form) {
    v3 h;
    real c;
};

K_FN ggx_horizon_plane_form ggx_horizon_plane_shading(ggx_base g) {
    ggx_horizon_plane_form q;
    q.h = v3_of(R(0.0), R(0.0), R(1.0));
    q.c = k_max(g.i_std.z, R(0.0));
    return q;
}

K_FN ggx_horizon_plane_form ggx_horizon_plane_geometric(ggx_base g) {
    ggx_horizon_plane_form q;
    q.h = ggx_stretch(g.plane, g.ax, g.ay);
    q.c = k_max(v3_dot(g.wi, g.plane), R(0.0)) / g.t_i;
    return q;
}

/* q s + r t */
K_FN ggx_horizon_plane_form ggx_horizon_plane_mix(ggx_horizon_plane_form q, real s,
                                                  ggx_horizon_plane_form r, real t) {
    ggx_horizon_plane_form sum;
    sum.h = v3_add(v3_scale(q.h, s), v3_scale(r.h, t));
    sum.c = q.c * s + r.c * t;
    return sum;
}

/* What the eigenvalue takes from a form. */
K_STRUCT(ggx_horizon_plane_terms) {
    real cx; /* c A^2 */
    real cy;
    real cz;
    v3 ih;     /* i_k h_k */
    v3 cross2; /* (i x h)_k^2 */
    real trace;
    real minors; /* sum of the principal minors of order two */
    real det;
    real above; /* p + sqrt(q s) of L = 1, c = 0: an upper bound of the eigenvalue */
};

/* p + sqrt(pp + cross2), without cancellation for p < 0 */
K_FN real ggx_horizon_plane_sum(real p, real cross2, real root) {
    return k_select(p < R(0.0), cross2 / k_max(root - p, K_TINY), p + root);
}

K_FN ggx_horizon_plane_terms ggx_horizon_plane_terms_of(ggx_base g, ggx_horizon_plane_form q) {
    v3 i = g.i_std;
    v3 h = q.h;
    real ax2 = g.ax * g.ax;
    real ay2 = g.ay * g.ay;
    real c = q.c;
    ggx_horizon_plane_terms t;
    t.cx = c * ax2;
    t.cy = c * ay2;
    t.cz = c;
    t.ih = v3_of(i.x * h.x, i.y * h.y, i.z * h.z);
    t.cross2 = v3_of(k_square(i.y * h.z - i.z * h.y), k_square(i.z * h.x - i.x * h.z),
                     k_square(i.x * h.y - i.y * h.x));
    real p = t.ih.x + t.ih.y + t.ih.z;
    real cross = t.cross2.x + t.cross2.y + t.cross2.z;
    t.trace = R(2.0) * p - (t.cx + t.cy + t.cz);
    t.minors = t.cx * t.cy + t.cz * (t.cx + t.cy) - cross -
               R(2.0) * (t.ih.x * (t.cy + t.cz) + t.ih.y * (t.cx + t.cz) + t.ih.z * (t.cx + t.cy));
    t.det = R(2.0) * (t.ih.x * t.cy * t.cz + t.ih.y * t.cx * t.cz + t.ih.z * t.cx * t.cy) -
            t.cx * t.cy * t.cz + t.cx * t.cross2.x + t.cy * t.cross2.y + t.cz * t.cross2.z;
    t.above = ggx_horizon_plane_sum(p, cross, k_sqrt(v3_dot(h, h)));
    return t;
}

/* The positive root of L^3 - trace L^2 + minors L - det, from above: each step goes to the root of the
 * parabola that touches (Cauchy), which does not mind two small roots close together. */
K_FN real ggx_horizon_plane_root(ggx_horizon_plane_terms t, real above) {
    real l = above;
    for (int step = 0; step < GGX_HORIZON_PLANE_STEPS; ++step) {
        real p = ((l - t.trace) * l + t.minors) * l - t.det;
        real p1 = (R(3.0) * l - R(2.0) * t.trace) * l + t.minors;
        real p2 = R(6.0) * l - R(2.0) * t.trace;
        real root = k_sqrt(k_max(p1 * p1 - R(2.0) * p * p2, R(0.0)));
        l = k_max(l - R(2.0) * p / k_max(p1 + root, K_TINY), R(1e-4) * l);
    }
    return l;
}

/* An eigenvalue and its vector. */
K_STRUCT(ggx_horizon_plane_axis) {
    real lambda;
    v3 n;
};

/* n of an approximate L, and the Rayleigh quotient of n, whose error is the square of that of n. */
K_FN ggx_horizon_plane_axis ggx_horizon_plane_polish(ggx_base g, ggx_horizon_plane_form q,
                                                     ggx_horizon_plane_terms t, real l) {
    v3 i = g.i_std;
    real px = l + t.cx;
    real py = l + t.cy;
    real pz = l + t.cz;
    real inv = R(1.0) / (px * py * pz);
    real wx = py * pz * inv;
    real wy = px * pz * inv;
    real wz = px * py * inv;
    real p = wx * t.ih.x + wy * t.ih.y + wz * t.ih.z;
    real qq = k_sqrt(wx * i.x * i.x + wy * i.y * i.y + wz * i.z * i.z);
    real ss = k_sqrt(wx * q.h.x * q.h.x + wy * q.h.y * q.h.y + wz * q.h.z * q.h.z);
    real root = qq * ss;
    real cross = inv * (px * t.cross2.x + py * t.cross2.y + pz * t.cross2.z);
    real m = ggx_horizon_plane_sum(p, cross, root);
    v3 n = v3_of(wx * (ss * i.x + qq * q.h.x), wy * (ss * i.y + qq * q.h.y),
                 wz * (ss * i.z + qq * q.h.z));
    real n2 = k_max(v3_dot(n, n), K_TINY);
    ggx_horizon_plane_axis axis;
    axis.lambda = k_max(l + R(2.0) * root * m * (m - R(1.0)) / n2, R(0.1) * l);
    axis.n = v3_scale(n, R(1.0) / k_sqrt(n2));
    return axis;
}

K_FN ggx_horizon_plane_axis ggx_horizon_plane_axis_of(ggx_base g, ggx_horizon_plane_form q,
                                                      ggx_horizon_plane_terms t, real above) {
    real l = k_max(ggx_horizon_plane_root(t, k_min(t.above, above)), K_TINY);
    ggx_horizon_plane_axis axis = ggx_horizon_plane_polish(g, q, t, l);
    for (int step = 1; step < GGX_HORIZON_PLANE_POLISH; ++step)
        axis = ggx_horizon_plane_polish(g, q, t, axis.lambda);
    return axis;
}

/* An upper bound of the eigenvalue of the geometric plane alone: Q is the positive square of A b, b half
 * way between wi and the plane, less something positive. */
K_FN real ggx_horizon_plane_above(ggx_base g) {
    v3 b = v3_add(g.wi, g.plane);
    v3 ab = ggx_stretch(b, g.ax, g.ay);
    return v3_dot(ab, ab) / k_max(g.t_i * v3_dot(b, b), K_TINY);
}

K_FN ggx_horizon_form ggx_horizon_plane_matrix(ggx_base g, ggx_horizon_plane_form q,
                                               ggx_horizon_plane_terms t) {
    v3 i = g.i_std;
    ggx_horizon_form f;
    f.xx = R(2.0) * t.ih.x - t.cx;
    f.yy = R(2.0) * t.ih.y - t.cy;
    f.zz = R(2.0) * t.ih.z - t.cz;
    f.xy = i.x * q.h.y + i.y * q.h.x;
    f.xz = i.x * q.h.z + i.z * q.h.x;
    f.yz = i.y * q.h.z + i.z * q.h.y;
    return f;
}

K_FN ggx_horizon_frame ggx_horizon_plane_frame(ggx_base g, ggx_horizon_plane_form q,
                                               ggx_horizon_plane_terms t,
                                               ggx_horizon_plane_axis axis) {
    ggx_horizon_form f = ggx_horizon_plane_matrix(g, q, t);
    return ggx_horizon_frame_of_form(f, axis.n, axis.lambda, axis.lambda - f.zz, t.det, g.i_std,
                                     v3_dot(axis.n, g.i_std));
}

/* The cone half way between the two planes, each scaled to the eigenvalue 1: its own is at most 1. */
K_FN ggx_horizon_frame ggx_horizon_plane_between(ggx_base g, ggx_horizon_plane_form geometric) {
    real l1 = ggx_useful_of(g).lambda;
    ggx_horizon_plane_terms t2 = ggx_horizon_plane_terms_of(g, geometric);
    real l2 = ggx_horizon_plane_root(t2, k_min(t2.above, ggx_horizon_plane_above(g)));
    ggx_horizon_plane_form q =
        ggx_horizon_plane_mix(ggx_horizon_plane_shading(g), R(0.5) / k_max(l1, K_TINY), geometric,
                              R(0.5) / k_max(l2, K_TINY));
    ggx_horizon_plane_terms t = ggx_horizon_plane_terms_of(g, q);
    return ggx_horizon_plane_frame(g, q, t, ggx_horizon_plane_axis_of(g, q, t, R(1.0)));
}

#endif
