/* kernel/ggx_ellipsoid.h: visible normals as points of a projected ellipsoid (Heitz 2018): a point of
 * the unit disk, squeezed to the part of the hemisphere that i sees, lifted back. Valid for either
 * sign of i_z. The basis across i is arbitrary at normal incidence, so the map (u, i) -> m has a seam
 * there; the caps have none. */
#ifndef K_GGX_ELLIPSOID_H
#define K_GGX_ELLIPSOID_H

#include "crescent.h"
#include "ggx_visible.h"

K_STRUCT(ggx_ellipsoid) {
    ggx_base g;
    ggx_visible visible;
    facet_azimuth azimuth;
};

K_FN ggx_ellipsoid ggx_ellipsoid_prepare(ggx_base g) {
    ggx_ellipsoid s;
    s.g = g;
    s.visible = ggx_visible_of(g, g.one_plus_z);
    s.azimuth = facet_azimuth_of(g.i_std);
    return s;
}

K_FN real ggx_ellipsoid_pdf(ggx_ellipsoid s, facet_pair pair) {
    return ggx_visible_pdf(s.visible, pair);
}

K_FN real ggx_ellipsoid_pdf_m(ggx_ellipsoid s, facet_pair pair) {
    return ggx_visible_pdf_m(s.visible, pair);
}

K_FN real ggx_ellipsoid_acceptance(ggx_ellipsoid s) {
    return ggx_visible_acceptance(s.g, s.visible);
}

K_FN facet_draw ggx_ellipsoid_draw(ggx_ellipsoid s, real u1, real u2, real u3) {
    v3 p = crescent_point(R(0.5) * s.g.one_plus_z, R(0.5) * s.g.one_minus_z, u1, u2);
    v3 across_x = v3_of(-s.azimuth.y, s.azimuth.x, R(0.0));
    v3 across_y = v3_of(-s.g.i_std.z * s.azimuth.x, -s.g.i_std.z * s.azimuth.y, s.azimuth.rho);
    v3 h = v3_combine(across_x, p.x, across_y, p.y, s.g.i_std, p.z);
    h.z = k_max(h.z, R(0.0));
    return ggx_visible_draw(s.g, s.visible, ggx_pair_of_stretched(s.g, h));
}

/* Worst errors of a draw in float, 2 10^7 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side).
 * wo:  5.9e-05 at wi (0x1.2adb46p-1, 0x1.f4a1d2p-2, -0x1.4beb6cp-1),
 *      alpha (0x1.6069dcp-5, 0x1.69d928p+0) u (0x1.ffc8ccp-1, 0x1.03222ap-1)
 * pdf: 1.2e-06 relative at wi (-0x1.967aa8p-1, -0x1.0a946ap-1, -0x1.419558p-2),
 *      alpha (0x1.0fd61ap+0, 0x1.0fd61ap+0) u (0x1.e87254p-2, 0x1.572904p-1) */

#endif
