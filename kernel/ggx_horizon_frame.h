/* kernel/ggx_horizon_frame.h: the useful normals of one half-space, seen as an ellipse.
 *
 * A reflection lies above a plane iff its stretched normal m (unit) satisfies m^T Q m >= 0 for a
 * symmetric Q with one positive eigenvalue L (kernel/ggx_useful.h). In the eigenframe (n, e1, e2) with
 * the eigenvalues (L, -l1, -l2) and on the unit sphere that reads
 *     (L + l1) w1^2 + (L + l2) w2^2 <= L:
 * seen along n an ellipse with the half axes a = sqrt(L/(L + l1)), b = sqrt(L/(L + l2)). With y in the
 * unit disk, v = 1 - |y|^2, g1 = 1 - a^2, g2 = 1 - b^2:
 *     m = a y1 e1 + b y2 e2 + z n,   z^2 = v + g1 y1^2 + g2 y2^2,   m^T Q m = L v
 *     density of the visible normals, in dy/pi over the disk:  1 + (k.y)/z,  k = (a i.e1, b i.e2)/nu
 *     area in the disk across i:  pi a b nu,  nu = n.i
 *
 * The basis (t1, t2) about n is the one of z carried along the great circle from z to n: continuous
 * wherever n_z > 0, and that is always so. e1 and e2 are that basis turned by an angle psi, which jumps
 * by half a turn somewhere on every way round a direction where l1 = l2. Samplers therefore take the
 * angle 2 pi u1 in the basis (t1, t2) (ggx_horizon_turned): e1 -> -e1, e2 -> -e2 then changes
 * nothing. */
#ifndef K_GGX_HORIZON_FRAME_H
#define K_GGX_HORIZON_FRAME_H

#include "ggx_useful.h"
#include "trig.h"

/* Q, symmetric. */
K_STRUCT(ggx_horizon_form) {
    real xx;
    real yy;
    real zz;
    real xy;
    real xz;
    real yz;
};

K_STRUCT(ggx_horizon_frame) {
    v3 n;
    v3 e1;
    v3 e2;
    real turn_c; /* cosine and sine of psi: e1 = c t1 + s t2, e2 = c t2 - s t1 */
    real turn_s;
    real lambda;
    real a; /* a <= b */
    real b;
    real g1; /* 1 - a^2 and 1 - b^2, without cancellation */
    real g2;
    real nu;
    real k1;
    real k2;
};

/* A point of the unit circle; all its directions about n. */
K_STRUCT(ggx_horizon_angle) {
    real c;
    real s;
};

/* -Q across n, inv = 1/(1 + n_z), in the basis t_j = x_j - h_j (n + z), h_j = n_j/(1 + n_z). Since Q n = L n,
 *     B_jk = L h_j h_k - q_j^T Q q_k,   q_j = x_j - h_j z,
 * and for the horizon's form every term of it is positive. */
K_STRUCT(ggx_horizon_across) {
    real b11;
    real b12;
    real b22;
    real h1;
    real h2;
};

K_FN ggx_horizon_across ggx_horizon_across_of(ggx_horizon_form q, v3 n, real inv,
                                              real lambda_minus_zz) {
    ggx_horizon_across f;
    f.h1 = n.x * inv;
    f.h2 = n.y * inv;
    f.b11 = R(2.0) * f.h1 * q.xz + lambda_minus_zz * f.h1 * f.h1 - q.xx;
    f.b22 = R(2.0) * f.h2 * q.yz + lambda_minus_zz * f.h2 * f.h2 - q.yy;
    f.b12 = f.h1 * q.yz + f.h2 * q.xz + lambda_minus_zz * f.h1 * f.h2 - q.xy;
    return f;
}

/* The ellipse of a form: its positive eigenvalue, the unit eigenvector n (n_z > 0), L - zz and det Q, the
 * last two from whoever knows how they do not cancel; i is the stretched wi, nu = n.i. */
K_FN ggx_horizon_frame ggx_horizon_frame_of_form(ggx_horizon_form q, v3 n, real lambda,
                                                 real lambda_minus_zz, real det, v3 i, real nu) {
    real inv_both = R(1.0) / ((R(1.0) + n.z) * nu);
    real inv_nu = (R(1.0) + n.z) * inv_both;
    ggx_horizon_across f = ggx_horizon_across_of(q, n, nu * inv_both, lambda_minus_zz);
    real gap = R(0.5) * (f.b11 - f.b22);
    real radius2 = gap * gap + f.b12 * f.b12;
    real radius = k_sqrt(radius2);
    real l1 = k_max(R(0.5) * (f.b11 + f.b22) + radius, K_TINY);
    real sum1 = lambda + l1;
    real inv_all = R(1.0) / (lambda * l1 * sum1);
    real inv_sum1 = lambda * l1 * inv_all;
    real l2 = k_min(k_max(det * sum1 * inv_all, R(0.0)), l1);
    real inv_sum2 = R(1.0) / (lambda + l2);

    /* half of the angle whose cosine and sine are gap/radius and b12/radius, up to half a turn; any angle
     * where those are 0 */
    real along = radius + k_abs(gap);
    bool turns = radius2 > K_TINY;
    bool steep = gap < R(0.0);
    real x = k_select(turns, k_select(steep, f.b12, along), R(1.0));
    real y = k_select(turns, k_select(steep, along, f.b12), R(0.0));
    real inv_norm = R(1.0) / k_sqrt(x * x + y * y);

    ggx_horizon_frame e;
    e.turn_c = x * inv_norm;
    e.turn_s = y * inv_norm;
    v3 t1 = v3_of(R(1.0) - f.h1 * n.x, -f.h1 * n.y, -n.x);
    v3 t2 = v3_of(t1.y, R(1.0) - f.h2 * n.y, -n.y);
    e.n = n;
    e.e1 = v3_add(v3_scale(t1, e.turn_c), v3_scale(t2, e.turn_s));
    e.e2 = v3_sub(v3_scale(t2, e.turn_c), v3_scale(t1, e.turn_s));

    e.lambda = lambda;
    e.a = k_sqrt(lambda * inv_sum1);
    e.b = k_sqrt(lambda * inv_sum2);
    e.g1 = l1 * inv_sum1;
    e.g2 = l2 * inv_sum2;
    e.nu = nu;
    e.k1 = e.a * v3_dot(i, e.e1) * inv_nu;
    e.k2 = e.b * v3_dot(i, e.e2) * inv_nu;
    return e;
}

K_FN ggx_horizon_form ggx_horizon_form_of(ggx_useful u) {
    ggx_horizon_form q;
    q.xx = -u.cx;
    q.yy = -u.cy;
    q.zz = u.r;
    q.xy = R(0.0);
    q.xz = u.i.x;
    q.yz = u.i.y;
    return q;
}

/* The ellipse of the reflections above the surface. */
K_FN ggx_horizon_frame ggx_horizon_frame_of(ggx_useful u) {
    return ggx_horizon_frame_of_form(ggx_horizon_form_of(u), u.axis, u.lambda, u.lambda_minus_r,
                                     u.det, u.i, u.nu);
}

/* The direction at angle 2 pi u1 of the continuous basis, seen from (e1, e2). */
K_FN ggx_horizon_angle ggx_horizon_turned(ggx_horizon_frame f, real u1) {
    k_sincos phi = k_sincos_2pi(u1);
    ggx_horizon_angle e;
    e.c = f.turn_c * phi.c + f.turn_s * phi.s;
    e.s = f.turn_c * phi.s - f.turn_s * phi.c;
    return e;
}

#endif
