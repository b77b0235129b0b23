/* lib/walk_sight.h: what a ray inside a Smith microsurface sees, for either distribution of normals.
 *
 * i is the way back along the ray, on either side of the horizon. V(i)/2 is the area of the facets that
 * face it: |w_z| Lambda(w) for a ray that ascends along w = -i, |w_z| (1 + Lambda(i)) for one that
 * descends. Before including: the binding of f64. */
#ifndef LOBE_WALK_SIGHT_H
#define LOBE_WALK_SIGHT_H

#include "lobe/albedo.h"

#include "../kernel/beckmann_newton.h"
#include "../kernel/ggx_caps.h"

typedef struct walk_sight {
    bool is_ggx, is_blind; /* blind: straight up there is nothing to meet */
    double area;           /* V(i)/2 */
    ggx_caps ggx;
    beckmann_newton beckmann;
} walk_sight;

static inline walk_sight walk_sight_of(lobe_microsurface s, v3 i) {
    const facet_options options = facet_options_of(false, false);
    walk_sight k;
    k.is_ggx = s.ndf == LOBE_NDF_GGX;
    if (k.is_ggx) {
        k.ggx = ggx_caps_prepare(ggx_base_of(i, s.alpha_x, s.alpha_y, options));
        k.is_blind = !k_is(k.ggx.cap.g.valid);
        k.area = 0.5 * k.ggx.cap.g.visible;
    } else {
        k.beckmann = beckmann_newton_prepare(beckmann_base_of(i, s.alpha_x, s.alpha_y, options));
        k.is_blind = !k_is(k.beckmann.g.valid);
        k.area = 0.5 * k.beckmann.g.visible * k_exp(-k.beckmann.g.shift);
    }
    return k;
}

/* One of the facets, in proportion to what is seen of it. */
static inline facet_draw walk_sight_draw(const walk_sight *k, double u1, double u2) {
    return k->is_ggx ? ggx_caps_draw(k->ggx, u1, u2, 0.0)
                     : beckmann_newton_draw(k->beckmann, u1, u2, 0.0);
}

/* Density with which they reflect to wo, which is above the surface. */
static inline double walk_sight_toward(const walk_sight *k, v3 wo, double *cos_im) {
    facet_pair pair;
    double density;
    if (k->is_ggx) {
        const ggx_base *g = &k->ggx.cap.g;
        pair = ggx_pair_of_wo(*g, wo);
        density = pair.d * g->value_scale;
    } else {
        const beckmann_base *g = &k->beckmann.g;
        pair = beckmann_pair_of_wo(*g, wo);
        density = pair.d / (2.0 * g->visible);
    }
    *cos_im = pair.cos_im;
    return pair.leaves && !k->is_blind ? k_usable(density) : 0.0;
}

/* Density with which they have the normal m, over normals */
static inline double walk_sight_density(const walk_sight *k, v3 m, double *cos_im) {
    facet_pair pair;
    double density;
    if (k->is_ggx) {
        const ggx_base *g = &k->ggx.cap.g;
        pair = ggx_pair_of_m(*g, m);
        density = pair.d * g->value_scale;
    } else {
        const beckmann_base *g = &k->beckmann.g;
        pair = beckmann_pair_of_m(*g, m);
        density = pair.d / (2.0 * g->visible);
    }
    *cos_im = pair.cos_im;
    const bool faces = pair.cos_im > 0.0 && m.z > 0.0 && !k->is_blind;
    return faces ? k_usable(4.0 * pair.cos_im * density) : 0.0;
}

/* Lambda of a direction above the surface */
static inline double walk_lambda(lobe_microsurface s, v3 w) {
    const double ax = ggx_alpha_floor(s.alpha_x), ay = ggx_alpha_floor(s.alpha_y);
    return s.ndf == LOBE_NDF_GGX ? ggx_lambda(w, ax, ay) : beckmann_lambda(w, ax, ay);
}

#endif
