/* ssr/passes/trace.h: from a surface to the ray that starts there, and what the march says of it. */
#ifndef LOBE_SSR_TRACE_H
#define LOBE_SSR_TRACE_H

#include "kernel/facet.h"

#include "march.h"
#include "noise.h"
#include "surface.h"

/* The states of lobe/ssr.h. */
#define SSR_NO_RAY K_INT(0)
#define SSR_REJECTED K_INT(1)
#define SSR_MISS K_INT(2)
#define SSR_HIT K_INT(3)
#define SSR_SKY K_INT(4)
#define SSR_LOST K_INT(5)

/* Draws of less are dropped: the cosine above the surface, and the weight. */
#define SSR_LEAST R(1e-3)

K_FN facet_draw ssr_mirror_draw(v3 to_viewer) {
    return facet_mirror_draw(to_viewer, v3_of(R(0.0), R(0.0), R(1.0)));
}

/* The number that tells how far from the centre of the lobe a draw lies, made smaller. */
K_FN ssr_noise ssr_biased(ssr_noise u, real bias, bool by_first) {
    real share = R(1.0) - bias;
    ssr_noise b;
    b.u1 = u.u1 * k_select(by_first, share, R(1.0));
    b.u2 = u.u2 * k_select(by_first, R(1.0), share);
    b.u3 = u.u3;
    return b;
}

K_FN bool ssr_is_kept(facet_draw draw) {
    return k_and(draw.wo.z >= SSR_LEAST, draw.weight >= SSR_LEAST);
}

/* Against meeting itself: a ray starts nearer to the viewer, the more the flatter the surface is seen. */
K_FN real ssr_start_z(ssr_surface s, real z) {
    real pull = R(1.0) - R(0.001) / k_max(s.to_viewer.z, R(1e-3));
    return z * k_max(pull, R(1e-3));
}

/* A march that ended is looked at where the ray leaves the depth range. */
K_FN ssr_march ssr_march_at_end(ssr_ray r, ssr_march m) {
    ssr_march at_end = m;
    at_end.q = r.end;
    at_end.level = K_INT(0);
    return at_end;
}

/* Whether the ray may have left through the far plane; then what it saw last is to have no surface. */
K_FN bool ssr_leaves_far(ssr_ray r, ssr_march m) {
    real depth = r.origin.z + r.end * r.direction.z;
    bool left = k_and(m.state == SSR_MARCH_LEFT, k_is(r.valid));
    return k_and(left, k_and(depth<R(1e-6), r.end> R(0.0)));
}

K_FN kint ssr_state_of(ssr_march m, bool sees_sky) {
    kint missed = ssr_pick(m.state == SSR_MARCH_LEFT, SSR_MISS, SSR_LOST);
    return ssr_pick(m.state == SSR_MARCH_HIT, SSR_HIT, ssr_pick(sees_sky, SSR_SKY, missed));
}

K_FN bool ssr_meets(kint state) {
    return k_or(state == SSR_HIT, state == SSR_SKY);
}

#endif
