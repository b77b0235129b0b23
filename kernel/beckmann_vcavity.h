/* kernel/beckmann_vcavity.h: visible normals of Beckmann V-cavities (Heitz & d'Eon 2014 above the horizon, Tokuyoshi
 * 2021, section 2.3 below it). From above one of the two sides of a groove, in proportion to what i
 * sees of them; from below one side at most is seen. */
#ifndef K_BECKMANN_VCAVITY_H
#define K_BECKMANN_VCAVITY_H

#include "beckmann_vcavity_groove.h"
#include "vcavity_side.h"

K_STRUCT(beckmann_vcavity) {
    beckmann_vcavity_groove groove;
};

K_FN beckmann_vcavity beckmann_vcavity_prepare(beckmann_vcavity_base g) {
    beckmann_vcavity s;
    s.groove = beckmann_vcavity_groove_of(g);
    return s;
}

K_FN real beckmann_vcavity_pdf(beckmann_vcavity s, facet_pair pair) {
    return vcavity_any_side_pdf(s.groove.g.cavity, pair);
}

K_FN real beckmann_vcavity_pdf_m(beckmann_vcavity s, facet_pair pair) {
    return vcavity_pdf_m_of(pair, beckmann_vcavity_pdf(s, pair));
}

K_FN real beckmann_vcavity_acceptance(beckmann_vcavity s) {
    return vcavity_acceptance(s.groove.g.cavity);
}

K_FN facet_draw beckmann_vcavity_draw(beckmann_vcavity s, real u1, real u2, real u3) {
    facet_pair side = beckmann_vcavity_groove_draw(s.groove, u1, u2, u3);
    facet_pair pair = vcavity_any_side(s.groove.g.cavity, side, u3);
    real pdf = beckmann_vcavity_pdf(s, pair);
    return vcavity_draw_of(s.groove.g.cavity, k_is(s.groove.g.valid), pair,
                           vcavity_pdf_m_of(pair, pdf), pdf);
}

/* Worst errors of a draw in float, 5 10^6 random inputs (tools/numerics/vcavity_error.c: roughness 0.01 to
 * 2, u2 up to 0.98, either side, H above 1e-8).
 * wo:  7.2e-07 at wi (0x1.aa7ecap-4, 0x1.4d645ep-1, 0x1.80e798p-1),
 *      alpha (0x1.af73b2p+0, 0x1.97665ep-2) u (0x1.e9554p-5, 0x1.5f48f8p-5, 0x1.5ce7c6p-1)
 * pdf: 7.5e-06 relative (3 10^5 inputs) at wi (0x1.6a6646p-1, 0x1.03af34p-1, -0x1.f77c8p-2),
 *      alpha (0x1.514a24p-4, 0x1.11d1a4p-2) u (0x1.ed2e6p-2, 0x1.a1a8e4p-1, 0x1.9bb74p-2) */

#endif
