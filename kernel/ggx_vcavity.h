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
    return vcavity_draw_of(s.groove.g.cavity, s.groove.g.valid, pair, vcavity_pdf_m_of(pair, pdf),
                           pdf);
}

#endif
