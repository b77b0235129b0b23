/* kernel/ggx_horizon_plane_ellipse.h: two planes without a table: exactly uniform over the smaller of
 * their two ellipses; what the other plane cuts off is rejected. `horizon-mirror` where the geometric
 * plane is not the shading plane.
 *
 * With 1/(a b)^2 = (1 + l1/L)(1 + l2/L) the area pi a b nu follows from L, trace and determinant. The
 * ellipse of the geometric plane may reach below m_z = 0: those normals do not exist, D = 0 there. */
#ifndef K_GGX_HORIZON_PLANE_ELLIPSE_H
#define K_GGX_HORIZON_PLANE_ELLIPSE_H

#include "ggx_horizon_plane.h"
#include "ggx_horizon_point.h"

K_STRUCT(ggx_horizon_plane_ellipse) {
    ggx_horizon_set set;
    kint geometric; /* the ellipse is that of the geometric plane */
};

/* a b nu, from L, L - trace, det and nu */
K_FN real ggx_horizon_plane_area(real lambda, real rest, real det, real nu) {
    return nu * lambda / k_sqrt(k_max(lambda * (lambda + rest) + det / lambda, K_TINY));
}

K_FN ggx_horizon_plane_ellipse ggx_horizon_plane_ellipse_prepare(ggx_base g) {
    ggx_useful u = ggx_useful_of(g);
    ggx_horizon_plane_form shading = ggx_horizon_plane_shading(g);
    ggx_horizon_plane_form geometric = ggx_horizon_plane_geometric(g);
    ggx_horizon_plane_terms t = ggx_horizon_plane_terms_of(g, geometric);
    t.det = geometric.c * k_square(g.ax * g.ay / g.t_i); /* of one plane it is a product */
    ggx_horizon_plane_axis axis =
        ggx_horizon_plane_axis_of(g, geometric, t, ggx_horizon_plane_above(g));
    real det = t.det;
    real nu = v3_dot(axis.n, g.i_std);
    real area = ggx_horizon_plane_area(axis.lambda, axis.lambda - t.trace, det, nu);
    real upper = ggx_horizon_plane_area(u.lambda, u.lambda_minus_r + u.cx + u.cy, u.det, u.nu);
    ggx_horizon_plane_ellipse s;
    bool smaller = area < upper;
    s.geometric = k_flag(smaller);
    ggx_horizon_plane_form q;
    q.h = v3_select(smaller, geometric.h, shading.h);
    q.c = k_select(smaller, geometric.c, shading.c);
    axis.n = v3_select(smaller, axis.n, u.axis);
    axis.lambda = k_select(smaller, axis.lambda, u.lambda);
    t = ggx_horizon_plane_terms_of(g, q);
    t.det = k_select(smaller, det, u.det);
    s.set = ggx_horizon_set_of_frame(g, ggx_horizon_plane_frame(g, q, t, axis), g.i_std.z);
    return s;
}

/* As `horizon-mirror` draws. */
K_FN facet_draw ggx_horizon_plane_ellipse_draw(ggx_horizon_plane_ellipse s, real u1, real u2,
                                               real u3) {
    ggx_horizon_frame f = s.set.f;
    ggx_horizon_angle e = ggx_horizon_turned(f, u1);
    real radius = k_sqrt(u2);
    real z = ggx_horizon_z(f, R(1.0) - u2, u2, e);
    real k_y = radius * (f.k1 * e.c + f.k2 * e.s);
    real side = radius * k_select(R(2.0) * u3 * z < z + k_y, R(1.0), R(-1.0));
    v3 h = v3_combine(f.e1, side * f.a * e.c, f.e2, side * f.b * e.s, f.n, z);
    return ggx_horizon_draw_of(s.set, ggx_pair_of_stretched(s.set.g, h), R(1.0) / f.nu);
}

/* Density over directions, continued to reflections that do not leave. */
K_FN real ggx_horizon_plane_ellipse_pdf(ggx_horizon_plane_ellipse s, facet_pair pair) {
    return s.set.pdf_scale * pair.d / s.set.f.nu;
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
