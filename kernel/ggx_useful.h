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

/* Steps to the eigenvalue. Relative errors from the start on, over all of the roughness that a base
 * admits and any i: 1, 2.3e-3, 1.7e-10, below 1e-15. */
#define GGX_USEFUL_STEPS (2 + K_IS_F64)

/* The cone's axis and what comes with it. */
K_STRUCT(ggx_useful) {
    real c;
    real cx;
    real cy;
    real r;
    real lambda;
    real lambda_minus_r; /* each of these a sum of positive terms */
    real minor_product;  /* of the two eigenvalues of -Q across the axis */
    v3 axis;             /* n; n_z > 0 */
    real nu;
};

/* One step to the root of f(L) = r - L + x2/(L + cx) + y2/(L + cy), convex and decreasing: the two
 * poles are replaced by one pole and a constant of the same value, slope and curvature, and the
 * quadratic that is left is solved. Of third order, and it does not mind how far apart cx and cy are;
 * Newton's step does. */
K_FN real ggx_useful_step(real l, real x2, real y2, real cx, real cy, real r) {
    real px = l + cx;
    real py = l + cy;
    real inv = R(1.0) / (px * py);
    real inv_x = py * inv;
    real inv_y = px * inv;
    real term_x = x2 * inv_x;
    real term_y = y2 * inv_y;
    real f = r - l + (term_x + term_y);
    real slope_x = term_x * inv_x;
    real slope_y = term_y * inv_y;
    real slope = slope_x + slope_y;
    real distance = slope / k_max(slope_x * inv_x + slope_y * inv_y, K_TINY);
    real b = distance * (R(1.0) + slope) - f;
    real fd = R(2.0) * f * distance;
    real root = k_sqrt(k_max(b * b + R(2.0) * fd, R(0.0)));
    return l + fd / k_max(b + root, K_TINY);
}

/* The positive eigenvalue for i_z > 0. The start replaces both poles by one at their mean (Jensen: from
 * below; exact for isotropic roughness). */
K_FN real ggx_useful_eigenvalue(v3 i, real cx, real cy, real r) {
    real x2 = i.x * i.x;
    real y2 = i.y * i.y;
    real rho2 = x2 + y2;
    real mean_c = (x2 * cx + y2 * cy) / k_max(rho2, K_TINY);
    real half_gap = R(0.5) * (r - mean_c);
    real half_sum = R(0.5) * (r + mean_c);
    real root = k_sqrt(half_sum * half_sum + rho2);
    real falling = (r * mean_c + rho2) / k_max(root - half_gap, K_TINY);
    real l = k_select(half_gap >= R(0.0), half_gap + root, falling);
    for (int step = 0; step < GGX_USEFUL_STEPS; ++step) l = ggx_useful_step(l, x2, y2, cx, cy, r);
    return l;
}

K_FN ggx_useful ggx_useful_of(ggx_base g) {
    v3 i = g.i_std;
    ggx_useful s;
    s.c = k_max(i.z, R(0.0));
    s.cx = s.c * g.ax * g.ax;
    s.cy = s.c * g.ay * g.ay;
    s.r = R(2.0) * i.z - s.c;
    /* from behind and at grazing incidence L = 1 + i_z */
    real front = ggx_useful_eigenvalue(i, s.cx, s.cy, s.r);
    s.lambda = k_select(i.z > R(0.0), front, g.one_plus_z);
    real nx = i.x / (s.lambda + s.cx);
    real ny = i.y / (s.lambda + s.cy);
    real nz = R(1.0) / k_sqrt(nx * nx + ny * ny + R(1.0));
    s.axis = v3_of(nx * nz, ny * nz, nz);
    /* by the eigenvalue equation */
    s.lambda_minus_r = i.x * nx + i.y * ny;
    s.minor_product = (s.cx * s.cy * s.r + s.cx * i.y * i.y + s.cy * i.x * i.x) / s.lambda;
    s.nu = (s.lambda_minus_r + i.z) * nz;
    return s;
}

/* a b nu, by 1/(a b)^2 = (1 + l1/L)(1 + l2/L): trace and determinant give the sum and the product */
K_FN real ggx_useful_area(ggx_base g) {
    ggx_useful s = ggx_useful_of(g);
    real sum = s.lambda_minus_r + s.cx + s.cy;
    return s.nu * s.lambda / k_sqrt(s.lambda * (s.lambda + sum) + s.minor_product);
}

#endif
