/* kernel/ggx_horizon_disk.h: the useful normals of one half-space as an ellipse, without its axes.
 *
 * Where kernel/ggx_horizon_frame.h turns the basis (t1, t2) about n to the axes of the ellipse, here the
 * disk is laid onto it by the symmetric root S of its shape, B = -Q across n in (t1, t2):
 *     m = T S y + z n,   S^2 = L (L + B)^-1,   z^2 = v + y^T G y,   G = 1 - S^2 = B (L + B)^-1,
 *     k = S T^T i/nu.
 * y is what the axes and ggx_horizon_turned give, so the points are the same; no eigenvector is needed, and
 * S is in closed form:
 *     S = sqrt(L/(d (tr + 2 sqrt(d)))) ((tr + sqrt(d)) 1 - (L + B)),   d = det(L + B), tr = trace(L + B).
 * Every entry on a diagonal is a sum of positive terms. */
#ifndef K_GGX_HORIZON_DISK_H
#define K_GGX_HORIZON_DISK_H

#include "ggx_horizon_frame.h"

K_STRUCT(ggx_horizon_disk) {
    v3 n;
    v3 f1; /* T S */
    v3 f2;
    real g11; /* G */
    real g12;
    real g22;
    real lambda;
    real ab;
    real nu;
    real k1;
    real k2;
};

/* An eigenvalue of a form and what comes with it, each from whoever knows how it does not cancel. */
K_STRUCT(ggx_horizon_eigen) {
    v3 n; /* n_z > 0 */
    real nu;
    real lambda;
    real lambda_minus_zz;
    real sum; /* l1 + l2 = L - trace */
    real det; /* L l1 l2 */
};

/* The way back, up to a factor: T S^-1. */
K_STRUCT(ggx_horizon_back) {
    v3 d1;
    v3 d2;
};

/* What both ways are made of. */
K_STRUCT(ggx_horizon_shape) {
    ggx_horizon_across b;
    v3 t1;
    v3 t2;
    real m11; /* L + B + sqrt(d) on the diagonal */
    real m22;
    real l1_l2;
    real root;
    real inv_w; /* 1/(d (tr + 2 sqrt(d))) */
    real inv_d;
    real inv_nu;
};

K_FN ggx_horizon_shape ggx_horizon_shape_of(ggx_horizon_form q, ggx_horizon_eigen e) {
    v3 n = e.n;
    real inv_both = R(1.0) / ((R(1.0) + n.z) * e.nu);
    ggx_horizon_shape s;
    s.inv_nu = (R(1.0) + n.z) * inv_both;
    s.b = ggx_horizon_across_of(q, n, e.nu * inv_both, e.lambda_minus_zz);
    s.t1 = v3_of(R(1.0) - s.b.h1 * n.x, -s.b.h1 * n.y, -n.x);
    s.t2 = v3_of(s.t1.y, R(1.0) - s.b.h2 * n.y, -n.y);
    s.l1_l2 = k_max(e.det / e.lambda, R(0.0));
    real d = e.lambda * (e.lambda + e.sum) + s.l1_l2;
    s.root = k_sqrt(d);
    real above = R(2.0) * (e.lambda + s.root) + e.sum;
    s.inv_w = R(1.0) / (d * above);
    s.inv_d = above * s.inv_w;
    s.m11 = e.lambda + s.root + s.b.b11;
    s.m22 = e.lambda + s.root + s.b.b22;
    return s;
}

K_FN ggx_horizon_disk ggx_horizon_disk_of_shape(ggx_horizon_shape s, ggx_horizon_eigen e, v3 i) {
    real scale = k_sqrt(e.lambda * s.inv_w);
    real s11 = scale * s.m22;
    real s12 = -scale * s.b.b12;
    real s22 = scale * s.m11;
    real i1 = v3_dot(i, s.t1) * s.inv_nu;
    real i2 = v3_dot(i, s.t2) * s.inv_nu;
    ggx_horizon_disk f;
    f.n = e.n;
    f.f1 = v3_add(v3_scale(s.t1, s11), v3_scale(s.t2, s12));
    f.f2 = v3_add(v3_scale(s.t1, s12), v3_scale(s.t2, s22));
    f.g11 = (e.lambda * s.b.b11 + s.l1_l2) * s.inv_d;
    f.g12 = e.lambda * s.b.b12 * s.inv_d;
    f.g22 = (e.lambda * s.b.b22 + s.l1_l2) * s.inv_d;
    f.lambda = e.lambda;
    f.ab = e.lambda * s.root * s.inv_d;
    f.nu = e.nu;
    f.k1 = s11 * i1 + s12 * i2;
    f.k2 = s12 * i1 + s22 * i2;
    return f;
}

K_FN ggx_horizon_back ggx_horizon_back_of_shape(ggx_horizon_shape s) {
    ggx_horizon_back back;
    back.d1 = v3_add(v3_scale(s.t1, s.m11), v3_scale(s.t2, s.b.b12));
    back.d2 = v3_add(v3_scale(s.t1, s.b.b12), v3_scale(s.t2, s.m22));
    return back;
}

K_FN ggx_horizon_eigen ggx_horizon_eigen_of(ggx_useful u) {
    ggx_horizon_eigen e;
    e.n = u.axis;
    e.nu = u.nu;
    e.lambda = u.lambda;
    e.lambda_minus_zz = u.lambda_minus_r;
    e.sum = u.lambda_minus_r + u.cx + u.cy;
    e.det = u.det;
    return e;
}

/* The disk of the reflections above the surface. */
K_FN ggx_horizon_disk ggx_horizon_disk_of(ggx_useful u) {
    ggx_horizon_eigen e = ggx_horizon_eigen_of(u);
    return ggx_horizon_disk_of_shape(ggx_horizon_shape_of(ggx_horizon_form_of(u), e), e, u.i);
}

/* z of a point with v = 1 - s, y = sqrt(s) e */
K_FN real ggx_horizon_disk_z(ggx_horizon_disk f, real v, real s, ggx_horizon_angle e) {
    return k_sqrt(v + s * ((f.g11 * e.c + R(2.0) * f.g12 * e.s) * e.c + f.g22 * e.s * e.s));
}

#endif
