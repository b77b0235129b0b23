/* kernel/ggx_caps.h: all visible normals by spherical caps (Dupuy & Benyoub 2023). */
#ifndef K_GGX_CAPS_H
#define K_GGX_CAPS_H

#include "ggx_cap.h"

K_STRUCT(ggx_caps) {
    ggx_cap cap;
};

K_FN ggx_caps ggx_caps_prepare(ggx_base g) {
    ggx_caps s;
    s.cap = ggx_cap_of(g, R(0.0));
    return s;
}

K_FN real ggx_caps_pdf(ggx_caps s, facet_pair pair) {
    return ggx_cap_pdf(s.cap, pair);
}

K_FN real ggx_caps_pdf_m(ggx_caps s, facet_pair pair) {
    return ggx_cap_pdf_m(s.cap, pair);
}

K_FN real ggx_caps_acceptance(ggx_caps s) {
    return ggx_cap_acceptance(s.cap);
}

K_FN facet_draw ggx_caps_draw(ggx_caps s, real u1, real u2, real u3) {
    return ggx_cap_draw(s.cap, u1, u2);
}

/* Worst errors of a draw in float, 2 10^7 random inputs (tools/numerics/sampler_error.c: roughness
 * 0.01 to 2, u2 up to 0.98, either side).
 * wo:  1.7e-05 at wi (0x1.f2dad6p-1, 0x1.2cbda4p-3, -0x1.5d83fp-3),
 *      alpha (0x1.fcb4bp+0, 0x1.19d588p-6) u (0x1.021ebcp-1, 0x1.f5634ep-1)
 * pdf: 1.2e-06 relative at wi (-0x1.511b14p-1, -0x1.61bc56p-1, -0x1.31c6b8p-2),
 *      alpha (0x1.185daep-5, 0x1.185daep-5) u (0x1.bbf3fep-1, 0x1.55ba56p-2) */

#endif
