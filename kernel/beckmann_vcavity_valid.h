/* kernel/beckmann_vcavity_valid.h: Beckmann V-cavities, and where one side of a groove reflects into the surface and the
 * other does not, the one that does not (this project's own; docs/departures.md). From below it is
 * beckmann_vcavity.h: there one side at most is seen, and its reflections leave. */
#ifndef K_BECKMANN_VCAVITY_VALID_H
#define K_BECKMANN_VCAVITY_VALID_H

#include "beckmann_vcavity_groove.h"
#include "vcavity_side.h"

K_STRUCT(beckmann_vcavity_valid) {
    beckmann_vcavity_groove groove;
};

K_FN beckmann_vcavity_valid beckmann_vcavity_valid_prepare(beckmann_vcavity_base g) {
    beckmann_vcavity_valid s;
    s.groove = beckmann_vcavity_groove_of(g);
    return s;
}

K_FN real beckmann_vcavity_valid_pdf(beckmann_vcavity_valid s, facet_pair pair) {
    return vcavity_leaving_side_pdf(s.groove.g.cavity, pair);
}

K_FN real beckmann_vcavity_valid_pdf_m(beckmann_vcavity_valid s, facet_pair pair) {
    return vcavity_pdf_m_of(pair, beckmann_vcavity_valid_pdf(s, pair));
}

K_FN real beckmann_vcavity_valid_acceptance(beckmann_vcavity_valid s) {
    return vcavity_acceptance(s.groove.g.cavity);
}

K_FN facet_draw beckmann_vcavity_valid_draw(beckmann_vcavity_valid s, real u1, real u2, real u3) {
    facet_pair side = beckmann_vcavity_groove_draw(s.groove, u1, u2, u3);
    facet_pair pair = vcavity_leaving_side(s.groove.g.cavity, side, u3);
    real pdf = beckmann_vcavity_valid_pdf(s, pair);
    return vcavity_draw_of(s.groove.g.cavity, s.groove.g.valid, pair, vcavity_pdf_m_of(pair, pdf),
                           pdf);
}

#endif
