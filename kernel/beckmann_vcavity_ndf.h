/* kernel/beckmann_vcavity_ndf.h: Beckmann V-cavities by all normals, D(m) m_z (Walter et al. 2007,
 * eq. 28-29). The reference for the others. */
#ifndef K_BECKMANN_VCAVITY_NDF_H
#define K_BECKMANN_VCAVITY_NDF_H

#include "beckmann_vcavity_family.h"
#include "log.h"
#include "trig.h"

K_STRUCT(beckmann_vcavity_ndf) {
    beckmann_vcavity_base g;
};

K_FN beckmann_vcavity_ndf beckmann_vcavity_ndf_prepare(beckmann_vcavity_base g) {
    beckmann_vcavity_ndf s;
    s.g = g;
    return s;
}

/* Not by the pair's D: from below normals that face away have none. */
K_FN real beckmann_vcavity_ndf_pdf_m(beckmann_vcavity_ndf s, facet_pair pair) {
    return beckmann_d(pair.m, s.g.ax, s.g.ay) * k_max(pair.m.z, R(0.0));
}

K_FN real beckmann_vcavity_ndf_pdf(beckmann_vcavity_ndf s, facet_pair pair) {
    return vcavity_ndf_pdf(pair, beckmann_vcavity_ndf_pdf_m(s, pair));
}

/* From below all that faces i leaves, half of erfc(a); else no closed form is known. */
K_FN real beckmann_vcavity_ndf_acceptance(beckmann_vcavity_ndf s) {
    bool all = k_and(s.g.wi.z <= R(0.0), !k_is(s.g.tilted));
    return k_select(all, R(0.5) * k_erfc(s.g.a), R(-1.0));
}

K_FN facet_draw beckmann_vcavity_ndf_draw(beckmann_vcavity_ndf s, real u1, real u2, real u3) {
    real radius = k_sqrt(k_max(-k_log(R(1.0) - u1), R(0.0)));
    k_sincos phi = k_sincos_2pi(u2);
    v3 m = beckmann_normal_of_slopes(s.g.beckmann, -radius * phi.c, -radius * phi.s);
    facet_pair pair = beckmann_pair_of_m(s.g.beckmann, m);
    real pdf_m = beckmann_vcavity_ndf_pdf_m(s, pair);
    return vcavity_draw_of(s.g.cavity, k_is(s.g.valid), pair, pdf_m, vcavity_ndf_pdf(pair, pdf_m));
}

/* Worst errors of a draw in float, 5 10^6 random inputs (tools/numerics/vcavity_error.c: roughness 0.01 to
 * 2, u2 up to 0.98, either side, H above 1e-8). The rounding
 * of a small i.m is what shows.
 * wo:  6.7e-07 at wi (-0x1.24128ap-3, -0x1.9d47fep-1, 0x1.2546bcp-1),
 *      alpha (0x1.35dadcp-6, 0x1.fea77p+0) u (0x1.8c624ap-1, 0x1.42b4fp-1)
 * pdf: 0.0049 relative at wi (-0x1.e34ff2p-2, -0x1.92cd16p-1, -0x1.976b4p-2),
 *      alpha (0x1.14b27ap-1, 0x1.9b5004p+0) u (0x1.9cb1fp-3, 0x1.b6118cp-1) */

#endif
