/* kernel/refract.h: refraction at a facet, in forms that do not cancel for an index near 1.
 *
 * Seen from i: eta = index of the far side over the index of the near side, c = i.m, and
 *   gap = eta^2 - 1,  g = eta |o.m| = sqrt(gap + c^2),  bend = g - c = gap/(g + c)
 *   o = -(i + bend m)/eta                                      (Snell)
 *   m along -(i + eta o)/bend                                  (Walter et al. 2007, eq. 16)
 *   dm/do = eta^2 |o.m|/(i.m + eta o.m)^2 = eta g/bend^2       (eq. 17)
 *   T = 2 c g (1/(g + c)^2 + eta^2/(g + eta^2 c)^2) = 1 - F    (Fresnel) */
#ifndef K_REFRACT_H
#define K_REFRACT_H

#include "fresnel.h"
#include "vec.h"

/* An interface as seen from one of its sides. */
K_STRUCT(refract_index) {
    real eta;     /* far over near */
    real inv_eta; /* near over far */
    real gap;     /* eta^2 - 1 */
    real excess;  /* index of the inside over the outside, less 1 */
    kint inside;  /* seen from the inside */
};

/* Light at a facet. */
K_STRUCT(refract_light) {
    real g;
    real bend;
    real reflectance;
    real transmittance; /* 1 - reflectance, without its cancellation; 0: total reflection */
};

/* ior > 0: inside over outside */
K_FN refract_index refract_index_of(real ior, bool inside) {
    real inv = R(1.0) / ior;
    refract_index n;
    n.excess = ior - R(1.0);
    n.eta = k_select(inside, inv, ior);
    n.inv_eta = k_select(inside, ior, inv);
    real gap = n.excess * (ior + R(1.0));
    n.gap = k_select(inside, -gap * inv * inv, gap);
    n.inside = k_flag(inside);
    return n;
}

K_FN refract_light refract_of(refract_index n, real c, real g) {
    refract_light l;
    l.g = g;
    real sum = k_max(g + c, K_TINY);
    l.bend = n.gap / sum;
    l.reflectance = fresnel_dielectric_gap(n.gap, c);
    real eta2 = n.gap + R(1.0);
    real sum_p = k_max(g + eta2 * c, K_TINY);
    /* products of quotients: a square of a small sum would underflow */
    real t_s = (c / sum) * (g / sum);
    real t_p = (eta2 * c / sum_p) * (g / sum_p);
    l.transmittance = k_saturate(R(2.0) * (t_s + t_p));
    return l;
}

K_FN refract_light refract_at(refract_index n, real cos_im) {
    real c = k_saturate(cos_im);
    return refract_of(n, c, k_sqrt(k_max(n.gap + c * c, R(0.0))));
}

/* Where o is known: near the critical angle it tells g much better than i does. */
K_FN refract_light refract_toward(refract_index n, real cos_im, real cos_om) {
    return refract_of(n, k_saturate(cos_im), n.eta * k_min(k_abs(cos_om), R(1.0)));
}

K_FN v3 refract_out(refract_index n, refract_light l, v3 i, v3 m) {
    return v3_scale(v3_add(i, v3_scale(m, l.bend)), -n.inv_eta);
}

/* The half vector of a pair, of any length, on the side of i: n_i i + n_o o = (i + o) + excess (i or
 * o). The first sum is exact where i and o are nearly opposite: all that an index near 1 needs. */
K_FN v3 refract_half_vector(refract_index n, v3 i, v3 o) {
    v3 h = v3_add(v3_add(i, o), v3_scale(v3_select(k_is(n.inside), i, o), n.excess));
    return v3_scale(h, k_select(n.gap > R(0.0), R(-1.0), R(1.0)));
}

/* Normals per transmitted directions. */
K_FN real refract_jacobian(refract_index n, refract_light l) {
    return n.eta * l.g / k_max(l.bend * l.bend, K_TINY);
}

/* Two interfaces with nothing between them: all orders of reflection inside the sheet add up to
 * R + T^2 R/(1 - R^2) = 2R/(1 + R), and T^2/(1 - R^2) = (1 - R)/(1 + R) passes (Stokes 1862). */
K_FN refract_light refract_sheet(refract_light l) {
    real inv = R(1.0) / (R(1.0) + l.reflectance);
    l.reflectance = R(2.0) * l.reflectance * inv;
    l.transmittance = l.transmittance * inv;
    return l;
}

#endif
