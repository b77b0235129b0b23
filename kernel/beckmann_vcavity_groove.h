/* kernel/beckmann_vcavity_groove.h: one side of a V-cavity, ready for the choice between the two sides.
 *
 * From above any normal by its area D(m) m_z will do: both stretched slopes are Gaussians. From below
 * the part across i stays one, and the part towards i falls in two (Tokuyoshi 2021, eq. 4-5): beyond 3a
 * the facets are partly masked and have the density of the Gaussian, between a and 3a they are seen
 * whole and have Smith's, of limited range (kernel/beckmann_slopes.h; its depths count from a). */
#ifndef K_BECKMANN_VCAVITY_GROOVE_H
#define K_BECKMANN_VCAVITY_GROOVE_H

#include "beckmann_vcavity_family.h"
#include "beckmann_visible.h"

K_STRUCT(beckmann_vcavity_groove) {
    beckmann_vcavity_base g;
    facet_azimuth azimuth;
    beckmann_slopes whole; /* the facets seen whole */
    real masked_area;      /* erfc of the least slope of the others */
};

K_FN beckmann_vcavity_groove beckmann_vcavity_groove_of(beckmann_vcavity_base g) {
    bool behind = g.wi.z < R(0.0);
    beckmann_vcavity_groove s;
    s.g = g;
    s.azimuth = facet_azimuth_of(g.beckmann.i_std);
    s.whole = beckmann_slopes_between(beckmann_slopes_of(-g.a), R(0.0), R(2.0) * g.a);
    s.masked_area = k_select(behind, k_erfc(R(3.0) * g.a), R(2.0));
    return s;
}

/* u3 chooses the part; from above it is left for the choice of the side. */
K_FN facet_pair beckmann_vcavity_groove_draw(beckmann_vcavity_groove s, real u1, real u2, real u3) {
    real masked = k_erfcinv(s.masked_area * u1) - s.g.a;
    real whole = beckmann_slopes_inverse(s.whole, u1);
    real depth = k_select(u3 < s.g.masked_share, masked, whole);
    return beckmann_pair_of_depth(s.g.beckmann, s.azimuth, depth, beckmann_gaussian(u2));
}

#endif
