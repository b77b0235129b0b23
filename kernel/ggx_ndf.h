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

K_FN real ggx_ndf_pdf_m(ggx_ndf s, ggx_pair pair) {
    return pair.d * k_max(pair.m.z, R(0.0));
}

K_FN real ggx_ndf_pdf(ggx_ndf s, ggx_pair pair) {
    return ggx_ndf_pdf_m(s, pair) / (R(4.0) * k_max(pair.cos_im, K_TINY));
}

/* With roughness 1 D is constant: D m_z is the cosine-weighted hemisphere. */
K_FN ggx_draw ggx_ndf_draw(ggx_ndf s, real u1, real u2, real u3) {
    real radius = k_sqrt(u1);
    k_sincos phi = k_sincos_2pi(u2);
    v3 h = v3_of(radius * phi.c, radius * phi.s, k_sqrt(R(1.0) - u1));
    ggx_pair pair = ggx_pair_of_stretched(s.g, h);
    return ggx_draw_of(s.g, pair, ggx_ndf_pdf_m(s, pair), ggx_ndf_pdf(s, pair));
}

/* No closed form is known. */
K_FN real ggx_ndf_acceptance(ggx_ndf s) {
    return R(-1.0);
}

#endif
