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

/* The positive eigenvalue of Q: the root of the convex, decreasing
 * f(L) = r - L + i_x^2/(L + c_x) + i_y^2/(L + c_y), by Newton from below. */
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
    for (int step = 0; step < 3; ++step) {
        real inv_x = R(1.0) / (l + cx);
        real inv_y = R(1.0) / (l + cy);
        real term_x = x2 * inv_x;
        real term_y = y2 * inv_y;
        l = l + (r - l + term_x + term_y) / (R(1.0) + term_x * inv_x + term_y * inv_y);
    }
    return l;
}

/* a b nu */
K_FN real ggx_useful_area(ggx_base g) {
    v3 i = g.i_std;
    real c = k_max(i.z, R(0.0));
    real cx = c * g.ax * g.ax;
    real cy = c * g.ay * g.ay;
    real r = R(2.0) * i.z - c;
    real l = ggx_useful_eigenvalue(i, cx, cy, r);
    real nx = i.x / (l + cx);
    real ny = i.y / (l + cy);
    real nz = R(1.0) / k_sqrt(nx * nx + ny * ny + R(1.0));
    /* l - r by the eigenvalue equation: a sum of positive terms */
    real l_minus_r = i.x * nx + i.y * ny;
    real nu = (l_minus_r + i.z) * nz;
    /* 1/(a b)^2 = (1 + l1/l)(1 + l2/l): trace and determinant give the sum and the product */
    real sum = l_minus_r + cx + cy;
    real product = (cx * cy * r + cx * i.y * i.y + cy * i.x * i.x) / l;
    return nu * l / k_sqrt(l * (l + sum) + product);
}

#endif
