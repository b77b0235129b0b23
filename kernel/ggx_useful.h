/* kernel/ggx_useful.h: how much of the visible microsurface reflects upward, in closed form.
 *
 * In the stretched space the useful normals are a quadratic cone m^T Q m >= 0,
 * Q = [[-c_x, 0, i_x], [0, -c_y, i_y], [i_x, i_y, r]], c = max(i_z, 0), c_x = c ax^2, c_y = c ay^2,
 * r = 2 i_z - c (all i stretched). Its one positive eigenvalue L has the eigenvector n; seen along n
 * the useful set is an ellipse with the half axes a, b, and its area in the disk across i is
 * pi a b nu with nu = n . i. The derivation is in docs/optimal-caps.md. */
#ifndef K_GGX_USEFUL_H
#define K_GGX_USEFUL_H

#include "ggx.h"

/* The cone's axis and what comes with it. */
K_STRUCT(ggx_useful) {
    v3 i; /* i_std; the normal where nothing is visible */
    real c;
    real cx;
    real cy;
    real r;
    real lambda;
    real lambda_minus_r; /* each of these a sum of positive terms */
    real det;            /* of Q: L l1 l2 */
    v3 axis;             /* n; n_z > 0 */
    real nu;
};

/* A step to the root of f(L) = r - L + x2/(L + cx) + y2/(L + cy), convex and decreasing: the two poles are
 * replaced by one pole and a constant of the same value, slope and curvature, and the quadratic that is
 * left is solved. It does not mind how far apart cx and cy are, as Newton's step does. */
K_FN real ggx_useful_first_step(real l, real x2, real y2, real cx, real cy, real r) {
    real px = l + cx;
    real py = l + cy;
    real inv = R(1.0) / (px * py);
    real inv_x = py * inv;
    real inv_y = px * inv;
    real term_x = x2 * inv_x;
    real term_y = y2 * inv_y;
    real slope_x = term_x * inv_x;
    real slope_y = term_y * inv_y;
    real f = r - l + (term_x + term_y);
    real slope = slope_x + slope_y;
    real bend = slope_x * inv_x + slope_y * inv_y;
    real b = slope * (R(1.0) + slope) - f * bend;
    real root = k_sqrt(k_max(b * b + R(4.0) * f * slope * bend, R(0.0)));
    return l + R(2.0) * f * slope / k_max(b + root, K_TINY);
}

/* Halley's step on the cubic -f (L + cx) (L + cy), whose other roots are negative. */
K_FN real ggx_useful_next_step(real l, real x2, real y2, real cx, real cy, real r) {
    real px = l + cx;
    real py = l + cy;
    real above = l - r;
    real p = above * px * py - x2 * py - y2 * px;
    real p1 = px * py + above * (px + py) - (x2 + y2);
    real half_p2 = px + py + above;
    return l - p * p1 / (p1 * p1 - p * half_p2);
}

#if K_IS_F64
#define GGX_USEFUL_NEXT_STEPS 2
#else
#define GGX_USEFUL_NEXT_STEPS 1
#endif

/* The positive eigenvalue for i_z > 0: the root of f. It is near 1 where both of cx, cy are small. Relative
 * errors over all of the roughness that a base admits: 1 (the start), 1.2e-3, 1.1e-9, below 1e-15. */
K_FN real ggx_useful_eigenvalue(v3 i, real cx, real cy, real r) {
    real x2 = i.x * i.x;
    real y2 = i.y * i.y;
    real one_cx = R(1.0) + cx;
    real one_cy = R(1.0) + cy;
    real l = r + (x2 * one_cy + y2 * one_cx) / (one_cx * one_cy);
    l = ggx_useful_first_step(l, x2, y2, cx, cy, r);
    for (int step = 0; step < GGX_USEFUL_NEXT_STEPS; ++step)
        l = ggx_useful_next_step(l, x2, y2, cx, cy, r);
    return l;
}

K_FN ggx_useful ggx_useful_of(ggx_base g) {
    v3 i = v3_select(k_is(g.valid), g.i_std, v3_of(R(0.0), R(0.0), R(1.0)));
    ggx_useful s;
    s.i = i;
    s.c = k_max(i.z, R(0.0));
    s.cx = s.c * g.ax * g.ax;
    s.cy = s.c * g.ay * g.ay;
    s.r = R(2.0) * i.z - s.c;
    /* from behind L = 1 + i_z */
    bool front_lit = i.z > R(0.0);
    real from_front = ggx_useful_eigenvalue(i, s.cx, s.cy, s.r);
    s.lambda = k_select(front_lit, from_front, g.one_plus_z);
    /* n along (x/(L + c_x), y/(L + c_y), 1) */
    real px = k_select(front_lit, s.lambda + s.cx, R(1.0));
    real py = k_select(front_lit, s.lambda + s.cy, R(1.0));
    v3 along = v3_of(i.x * py, i.y * px, k_select(front_lit, px * py, s.lambda));
    real inv_length = R(1.0) / k_sqrt(v3_dot(along, along));
    s.axis = v3_scale(along, inv_length);
    real across = i.x * along.x + i.y * along.y;
    s.nu = (across + i.z * along.z) * inv_length;
    /* by the eigenvalue equation */
    s.lambda_minus_r = across / along.z;
    s.det = s.cx * s.cy * s.r + s.cx * i.y * i.y + s.cy * i.x * i.x;
    return s;
}

/* a b nu, by 1/(a b)^2 = (1 + l1/L)(1 + l2/L): trace and determinant give the sum and the product */
K_FN real ggx_useful_area(ggx_base g) {
    ggx_useful s = ggx_useful_of(g);
    real sum = s.lambda_minus_r + s.cx + s.cy;
    return s.nu * s.lambda / k_sqrt(s.lambda * (s.lambda + sum) + s.det / s.lambda);
}

#endif
