/* kernel/dielectric.h: rough dielectrics: what is the same for every distribution of facets.
 *
 * Everything here is seen from i, which is above the surface: what is called in its frame `below` is the
 * far side. A facet of normal m sends i to two directions, reflected with the share F and refracted
 * with T = 1 - F. With Dv the density of the visible normals (Walter et al. 2007, eq. 20 and 21)
 *   f cos = F Dv/(4 i.m) G2/G1(i),     f cos = T Dv (dm/do) G2/G1(i)
 * the second times 1/eta^2 for radiance, which spreads and shrinks with the square of the index.
 *
 * A draw takes a visible normal, then one of its two directions with the chances F and T; where only
 * one of them leaves on its proper side, that one with certainty. From the side of the lower index
 * the refracted one always does: no draw is lost. Only the whole of the visible normals will do:
 * those that reflect upward do not hold all that transmit.
 *
 * Point masses: a smooth surface (both directions), equal indices, thin walls (straight through).
 * A thin wall is a sheet of facets, each of two parallel interfaces (refract_sheet): light that is
 * not reflected passes it straight.
 *
 * A family gives to dielectric_facet_of its m, and to the facet `density_r` = Dv/(4 i.m), `density_m` =
 * Dv, and the ratios G2/G1(i) `shadow_r`, `shadow_t` of the two directions: see ggx_dielectric.h. */
#ifndef K_DIELECTRIC_H
#define K_DIELECTRIC_H

#include "refract.h"

/* Indices within this of each other are equal for a rough surface: of the refracted direction only its
 * rounding would be left. */
#define DIELECTRIC_MATCHED (R(16.0) * K_EPS)
#define DIELECTRIC_IOR_MIN R(1e-3)
#define DIELECTRIC_IOR_MAX R(1e3)

K_STRUCT(dielectric_options) {
    kint separable;  /* G2 = G1 G1; else correlated heights */
    kint importance; /* no 1/eta^2 */
    kint thin;
    kint compensate; /* see dielectric_side */
};

/* The interface as seen from i. */
K_STRUCT(dielectric_side) {
    refract_index n;
    real turn;        /* -1 where the frame of i is the caller's upside down */
    real passed;      /* what refraction does to radiance */
    real boost;       /* what makes up for lost energy; 1: none */
    kint straight;    /* what passes is not bent */
    kint matched;     /* equal indices */
    kint follows;     /* compensated thin walls: what reflection loses passes straight */
    kint independent; /* shadowing of what is refracted is separable: as asked, and where it is
                         compensated, for what correlated heights leave can be next to nothing */
    kint thin;
    kint mirror;
    kint valid;
};

K_STRUCT(dielectric_facet) {
    v3 m;
    real cos_im;
    refract_light light;
    v3 reflected;
    v3 passing;
    bool reflects; /* the direction leaves on its proper side */
    bool passes;
    real density_r; /* of `reflected` over directions, were it certain */
    real density_m; /* of m over normals */
    real shadow_r;  /* G2/G1(i) */
    real shadow_t;
    real chance_r; /* of being chosen */
    real chance_t;
};

K_STRUCT(dielectric_draw) {
    v3 m;
    v3 wo;
    real cos_im;
    real fresnel;
    real pdf_m;
    real pdf;
    real weight;
    bool transmitted;
    bool is_point;
};

K_STRUCT(dielectric_value) {
    real f_cos;
    real pdf;
    real pdf_m;
    real shadow; /* G2/G1(i), 0 where nothing is scattered */
    real cos_im;
    real fresnel;
    bool transmitted;
};

K_FN v3 dielectric_turn(dielectric_side s, v3 v) {
    return v3_of(v.x, v.y, v.z * s.turn);
}

/* `mirror` and `valid` are those of the family's base for i. */
K_FN dielectric_side dielectric_side_of(bool inside, real ior, dielectric_options options,
                                        bool mirror, bool valid) {
    bool known = k_and(ior >= DIELECTRIC_IOR_MIN, ior <= DIELECTRIC_IOR_MAX);
    bool thin = k_is(options.thin);
    bool compensate = k_is(options.compensate);
    dielectric_side s;
    s.n = refract_index_of(k_select(known, ior, R(1.0)), k_and(inside, !thin));
    bool matched = k_abs(s.n.excess) <= k_select(mirror, R(0.0), DIELECTRIC_MATCHED);
    bool straight = k_or(thin, matched);
    bool unscaled = k_or(k_is(options.importance), straight);
    s.turn = k_select(inside, R(-1.0), R(1.0));
    s.passed = k_select(unscaled, R(1.0), s.n.inv_eta * s.n.inv_eta);
    s.boost = R(1.0);
    s.straight = k_flag(straight);
    s.matched = k_flag(matched);
    s.follows = options.thin & options.compensate; /* of the flags: see k_flag */
    s.independent = k_flag(k_or(k_is(options.separable), compensate));
    s.thin = options.thin;
    s.mirror = k_flag(mirror);
    s.valid = k_flag(k_and(valid, known));
    return s;
}

K_FN refract_light dielectric_light(dielectric_side s, real cos_im) {
    refract_light light = refract_at(s.n, cos_im);
    refract_light sheet = refract_sheet(light);
    bool thin = k_is(s.thin);
    bool matched = k_is(s.matched);
    real reflectance = k_select(thin, sheet.reflectance, light.reflectance);
    real transmittance = k_select(thin, sheet.transmittance, light.transmittance);
    light.reflectance = k_select(matched, R(0.0), reflectance);
    light.transmittance = k_select(matched, R(1.0), transmittance);
    return light;
}

K_FN bool dielectric_faces(dielectric_side s, dielectric_facet f) {
    return k_and(k_is(s.valid), k_and(f.cos_im > R(0.0), f.m.z > R(0.0)));
}

/* The two directions; the family adds densities and shadowing. */
K_FN dielectric_facet dielectric_facet_of(dielectric_side s, v3 i, v3 m) {
    dielectric_facet f;
    f.m = m;
    f.cos_im = v3_dot(i, m);
    f.light = dielectric_light(s, f.cos_im);
    f.reflected = v3_sub(v3_scale(m, R(2.0) * f.cos_im), i);
    v3 ahead = v3_scale(i, R(-1.0));
    f.passing = v3_select(k_is(s.straight), ahead, refract_out(s.n, f.light, i, m));
    bool faces = dielectric_faces(s, f);
    bool above = k_and(faces, f.reflected.z > R(0.0));
    bool below = k_and(faces, f.passing.z < R(0.0));
    f.reflects = k_and(above, f.light.reflectance > R(0.0));
    f.passes = k_and(below, f.light.transmittance > R(0.0));
    f.density_r = R(0.0);
    f.density_m = R(0.0);
    f.shadow_r = R(1.0);
    f.shadow_t = R(1.0);
    f.chance_r = R(0.0);
    f.chance_t = R(0.0);
    return f;
}

/* The normal that scatters i to o, of any length; above the surface where there is one. */
K_FN v3 dielectric_half_vector(dielectric_side s, v3 i, v3 o) {
    return v3_select(o.z < R(0.0), refract_half_vector(s.n, i, o), v3_add(i, o));
}

/* The facet of a half vector takes the direction that is given instead of the one it would compute. Whether
 * anything passes is for that one to say, too: next to the critical angle i alone may see total reflection. */
K_FN dielectric_facet dielectric_facet_toward(dielectric_side s, dielectric_facet f, v3 o) {
    bool below = o.z < R(0.0);
    real cos_om = v3_dot(o, f.m);
    refract_light known = refract_toward(s.n, f.cos_im, cos_om);
    bool leaves = k_and(below, cos_om < R(0.0));
    bool bent = k_and(leaves, !k_is(s.straight));
    f.light.g = k_select(bent, known.g, f.light.g);
    f.light.bend = k_select(bent, known.bend, f.light.bend);
    f.light.transmittance = k_select(bent, known.transmittance, f.light.transmittance);
    f.reflected = v3_select(below, f.reflected, o);
    f.passing = v3_select(below, o, f.passing);
    f.reflects = k_and(f.reflects, f.reflected.z > R(0.0));
    bool lit = k_and(dielectric_faces(s, f), f.light.transmittance > R(0.0));
    f.passes = k_or(k_and(leaves, lit), k_and(!below, f.passes));
    return f;
}

/* Straight through is no scattering: nothing shadows it. */
K_FN dielectric_facet dielectric_choose(dielectric_side s, dielectric_facet f) {
    bool follows = k_is(s.follows);
    bool mirror = k_is(s.mirror);
    f.shadow_r = k_select(mirror, R(1.0), f.shadow_r);
    f.shadow_t = k_select(k_or(mirror, k_is(s.straight)), R(1.0), f.shadow_t);
    real share = f.light.reflectance * k_select(follows, k_saturate(f.shadow_r), R(1.0));
    real rest = k_select(follows, R(1.0) - share, f.light.transmittance);
    f.chance_r = k_select(f.reflects, k_select(f.passes, share, R(1.0)), R(0.0));
    f.chance_t = k_select(f.passes, k_select(f.reflects, rest, R(1.0)), R(0.0));
    return f;
}

/* f cos over the density of the direction were it certain */
K_FN real dielectric_ratio_r(dielectric_side s, dielectric_facet f) {
    return s.boost * f.light.reflectance * f.shadow_r;
}

K_FN real dielectric_ratio_t(dielectric_side s, dielectric_facet f) {
    real rest = R(1.0) - f.light.reflectance * k_select(f.reflects, f.shadow_r, R(0.0));
    real share = k_select(k_is(s.follows), rest, f.light.transmittance);
    return s.boost * s.passed * share * f.shadow_t;
}

K_FN real dielectric_density_t(dielectric_side s, dielectric_facet f) {
    return f.density_m * refract_jacobian(s.n, f.light);
}

/* The ratio over the chance: in closed form, for where one is possible without the other the chance
 * is 1, and where both are it is the share itself. */
K_FN real dielectric_weight(dielectric_side s, dielectric_facet f, bool reflect) {
    bool both = k_and(f.reflects, f.passes);
    real chance = k_select(reflect, f.chance_r, f.chance_t);
    real ratio = k_select(reflect, dielectric_ratio_r(s, f), dielectric_ratio_t(s, f));
    real plain = k_select(reflect, s.boost * f.shadow_r, s.boost * s.passed * f.shadow_t);
    real whole = k_select(k_is(s.follows), R(1.0), plain);
    return k_select(both, whole, ratio) * k_select(chance > R(0.0), R(1.0), R(0.0));
}

K_FN dielectric_draw dielectric_draw_of(dielectric_side s, dielectric_facet f, real u3) {
    bool reflect = u3 < f.chance_r;
    dielectric_draw r;
    r.transmitted = !reflect;
    r.is_point = k_or(k_is(s.mirror), k_and(r.transmitted, k_is(s.straight)));
    v3 wo = v3_select(reflect, f.reflected, f.passing);
    real chance = k_select(reflect, f.chance_r, f.chance_t);
    real density = k_select(reflect, f.density_r, dielectric_density_t(s, f));
    r.pdf = k_usable(chance * k_select(r.is_point, R(1.0), density));
    real known = k_select(k_is(s.mirror), R(1.0), k_usable(f.density_m));
    r.pdf_m = k_select(k_is(s.valid), known, R(0.0));
    real weight = k_usable(dielectric_weight(s, f, reflect));
    r.weight = k_select(r.pdf > R(0.0), weight, R(0.0));
    r.m = dielectric_turn(s, f.m);
    r.wo = dielectric_turn(s, wo);
    r.cos_im = f.cos_im;
    r.fresnel = f.light.reflectance;
    return r;
}

/* Of the facet toward o. Point masses have no density. */
K_FN dielectric_value dielectric_value_of(dielectric_side s, dielectric_facet f, v3 o) {
    bool below = o.z < R(0.0);
    bool possible = k_or(k_and(below, f.passes), k_and(!below, f.reflects));
    bool massed = k_or(k_is(s.mirror), k_or(k_is(s.matched), k_and(below, k_is(s.straight))));
    bool spread = k_and(possible, !massed);
    real density = k_select(below, dielectric_density_t(s, f), f.density_r);
    real chance = k_select(below, f.chance_t, f.chance_r);
    real ratio = k_select(below, dielectric_ratio_t(s, f), dielectric_ratio_r(s, f));
    dielectric_value v;
    v.transmitted = below;
    v.cos_im = k_max(f.cos_im, R(0.0));
    v.fresnel = f.light.reflectance;
    v.pdf = k_select(spread, k_usable(density * chance), R(0.0));
    v.f_cos = k_select(v.pdf > R(0.0), k_usable(density * ratio), R(0.0));
    v.pdf_m = k_select(v.pdf > R(0.0), k_usable(f.density_m), R(0.0));
    v.shadow = k_select(v.pdf > R(0.0), k_select(below, f.shadow_t, f.shadow_r), R(0.0));
    return v;
}

#endif
