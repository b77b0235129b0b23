/* kernel/ggx_horizon_plane_ellipse.h: two planes without a table: exactly uniform over the smaller of
 * their two ellipses; what the other plane cuts off is rejected. `horizon-mirror` where the geometric
 * plane is not the shading plane.
 *
 * With 1/(a b)^2 = (1 + l1/L)(1 + l2/L) the area pi a b nu follows from L, trace and determinant. The
 * ellipse of the geometric plane may reach below m_z = 0: those normals do not exist, D = 0 there. */
#ifndef K_GGX_HORIZON_PLANE_ELLIPSE_H
#define K_GGX_HORIZON_PLANE_ELLIPSE_H

#include "ggx_horizon_mirror.h"
#include "ggx_horizon_plane.h"

K_STRUCT(ggx_horizon_plane_ellipse) {
    ggx_horizon_set set;
    ggx_horizon_disk f;
    kint geometric; /* the ellipse is that of the geometric plane */
};

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

K_FN ggx_horizon_plane_ellipse ggx_horizon_plane_ellipse_prepare(ggx_base g) {
    ggx_useful u = ggx_useful_of(g);
    ggx_horizon_plane_form geometric = ggx_horizon_plane_geometric(g);
    ggx_horizon_plane_terms t = ggx_horizon_plane_terms_of(g, geometric);
    ggx_horizon_form q = ggx_horizon_plane_matrix(g, geometric, t);
    ggx_horizon_eigen lower = ggx_horizon_plane_eigen(g, geometric, t, q.zz);
    ggx_horizon_eigen upper = ggx_horizon_eigen_of(u);
    bool smaller = ggx_horizon_plane_area2(lower) < ggx_horizon_plane_area2(upper);
    ggx_horizon_form plain = ggx_horizon_form_of(u);
    q.xx = k_select(smaller, q.xx, plain.xx);
    q.yy = k_select(smaller, q.yy, plain.yy);
    q.zz = k_select(smaller, q.zz, plain.zz);
    q.xy = k_select(smaller, q.xy, plain.xy);
    q.xz = k_select(smaller, q.xz, plain.xz);
    q.yz = k_select(smaller, q.yz, plain.yz);
    ggx_horizon_eigen e = ggx_horizon_plane_choice(smaller, lower, upper);
    ggx_horizon_plane_ellipse s;
    s.geometric = k_flag(smaller);
    s.f = ggx_horizon_disk_of_shape(ggx_horizon_shape_of(q, e), e, g.i_std);
    s.set = ggx_horizon_set_of(g, s.f.lambda, s.f.ab, g.i_std.z);
    return s;
}

/* As `horizon-mirror` draws. */
K_FN facet_draw ggx_horizon_plane_ellipse_draw(ggx_horizon_plane_ellipse s, real u1, real u2,
                                               real u3) {
    v3 h = ggx_horizon_mirror_normal(s.f, u1, u2, u3).h;
    return ggx_horizon_draw_of(s.set, ggx_pair_of_stretched(s.set.g, h), R(1.0) / s.f.nu);
}

/* Density over directions, continued to reflections that do not leave. */
K_FN real ggx_horizon_plane_ellipse_pdf(ggx_horizon_plane_ellipse s, facet_pair pair) {
    return s.set.pdf_scale * pair.d / s.f.nu;
}

/* The reflection about a normal of the ellipse lies above the plane whose ellipse it is. */
K_FN real ggx_horizon_plane_ellipse_pdf_m(ggx_horizon_plane_ellipse s, facet_pair pair) {
    bool above = k_select(k_is(s.geometric), v3_dot(pair.wo, s.set.g.plane), pair.wo.z) > R(0.0);
    bool inside = k_and(pair.cos_im > R(0.0), k_or(above, pair.leaves));
    real pdf = ggx_horizon_plane_ellipse_pdf(s, pair);
    return k_select(inside, ggx_horizon_density_m(pair, pdf), R(0.0));
}

/* The smaller ellipse has an area in closed form, what both planes leave has not. */
K_FN real ggx_horizon_plane_ellipse_acceptance(ggx_horizon_plane_ellipse s) {
    return R(-1.0);
}

/* Worst errors of a draw in float, 2 10^6 random inputs as in kernel/ggx_horizon_plane_table.h; two draws whose
 * u3 lay within rounding of the choice between y and -y are left out.
 * wo:  6.6e-06 at wi (0x1.276174p-2, -0x1.76473ap-1, 0x1.3c9e6p-1),
 *      plane (0x1.09903p-2, -0x1.600cb8p-1, 0x1.5b3cdcp-1), alpha (0x1.d7f424p-1, 0x1.653f28p-4),
 *      u (0x1.bf5078p-3, 0x1.a9b206p-1, 0x1.ca5d2cp-1); one in 1000 above 1e-06
 * pdf: 4.0e-06 relative at wi (0x1.856e7ap-1, -0x1.4a7bf2p-1, 0x1.1ccb3p-4),
 *      plane (0x1.59547ep-1, 0x1.2cd976p-3, 0x1.72739p-1), alpha (0x1.cbb79ep-5, 0x1.e5dae4p+0),
 *      u (0x1.291a5p-1, 0x1.99a64ap-1, 0x1.67e86cp-1); one in 1000 above 1.2e-06 */

#endif
