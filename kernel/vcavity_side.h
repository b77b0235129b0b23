/* kernel/vcavity_side.h: which of the two sides of a groove a draw takes, and the density of that.
 *
 * A groove drawn by the area D(m) m_z of its sides and a side m taken with probability S(m) have the
 * density 2 D(m) m_z S(m). The two rules here differ for i_z >= 0; from below i sees one side at most,
 * and no reflection of it falls below the horizon. */
#ifndef K_VCAVITY_SIDE_H
#define K_VCAVITY_SIDE_H

#include "vcavity.h"

/* Any side: S = <i,m> / (<i,m> + <i,m'>), the visible normals (Heitz & d'Eon 2014). */
K_FN facet_pair vcavity_any_side(vcavity_base c, facet_pair side, real u) {
    facet_pair other = vcavity_mirrored(c, side);
    return vcavity_side(side, other, k_max(side.cos_im, R(0.0)), k_max(other.cos_im, R(0.0)), u);
}

K_FN real vcavity_any_side_pdf(vcavity_base c, facet_pair pair) {
    return c.density_bias * vcavity_visible(c, pair);
}

K_STRUCT(vcavity_weights) {
    real side;
    real other;
};

/* The same where both sides reflect out of the surface or neither does; else the one that does. */
K_FN vcavity_weights vcavity_leaving_weights(facet_pair side, facet_pair other) {
    vcavity_weights w;
    w.side = k_select(k_and(other.leaves, !side.leaves), R(0.0), k_max(side.cos_im, R(0.0)));
    w.other = k_select(k_and(side.leaves, !other.leaves), R(0.0), k_max(other.cos_im, R(0.0)));
    return w;
}

K_FN facet_pair vcavity_leaving_side(vcavity_base c, facet_pair side, real u) {
    facet_pair other = vcavity_mirrored(c, side);
    vcavity_weights w = vcavity_leaving_weights(side, other);
    return vcavity_side(side, other, w.side, w.other, u);
}

K_FN real vcavity_leaving_side_pdf(vcavity_base c, facet_pair pair) {
    facet_pair other = vcavity_mirrored(c, pair);
    bool above = c.wi.z >= R(0.0);
    /* i sees it, and no more than it sees of the groove */
    real alone = R(0.5) * pair.d * pair.m.z / k_max(pair.cos_im, K_TINY);
    real pdf =
        k_select(k_and(above, k_and(pair.leaves, !other.leaves)), alone, vcavity_visible(c, pair));
    return c.density_bias * k_select(k_and(above, k_and(other.leaves, !pair.leaves)), R(0.0), pdf);
}

#endif
