/* kernel/ggx_horizon_plane_ellipse.h: `horizon-mirror` where the geometric plane is not the shading plane:
 * exactly uniform over the smaller ellipse (kernel/ggx_horizon_plane_smaller.h). */
#ifndef K_GGX_HORIZON_PLANE_ELLIPSE_H
#define K_GGX_HORIZON_PLANE_ELLIPSE_H

#include "ggx_horizon_mirror.h"
#include "ggx_horizon_plane_smaller.h"

K_STRUCT(ggx_horizon_plane_ellipse) {
    ggx_horizon_set set;
    ggx_horizon_disk f;
    kint geometric; /* the ellipse is that of the geometric plane */
};

K_FN ggx_horizon_plane_ellipse ggx_horizon_plane_ellipse_prepare(ggx_base g) {
    ggx_horizon_plane_smaller smaller = ggx_horizon_plane_smaller_of(g);
    ggx_horizon_plane_ellipse s;
    s.geometric = k_flag(smaller.geometric);
    s.f = ggx_horizon_disk_of_shape(ggx_horizon_shape_of(smaller.q, smaller.e), smaller.e, g.i_std);
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

K_FN real ggx_horizon_plane_ellipse_pdf_m(ggx_horizon_plane_ellipse s, facet_pair pair) {
    real height = ggx_horizon_plane_height(s.set.g, k_is(s.geometric), pair.wo);
    real pdf = ggx_horizon_plane_ellipse_pdf(s, pair);
    return k_select(ggx_horizon_plane_draws(pair, height), ggx_horizon_density_m(pair, pdf),
                    R(0.0));
}

/* The smaller ellipse has an area in closed form, what both planes leave has not. */
K_FN real ggx_horizon_plane_ellipse_acceptance(ggx_horizon_plane_ellipse s) {
    return R(-1.0);
}

/* Worst errors of a draw in float, 2 10^6 random inputs as in kernel/ggx_horizon_plane_table.h; two draws whose
 * u3 lay within rounding of the choice between y and -y are left out.
 * wo:  9.9e-06 at wi (-0x1.33362cp-1, 0x1.f48ac6p-2, 0x1.443c98p-1),
 *      plane (-0x1.7c08a4p-1, -0x1.f38414p-7, 0x1.570324p-1), alpha (0x1.9a92f6p-5, 0x1.99c62ep-5),
 *      u (0x1.f70796p-1, 0x1.bd0116p-1, 0x1.ea47cep-1); one in 1000 above 1e-06
 * pdf: 3.9e-06 relative at wi (0x1.cc6f3cp-2, 0x1.b3496cp-1, -0x1.187edp-2),
 *      plane (0x1.37feap-1, 0x1.12b612p-1, 0x1.2ae4a4p-1), alpha (0x1.7912aap+0, 0x1.99e3a4p-5),
 *      u (0x1.7a2e04p-1, 0x1.019fcap-1, 0x1.2f6f74p-1); one in 1000 above 1.2e-06 */

#endif
