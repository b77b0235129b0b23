/* kernel/ggx_horizon_plane_uniform.h: `horizon-uniform` where the geometric plane is not the shading plane:
 * uniform within half a per cent over the smaller ellipse (kernel/ggx_horizon_plane_smaller.h), by a
 * continuous map. */
#ifndef K_GGX_HORIZON_PLANE_UNIFORM_H
#define K_GGX_HORIZON_PLANE_UNIFORM_H

#include "ggx_horizon_plane_smaller.h"
#include "ggx_horizon_uniform.h"

K_STRUCT(ggx_horizon_plane_uniform) {
    ggx_horizon_uniform within;
    kint geometric; /* the ellipse is that of the geometric plane */
};

K_FN ggx_horizon_plane_uniform ggx_horizon_plane_uniform_prepare(ggx_base g) {
    ggx_horizon_plane_smaller smaller = ggx_horizon_plane_smaller_of(g);
    ggx_horizon_plane_uniform s;
    /* wi is always on the front of the geometric plane */
    real front = k_select(smaller.geometric, R(1.0), g.i_std.z);
    s.within = ggx_horizon_uniform_of(g, smaller.q, smaller.e, g.i_std, front);
    s.geometric = k_flag(smaller.geometric);
    return s;
}

K_FN facet_draw ggx_horizon_plane_uniform_draw(ggx_horizon_plane_uniform s, real u1, real u2,
                                               real u3) {
    ggx_horizon_set set = s.within.set;
    ggx_horizon_shifted m = ggx_horizon_uniform_normal(s.within, u1, u2);
    facet_pair pair = ggx_pair_of_stretched(set.g, m.h);
    return ggx_horizon_draw_of(set, pair, ggx_horizon_spread(m.p_y, m.z, m.im));
}

/* Density over directions, continued to reflections that the other plane cuts off. */
K_FN real ggx_horizon_plane_uniform_pdf(ggx_horizon_plane_uniform s, facet_pair pair) {
    ggx_horizon_set set = s.within.set;
    real height = ggx_horizon_plane_height(set.g, k_is(s.geometric), pair.wo);
    real spread = ggx_horizon_uniform_spread(s.within, pair, height);
    return k_select(ggx_horizon_plane_draws(pair, height), set.pdf_scale * pair.d * spread, R(0.0));
}

K_FN real ggx_horizon_plane_uniform_pdf_m(ggx_horizon_plane_uniform s, facet_pair pair) {
    return ggx_horizon_density_m(pair, ggx_horizon_plane_uniform_pdf(s, pair));
}

K_FN real ggx_horizon_plane_uniform_acceptance(ggx_horizon_plane_uniform s) {
    return R(-1.0);
}

/* Worst errors of a draw in float, 2 10^6 random inputs as in kernel/ggx_horizon_plane_table.h
 * (tools/numerics/plane_error.c); two draws where both ellipses have the same area but for rounding are left
 * out.
 * wo:  1.1e-05 at wi (0x1.2ac206p-1, -0x1.9cd448p-1, -0x1.8cc428p-4),
 *      plane (0x1.921116p-1, -0x1.5ad574p-3, 0x1.30e812p-1), alpha (0x1.308db8p-4, 0x1.34f3d6p+0),
 *      u (0x1.d9f03p-4, 0x1.d0e0ap-1); one in 1000 above 1.2e-06
 * pdf: 1.5e-05 relative at wi (-0x1.36e10ap-1, 0x1.50142ep-4, 0x1.94a3ccp-1),
 *      plane (-0x1.40da6cp-1, 0x1.8795ap-2, 0x1.5ba72cp-1), alpha (0x1.72d774p-3, 0x1.9006b8p-2),
 *      u (0x1.cc4f8ep-1, 0x1.de3d72p-18); one in 1000 above 1.4e-06 */

#endif
