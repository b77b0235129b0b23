/* kernel/ggx_visible.h: the densities shared by every sampler that spreads its stretched reflections
 * evenly over a cap of height w = 1 - kappa (the whole of the visible normals: w = 1 + i_std.z):
 * p(o) = D(m)/(2 t_i w). Plain visible normals: w t_i = V(i). */
#ifndef K_GGX_VISIBLE_H
#define K_GGX_VISIBLE_H

#include "ggx.h"
#include "ggx_useful.h"

K_STRUCT(ggx_visible) {
    real w;
    real scale; /* p(o)/D(m) */
    real gain;  /* weight/shadowing */
};

K_FN ggx_visible ggx_visible_of(ggx_base g, real w) {
    ggx_visible v;
    real tw = g.t_i * w;
    v.w = w;
    v.scale = g.density_bias * R(0.5) / tw;
    v.gain = tw / (g.visible * g.density_bias);
    return v;
}

/* Density over directions, continued to reflections that do not leave. */
K_FN real ggx_visible_pdf(ggx_visible v, facet_pair pair) {
    return pair.d * v.scale;
}

/* Density over the sphere of normals. */
K_FN real ggx_visible_pdf_m(ggx_visible v, facet_pair pair) {
    return R(4.0) * k_max(pair.cos_im, R(0.0)) * ggx_visible_pdf(v, pair);
}

/* D cancels in the weight. */
K_FN facet_draw ggx_visible_draw(ggx_base g, ggx_visible v, facet_pair pair) {
    return ggx_weighted_draw(g, pair, ggx_visible_pdf_m(v, pair), ggx_visible_pdf(v, pair),
                             ggx_shadowing(g, pair.wo) * v.gain);
}

/* Share of the draws that leave the surface; with a second plane it has no closed form. */
K_FN real ggx_visible_acceptance(ggx_base g, ggx_visible v) {
    return k_select(k_is(g.tilted), R(-1.0), R(2.0) * ggx_useful_area(g) / v.w);
}

/* The reflection of i_std about the stretched m. */
K_FN v3 ggx_stretched_out(ggx_base g, v3 m) {
    v3 h = v3_normalize(v3_of(m.x * g.inv_ax, m.y * g.inv_ay, m.z));
    return v3_sub(v3_scale(h, R(2.0) * v3_dot(g.i_std, h)), g.i_std);
}

#endif
