/* kernel/ggx_vcavity_ndf.h: V-cavities by all normals, D(m) m_z: the draws and densities of ggx_ndf.h,
 * weighted with the masking of V-cavities. The reference for the others. */
#ifndef K_GGX_VCAVITY_NDF_H
#define K_GGX_VCAVITY_NDF_H

#include "crescent.h"
#include "ggx_useful.h"
#include "ggx_vcavity_family.h"

K_STRUCT(ggx_vcavity_ndf) {
    ggx_vcavity_base g;
};

K_FN ggx_vcavity_ndf ggx_vcavity_ndf_prepare(ggx_vcavity_base g) {
    ggx_vcavity_ndf s;
    s.g = g;
    return s;
}

K_FN real ggx_vcavity_ndf_pdf_m(ggx_vcavity_ndf s, facet_pair pair) {
    return pair.d * k_max(pair.m.z, R(0.0));
}

K_FN real ggx_vcavity_ndf_pdf(ggx_vcavity_ndf s, facet_pair pair) {
    return vcavity_ndf_pdf(pair, ggx_vcavity_ndf_pdf_m(s, pair));
}

/* The useful normals fill an ellipse across n (kernel/ggx_useful.h); seen from z its area is
 * pi a b n_z, and nu = n.i = n_z (L - r + i_z). */
K_FN real ggx_vcavity_ndf_acceptance(ggx_vcavity_ndf s) {
    v3 i = s.g.ggx.i_std;
    real c = k_max(i.z, R(0.0));
    real l = ggx_useful_eigenvalue(i, c * s.g.ax * s.g.ax, c * s.g.ay * s.g.ay, R(2.0) * i.z - c);
    real n_z_over_nu = R(1.0) / k_select(i.z > R(0.0), l, l - i.z);
    return k_select(k_is(s.g.tilted), R(-1.0), ggx_useful_area(s.g.ggx) * n_z_over_nu);
}

K_FN facet_draw ggx_vcavity_ndf_draw(ggx_vcavity_ndf s, real u1, real u2, real u3) {
    v3 h = crescent_point(R(1.0), R(0.0), u1, u2);
    facet_pair pair = ggx_pair_of_stretched(s.g.ggx, h);
    real pdf_m = ggx_vcavity_ndf_pdf_m(s, pair);
    return vcavity_draw_of(s.g.cavity, k_is(s.g.valid), pair, pdf_m, vcavity_ndf_pdf(pair, pdf_m));
}

/* Worst errors of a draw in float, 5 10^6 random inputs (tools/numerics/vcavity_error.c: roughness 0.01 to
 * 2, u2 up to 0.98, either side). As in ggx_ndf.h the
 * rounding of a small i.m is what shows.
 * wo:  6.6e-07 at wi (-0x1.eda3fp-4, -0x1.cc1daep-1, 0x1.afe0f8p-2),
 *      alpha (0x1.713988p-3, 0x1.c0be54p+0) u (0x1.670ccep-1, 0x1.c3ab78p-1)
 * pdf: 0.0088 relative at wi (0x1.af97bap-1, -0x1.ebd78p-2, -0x1.f04d2p-3),
 *      alpha (0x1.90086ep+0, 0x1.b15fd6p-1) u (0x1.f365d2p-1, 0x1.69e194p-1) */

#endif
