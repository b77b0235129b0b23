/* kernel/beckmann_ndf.h: all normals by their area seen from above, D(m) m_z (Walter et al. 2007, eq. 28,
 * 29). Nearly half of them are wasted at grazing incidence, and the weight is unbounded: the reference that the
 * others are compared with. */
#ifndef K_BECKMANN_NDF_H
#define K_BECKMANN_NDF_H

#include "beckmann.h"
#include "log.h"
#include "trig.h"

K_STRUCT(beckmann_ndf) {
    beckmann_base g;
};

K_FN beckmann_ndf beckmann_ndf_prepare(beckmann_base g) {
    beckmann_ndf s;
    s.g = g;
    return s;
}

/* Not by the pair's D: from below normals that face away have none. */
K_FN real beckmann_ndf_pdf_m(beckmann_ndf s, facet_pair pair) {
    return beckmann_d(pair.m, s.g.ax, s.g.ay) * k_max(pair.m.z, R(0.0));
}

K_FN real beckmann_ndf_pdf(beckmann_ndf s, facet_pair pair) {
    return beckmann_ndf_pdf_m(s, pair) / (R(4.0) * k_max(pair.cos_im, K_TINY));
}

K_FN facet_draw beckmann_ndf_draw(beckmann_ndf s, real u1, real u2, real u3) {
    real radius = k_sqrt(k_max(-k_log(R(1.0) - u1), R(0.0)));
    k_sincos phi = k_sincos_2pi(u2);
    v3 m = beckmann_normal_of_slopes(s.g, -radius * phi.c, -radius * phi.s);
    facet_pair pair = beckmann_pair_of_m(s.g, m);
    return beckmann_draw_of(s.g, pair, beckmann_ndf_pdf_m(s, pair), beckmann_ndf_pdf(s, pair));
}

/* No closed form is known. */
K_FN real beckmann_ndf_acceptance(beckmann_ndf s) {
    return R(-1.0);
}

/* Worst errors of a draw in float, 3 10^5 random inputs (tools/numerics/beckmann_error.c: roughness 0.01 to 2,
 * either side, c above -10).
 * wo:  5.6e-07 at wi (0x1.cde14p-1, 0x1.a20296p-2, 0x1.1e6fd8p-3),
 *      alpha (0x1.8ae42ep-1, 0x1.8ae42ep-1) u (0x1.e73f7ep-1, 0x1.da658p-4)
 * pdf: 0.0061 relative at wi (-0x1.726426p-3, 0x1.afefe4p-1, -0x1.02d7f8p-1),
 *      alpha (0x1.08406p+0, 0x1.08406p+0) u (0x1.1ad11p-2, 0x1.2b73dp-2): i.m is small there */

#endif
