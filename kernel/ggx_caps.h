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

K_FN real ggx_caps_pdf(ggx_caps s, ggx_pair pair) {
    return ggx_cap_pdf(s.cap, pair);
}

K_FN real ggx_caps_pdf_m(ggx_caps s, ggx_pair pair) {
    return ggx_cap_pdf_m(s.cap, pair);
}

K_FN real ggx_caps_acceptance(ggx_caps s) {
    return ggx_cap_acceptance(s.cap);
}

K_FN ggx_draw ggx_caps_draw(ggx_caps s, real u1, real u2, real u3) {
    return ggx_cap_draw(s.cap, u1, u2);
}

#endif
