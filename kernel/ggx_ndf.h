/* kernel/ggx_ndf.h: all normals by their area seen from above, D(m) m_z (Walter et al. 2007, eq. 35-36).
 * Nearly half of them are wasted at grazing incidence, and the weight
 * 2 G2/G1 <i,m> / (V(i) m_z) is unbounded: the reference that the others are compared with. */
#ifndef K_GGX_NDF_H
#define K_GGX_NDF_H

#include "ggx.h"
#include "trig.h"

K_STRUCT(ggx_ndf) {
    ggx_base g;
};

K_FN ggx_ndf ggx_ndf_prepare(ggx_base g) {
    ggx_ndf s;
    s.g = g;
    return s;
}

K_FN real ggx_ndf_pdf_m(ggx_ndf s, facet_pair pair) {
    return pair.d * k_max(pair.m.z, R(0.0));
}

K_FN real ggx_ndf_pdf(ggx_ndf s, facet_pair pair) {
    return ggx_ndf_pdf_m(s, pair) / (R(4.0) * k_max(pair.cos_im, K_TINY));
}

/* With roughness 1 D is constant: D m_z is the cosine-weighted hemisphere. */
K_FN facet_draw ggx_ndf_draw(ggx_ndf s, real u1, real u2, real u3) {
    real radius = k_sqrt(u1);
    k_sincos phi = k_sincos_2pi(u2);
    v3 h = v3_of(radius * phi.c, radius * phi.s, k_sqrt(R(1.0) - u1));
    facet_pair pair = ggx_pair_of_stretched(s.g, h);
    return ggx_draw_of(s.g, pair, ggx_ndf_pdf_m(s, pair), ggx_ndf_pdf(s, pair));
}

/* No closed form is known. */
K_FN real ggx_ndf_acceptance(ggx_ndf s) {
    return R(-1.0);
}

/* Worst errors of a draw in float, 2 10^7 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side). The density is
 * D m_z/(4 i.m): from behind i.m is small and its rounding is what shows.
 * wo:  7.1e-07 at wi (-0x1.7b3258p-1, 0x1.6cbb32p-4, 0x1.54fddep-1),
 *      alpha (0x1.2ac13ep+0, 0x1.de2accp-3) u (0x1.46cb06p-1, 0x1.69db22p-2)
 * pdf: 0.0088 relative at wi (0x1.af97bap-1, -0x1.ebd78p-2, -0x1.f04d2p-3),
 *      alpha (0x1.90086ep+0, 0x1.b15fd6p-1) u (0x1.f365d2p-1, 0x1.69e194p-1) */

#endif
