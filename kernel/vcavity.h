/* kernel/vcavity.h: V-cavities, what does not depend on the distribution of the normals.
 *
 * The surface is made of long grooves, each with two sides, m and its mirror image
 * m' = (-m_x, -m_y, m_z). Facets are seen from their front alone, so i may lie below the horizon
 * (Tokuyoshi 2021, section 2). The masking of either sign of i_z is
 *
 *   G1(i, m) = min(1, 2 m_z |i_z| / i.m)    for i.m > 0, else 0                        (his eq. 3)
 *   H(i)     = integral of G1(i, m) <i,m> D(m) dm / |i_z|;    1 for i_z >= 0
 *   Dv(m)    = G1(i, m) <i,m> D(m) / (H(i) |i_z|)                  density of the visible normals
 *   p(o)     = Dv(m) / (4 i.m) = D(m) min(1/|i_z|, 2 m_z/i.m) / (4 H(i))
 *   f cos    = p(o) G2/G1(i),   G2 = min(G1(i, m), G1(o, m)), or their product where separable
 *
 * An NDF brings D, H and a way to draw a groove; all else is here. */
#ifndef K_VCAVITY_H
#define K_VCAVITY_H

#include "facet.h"

K_STRUCT(vcavity_base) {
    v3 wi;
    v3 plane;
    real hit;          /* H(i) */
    real value_scale;  /* 1/(4 H(i)), in the units of 1/D that the pairs have */
    real inv_z;        /* 1/|i_z|, finite where i_z = 0 */
    real density_bias; /* density / what is sampled; 1 but for the previous normalisation */
    kint separable;
};

/* The previous normalisation left H out: it then integrates to H. */
K_FN vcavity_base vcavity_base_of(v3 wi, real hit, facet_options options) {
    vcavity_base c;
    c.wi = wi;
    c.plane = options.plane;
    c.hit = hit;
    c.value_scale = R(0.25) / hit;
    c.inv_z = R(1.0) / k_max(k_abs(wi.z), K_TINY);
    c.density_bias = k_select(k_and(k_is(options.previous), wi.z < R(0.0)), hit, R(1.0));
    c.separable = options.separable;
    return c;
}

/* G1(v, m)/|v_z|, v = i or o: both see m at the same angle. */
K_FN real vcavity_seen(facet_pair pair, real inv_z) {
    return k_min(inv_z, R(2.0) * pair.m.z / k_max(pair.cos_im, K_TINY));
}

K_FN real vcavity_g1(facet_pair pair, real z) {
    return k_min(R(1.0), R(2.0) * pair.m.z * k_abs(z) / k_max(pair.cos_im, K_TINY));
}

/* G2/G1(i). As i_z -> 0 the smaller of two that both vanish: 1. */
K_FN real vcavity_shadowing(vcavity_base c, facet_pair pair) {
    real g1_i = vcavity_g1(pair, c.wi.z);
    real g1_o = vcavity_g1(pair, pair.wo.z);
    real correlated = g1_o / k_max(k_max(g1_i, g1_o), K_TINY);
    return k_select(k_is(c.separable), g1_o, correlated);
}

/* The density of the visible normals over directions, whatever was sampled. */
K_FN real vcavity_visible(vcavity_base c, facet_pair pair) {
    return pair.d * vcavity_seen(pair, c.inv_z) * c.value_scale;
}

/* f cos of a pair that leaves the surface; 0 of any other */
K_FN real vcavity_f_cos(vcavity_base c, facet_pair pair) {
    real value = vcavity_visible(c, pair) * vcavity_shadowing(c, pair);
    return k_select(pair.leaves, k_usable(value), R(0.0));
}

/* With D(m). g1_i is normalised, G1(i, m)/H(i), as for Smith: f cos = D g2/(4 |i_z|). */
K_FN facet_eval vcavity_eval(vcavity_base c, bool valid, facet_pair pair, real d) {
    bool faces = k_and(valid, k_and(pair.m.z > R(0.0), pair.cos_im > R(0.0)));
    facet_eval e;
    e.d = k_usable(k_select(pair.m.z > R(0.0), d, R(0.0)));
    e.g1_i = k_usable(k_select(faces, vcavity_g1(pair, c.wi.z) / c.hit, R(0.0)));
    e.g1_o =
        k_usable(k_select(k_and(faces, pair.wo.z > R(0.0)), vcavity_g1(pair, pair.wo.z), R(0.0)));
    e.g2 = k_select(pair.leaves, k_usable(e.g1_i * vcavity_shadowing(c, pair)), R(0.0));
    e.f_cos = k_select(valid, vcavity_f_cos(c, pair), R(0.0));
    return e;
}

/* Density over the sphere of normals from that over directions, for methods that draw no normal which
 * faces away. */
K_FN real vcavity_pdf_m_of(facet_pair pair, real pdf) {
    return R(4.0) * k_max(pair.cos_im, R(0.0)) * pdf;
}

/* All normals by their area seen from above, D(m) m_z; over directions from that over normals. */
K_FN real vcavity_ndf_pdf(facet_pair pair, real pdf_m) {
    return pdf_m / (R(4.0) * k_max(pair.cos_im, K_TINY));
}

/* Share of the visible normals that leave: all of them from below, o_z = 2 (i.m) m_z + |i_z|, where no
 * second plane cuts them off; else no closed form is known. */
K_FN real vcavity_acceptance(vcavity_base c) {
    bool all = k_and(c.wi.z <= R(0.0), !facet_is_tilted(c.plane));
    return k_select(all, R(1.0), R(-1.0));
}

/* A draw from its pair and the two densities of the method there. */
K_FN facet_draw vcavity_draw_of(vcavity_base c, bool valid, facet_pair pair, real pdf_m, real pdf) {
    facet_draw draw;
    bool drawn = k_and(valid, k_and(pair.leaves, k_usable(pdf) > R(0.0)));
    draw.m = pair.m;
    draw.wo = pair.wo;
    draw.cos_im = pair.cos_im;
    draw.pdf_m = k_select(valid, k_usable(pdf_m), R(0.0));
    draw.pdf = k_select(drawn, pdf, R(0.0));
    draw.weight = k_select(drawn, k_usable(vcavity_f_cos(c, pair) / pdf), R(0.0));
    return draw;
}

/* The other side of the groove. */
K_FN facet_pair vcavity_mirrored(vcavity_base c, facet_pair pair) {
    facet_pair other;
    other.m = v3_of(-pair.m.x, -pair.m.y, pair.m.z);
    other.cos_im = v3_dot(c.wi, other.m);
    other.wo = v3_sub(v3_scale(other.m, R(2.0) * other.cos_im), c.wi);
    other.d = pair.d;
    other.leaves =
        k_and(facet_leaves(other.wo, c.plane), k_and(other.m.z > R(0.0), other.cos_im > R(0.0)));
    return other;
}

/* One side of a groove by the weights of the two. */
K_FN facet_pair vcavity_side(facet_pair side, facet_pair other, real weight, real other_weight,
                             real u) {
    bool keeps = u * (weight + other_weight) < weight;
    facet_pair pair;
    pair.m = v3_select(keeps, side.m, other.m);
    pair.wo = v3_select(keeps, side.wo, other.wo);
    pair.cos_im = k_select(keeps, side.cos_im, other.cos_im);
    pair.d = side.d;
    pair.leaves = k_or(k_and(keeps, side.leaves), k_and(!keeps, other.leaves));
    return pair;
}

#endif
