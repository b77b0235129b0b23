/* kernel/ggx_vcavity_groove.h: one side of a V-cavity, ready for the choice between the two sides.
 *
 * From above any normal by its area D(m) m_z will do. From below the visible normals fall in two parts
 * at the slope 3 cot(theta) along i (Tokuyoshi 2021, eq. 4-5): facets whose slope is below it are
 * partly masked and have the density 2 D(m) m_z/H, the others are seen whole and have Smith's.
 * In the stretched space each part is a crescent of a disk: across z for the first, across i_std for
 * the second (his listings 2 and 3). With a = |i_std.z|, R^2 = 1 + 8 a^2 his
 * 1 - cos(angle) become products:
 *     share of the first part    (R + 1)(1 + a) / (R (1 + R + 4 a))
 *     its squeeze                rho^2 / (2 R (R + 3 a))
 *     squeeze of the second      2 a^2 rho^2 / (R (R + 1 + 2 a^2)) */
#ifndef K_GGX_VCAVITY_GROOVE_H
#define K_GGX_VCAVITY_GROOVE_H

#include "crescent.h"
#include "ggx_vcavity_family.h"

K_STRUCT(ggx_vcavity_groove) {
    ggx_vcavity_base g;
    facet_azimuth azimuth;
    real masked_share;
    real masked_squeeze;
    real whole_squeeze;
};

K_FN ggx_vcavity_groove ggx_vcavity_groove_of(ggx_vcavity_base g) {
    real a = k_abs(g.ggx.i_std.z);
    real rho2 = g.ggx.rho2;
    real root = k_sqrt(R(1.0) + R(8.0) * a * a);
    real share = (root + R(1.0)) * (R(1.0) + a) / (root * (R(1.0) + root + R(4.0) * a));
    real masked = R(0.5) * rho2 / (root * (root + R(3.0) * a));
    bool behind = g.wi.z < R(0.0);
    ggx_vcavity_groove s;
    s.g = g;
    s.azimuth = facet_azimuth_of(g.ggx.i_std);
    s.masked_share = k_select(behind, share, R(1.0));
    s.masked_squeeze = k_select(behind, masked, R(1.0));
    s.whole_squeeze = R(2.0) * a * a * rho2 / (root * (root + R(1.0) + R(2.0) * a * a));
    return s;
}

/* u3 chooses the part; from above it is left for the choice of the side. */
K_FN facet_pair ggx_vcavity_groove_draw(ggx_vcavity_groove s, real u1, real u2, real u3) {
    bool masked = u3 < s.masked_share;
    real squeeze = k_select(masked, s.masked_squeeze, s.whole_squeeze);
    v3 p = crescent_point(squeeze, R(1.0) - squeeze, u1, u2);
    v3 i = s.g.ggx.i_std;
    v3 z = v3_select(masked, v3_of(R(0.0), R(0.0), R(1.0)), i);
    v3 x = v3_of(-s.azimuth.y, s.azimuth.x, R(0.0));
    v3 y = v3_select(masked, v3_of(s.azimuth.x, s.azimuth.y, R(0.0)),
                     v3_of(-i.z * s.azimuth.x, -i.z * s.azimuth.y, s.azimuth.rho));
    v3 h = v3_combine(x, p.x, y, p.y, z, p.z);
    h.z = k_max(h.z, R(0.0));
    return ggx_pair_of_stretched(s.g.ggx, h);
}

#endif
