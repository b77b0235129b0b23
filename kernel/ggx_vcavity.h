/* kernel/ggx_vcavity.h: visible normals of V-cavities (Heitz & d'Eon 2014 above the horizon, Tokuyoshi
 * 2021, section 2.3 below it). From above one of the two sides of a groove, in proportion to what i
 * sees of them; from below one side at most is seen. */
#ifndef K_GGX_VCAVITY_H
#define K_GGX_VCAVITY_H

#include "ggx_vcavity_groove.h"
#include "vcavity_side.h"

K_STRUCT(ggx_vcavity) {
    ggx_vcavity_groove groove;
};

K_FN ggx_vcavity ggx_vcavity_prepare(ggx_vcavity_base g) {
    ggx_vcavity s;
    s.groove = ggx_vcavity_groove_of(g);
    return s;
}

K_FN real ggx_vcavity_pdf(ggx_vcavity s, facet_pair pair) {
    return vcavity_any_side_pdf(s.groove.g.cavity, pair);
}

K_FN real ggx_vcavity_pdf_m(ggx_vcavity s, facet_pair pair) {
    return vcavity_pdf_m_of(pair, ggx_vcavity_pdf(s, pair));
}

K_FN real ggx_vcavity_acceptance(ggx_vcavity s) {
    return vcavity_acceptance(s.groove.g.cavity);
}

K_FN facet_draw ggx_vcavity_draw(ggx_vcavity s, real u1, real u2, real u3) {
    facet_pair side = ggx_vcavity_groove_draw(s.groove, u1, u2, u3);
    facet_pair pair = vcavity_any_side(s.groove.g.cavity, side, u3);
    real pdf = ggx_vcavity_pdf(s, pair);
    return vcavity_draw_of(s.groove.g.cavity, k_is(s.groove.g.valid), pair,
                           vcavity_pdf_m_of(pair, pdf), pdf);
}

/* Worst errors of a draw in float, 5 10^6 random inputs (tools/numerics/vcavity_error.c: roughness 0.01 to
 * 2, u2 up to 0.98, either side).
 * wo:  0.00012 at wi (0x1.cbd0c6p-1, -0x1.c1befap-3, -0x1.863d5p-2),
 *      alpha (0x1.3f6ac6p-2, 0x1.952402p-7) u (0x1.fff858p-1, 0x1.ff114cp-2, 0x1.518678p-2)
 * pdf: 1.3e-05 relative at wi (0x1.ae90dap-1, -0x1.150cf8p-1, 0x1.2acp-14),
 *      alpha (0x1.7dadf8p+0, 0x1.b8956p+0) u (0x1.6e8dfcp-2, 0x1.f7b852p-14, 0x1.f18c94p-2) */

#endif
