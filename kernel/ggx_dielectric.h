/* kernel/ggx_dielectric.h: rough dielectrics of Smith-GGX facets: the family's part of dielectric.h. */
#ifndef K_GGX_DIELECTRIC_H
#define K_GGX_DIELECTRIC_H

#include "dielectric.h"
#include "dielectric_masking.h"
#include "ggx_caps.h"

K_STRUCT(ggx_dielectric) {
    ggx_caps caps; /* in the frame where i is above */
    dielectric_side side;
};

K_FN ggx_dielectric ggx_dielectric_prepare(v3 wi, real alpha_x, real alpha_y, real ior,
                                           dielectric_options options) {
    bool inside = wi.z < R(0.0);
    v3 i = v3_of(wi.x, wi.y, k_abs(wi.z));
    ggx_base g = ggx_base_of(i, alpha_x, alpha_y, facet_options_of(k_is(options.separable), false));
    ggx_dielectric s;
    s.caps = ggx_caps_prepare(g);
    s.side = dielectric_side_of(inside, ior, options, k_is(g.mirror), k_is(g.valid));
    return s;
}

K_FN dielectric_facet ggx_dielectric_finish(ggx_dielectric s, dielectric_facet f, real d) {
    ggx_base g = s.caps.cap.g;
    f.density_r = d * g.value_scale;
    f.density_m = R(4.0) * k_max(f.cos_im, R(0.0)) * f.density_r;
    f.shadow_r = ggx_shadowing(g, f.reflected);
    f.shadow_t = dielectric_shadowing(g.wi, f.passing, g.ax, g.ay, k_is(s.side.independent));
    return dielectric_choose(s.side, f);
}

K_FN dielectric_facet ggx_dielectric_drawn(ggx_dielectric s, real u1, real u2) {
    ggx_base g = s.caps.cap.g;
    facet_pair pair = ggx_pair_of_stretched(g, ggx_cap_half_vector(s.caps.cap, u1, u2));
    v3 up = v3_of(R(0.0), R(0.0), R(1.0));
    v3 m = v3_select(k_is(s.side.mirror), up, pair.m);
    return ggx_dielectric_finish(s, dielectric_facet_of(s.side, g.wi, m), pair.d);
}

K_FN dielectric_draw ggx_dielectric_draw(ggx_dielectric s, real u1, real u2, real u3) {
    return dielectric_draw_of(s.side, ggx_dielectric_drawn(s, u1, u2), u3);
}

/* All there is to know about a pair of directions. D is that of the facet that scatters it. */
K_STRUCT(ggx_dielectric_value) {
    dielectric_value value;
    real d;
    real g1_i;
    real g1_o;
    real g2;
};

K_FN ggx_dielectric_value ggx_dielectric_eval(ggx_dielectric s, v3 wo) {
    ggx_base g = s.caps.cap.g;
    v3 o = dielectric_turn(s.side, wo);
    v3 h = dielectric_half_vector(s.side, g.wi, o);
    real h2 = k_max(v3_dot(h, h), K_TINY);
    v3 w = v3_of(h.x * g.inv_ax, h.y * g.inv_ay, h.z);
    real d = ggx_d_stretched(g, h2 / k_max(v3_dot(w, w), K_TINY));
    v3 m = v3_scale(h, R(1.0) / k_sqrt(h2));
    dielectric_facet f = dielectric_facet_toward(s.side, dielectric_facet_of(s.side, g.wi, m), o);
    ggx_dielectric_value e;
    e.value = dielectric_value_of(s.side, ggx_dielectric_finish(s, f, d), o);
    e.d = k_select(e.value.pdf > R(0.0), k_usable(d), R(0.0));
    e.g1_i = R(1.0) / (R(1.0) + dielectric_lambda(g.wi, g.ax, g.ay));
    e.g1_o = R(1.0) / (R(1.0) + dielectric_lambda(o, g.ax, g.ay));
    e.g2 = e.g1_i * e.value.shadow;
    return e;
}

K_FN real ggx_dielectric_pdf(ggx_dielectric s, v3 wo) {
    return ggx_dielectric_eval(s, wo).value.pdf;
}

/* Worst errors in float, 2 10^6 random inputs (tools/numerics/dielectric_error.c: roughness 0.01 to 1,
 * index 1.1 to 2.5, u2 up to 0.98, both sides).
 * wo:  1.2e-05 at wi (-0x1.e5d61p-2, 0x1.7757aap-2, -0x1.99c604p-1), alpha (0x1.75bb32p-2, 0x1.41e824p-5),
 *      ior 0x1.2e49ap+1, u (0x1.30bfbp-1, 0x1.9b5ccap-1, 0x1.f085aap-1)
 * pdf: 45 times what rounding wo does to it, at wi (-0x1.ba09bp-2, 0x1.812624p-4, -0x1.cb5278p-1),
 *      alpha (0x1.701304p-6, 0x1.701304p-6), ior 0x1.18153ap+1,
 *      u (0x1.eceb04p-1, 0x1.1bcc36p-2, 0x1.c3911p-3) */

#endif
