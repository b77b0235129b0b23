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
    return vcavity_draw_of(s.groove.g.cavity, s.groove.g.valid, pair, vcavity_pdf_m_of(pair, pdf),
                           pdf);
}

#endif
