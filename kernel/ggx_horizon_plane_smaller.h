/* kernel/ggx_horizon_plane_smaller.h: two planes without a table: the smaller of their two ellipses. A sampler
 * draws within it, and what the other plane cuts off is rejected.
 *
 * With 1/(a b)^2 = (1 + l1/L)(1 + l2/L) the area pi a b nu follows from L, trace and determinant. The
 * ellipse of the geometric plane may reach below m_z = 0: those normals do not exist, D = 0 there. */
#ifndef K_GGX_HORIZON_PLANE_SMALLER_H
#define K_GGX_HORIZON_PLANE_SMALLER_H

#include "ggx_horizon_disk.h"
#include "ggx_horizon_plane.h"

/* (pi a b nu)^2 up to pi^2 */
K_FN real ggx_horizon_plane_area2(ggx_horizon_eigen e) {
    real across = e.lambda * (e.lambda + e.sum) + e.det / e.lambda;
    return k_square(e.nu * e.lambda) / k_max(across, K_TINY);
}

K_FN ggx_horizon_eigen ggx_horizon_plane_eigen(ggx_base g, ggx_horizon_plane_form q,
                                               ggx_horizon_plane_terms t, real zz) {
    ggx_horizon_plane_axis axis = ggx_horizon_plane_axis_of(g, q, t, ggx_horizon_plane_above(g));
    ggx_horizon_eigen e;
    e.n = axis.n;
    e.nu = v3_dot(axis.n, g.i_std);
    e.lambda = axis.lambda;
    e.lambda_minus_zz = axis.lambda - zz;
    e.sum = axis.lambda - t.trace;
    e.det = q.c * k_square(g.ax * g.ay / g.t_i); /* of one plane it is a product */
    return e;
}

K_FN ggx_horizon_eigen ggx_horizon_plane_choice(bool first, ggx_horizon_eigen a,
                                                ggx_horizon_eigen b) {
    ggx_horizon_eigen e;
    e.n = v3_select(first, a.n, b.n);
    e.nu = k_select(first, a.nu, b.nu);
    e.lambda = k_select(first, a.lambda, b.lambda);
    e.lambda_minus_zz = k_select(first, a.lambda_minus_zz, b.lambda_minus_zz);
    e.sum = k_select(first, a.sum, b.sum);
    e.det = k_select(first, a.det, b.det);
    return e;
}

/* The smaller of the two ellipses. */
K_STRUCT(ggx_horizon_plane_smaller) {
    ggx_horizon_form q;
    ggx_horizon_eigen e;
    bool geometric; /* it is that of the geometric plane */
};

K_FN ggx_horizon_plane_smaller ggx_horizon_plane_smaller_of(ggx_base g) {
    ggx_useful u = ggx_useful_of(g);
    ggx_horizon_plane_form geometric = ggx_horizon_plane_geometric(g);
    ggx_horizon_plane_terms t = ggx_horizon_plane_terms_of(g, geometric);
    ggx_horizon_form lower_form = ggx_horizon_plane_matrix(g, geometric, t);
    ggx_horizon_form upper_form = ggx_horizon_form_of(u);
    ggx_horizon_eigen lower = ggx_horizon_plane_eigen(g, geometric, t, lower_form.zz);
    ggx_horizon_eigen upper = ggx_horizon_eigen_of(u);
    bool is_lower = ggx_horizon_plane_area2(lower) < ggx_horizon_plane_area2(upper);
    ggx_horizon_plane_smaller s;
    s.geometric = is_lower;
    s.e = ggx_horizon_plane_choice(is_lower, lower, upper);
    s.q.xx = k_select(is_lower, lower_form.xx, upper_form.xx);
    s.q.yy = k_select(is_lower, lower_form.yy, upper_form.yy);
    s.q.zz = k_select(is_lower, lower_form.zz, upper_form.zz);
    s.q.xy = k_select(is_lower, lower_form.xy, upper_form.xy);
    s.q.xz = k_select(is_lower, lower_form.xz, upper_form.xz);
    s.q.yz = k_select(is_lower, lower_form.yz, upper_form.yz);
    return s;
}

/* How far wo lies above the plane whose ellipse it is. */
K_FN real ggx_horizon_plane_height(ggx_base g, bool geometric, v3 wo) {
    return k_select(geometric, v3_dot(wo, g.plane), wo.z);
}

/* Whether the sampler can draw this normal, of a reflection that may not leave. */
K_FN bool ggx_horizon_plane_draws(facet_pair pair, real height) {
    return k_and(pair.cos_im > R(0.0), k_or(height > R(0.0), pair.leaves));
}

#endif
