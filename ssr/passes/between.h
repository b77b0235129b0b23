/* ssr/passes/between.h: between the pixels of a picture: the four around a place and their shares. */
#ifndef LOBE_SSR_BETWEEN_H
#define LOBE_SSR_BETWEEN_H

#include "kernel/vec.h"

K_STRUCT(ssr_between) {
    kint x; /* the left and upper one */
    kint y;
    real tx; /* how near the right and the lower ones are */
    real ty;
};

/* Position in pixels; the centre of the first lies at (0.5, 0.5). */
K_FN ssr_between ssr_between_of(real px, real py) {
    real x = k_floor(px - R(0.5));
    real y = k_floor(py - R(0.5));
    ssr_between b;
    b.x = k_to_int(x);
    b.y = k_to_int(y);
    b.tx = px - R(0.5) - x;
    b.ty = py - R(0.5) - y;
    return b;
}

/* Of corner 0 to 3: left and right in bit 0, upper and lower in bit 1. */
K_FN real ssr_share(ssr_between b, kint corner) {
    real x = k_select((corner & K_INT(1)) != K_INT(0), b.tx, R(1.0) - b.tx);
    real y = k_select((corner & K_INT(2)) != K_INT(0), b.ty, R(1.0) - b.ty);
    return x * y;
}

/* Beyond the edge the picture goes on as it ends. */
K_FN kint ssr_inside(kint at, kint size) {
    kint low = at < K_INT(0) ? K_INT(0) : at;
    return low < size ? low : size - K_INT(1);
}

/* Beyond the edge it begins anew; at most once around. */
K_FN kint ssr_around(kint at, kint size) {
    kint low = at < K_INT(0) ? at + size : at;
    return low < size ? low : low - size;
}

K_FN kint ssr_corner_x(ssr_between b, kint corner) {
    return b.x + (corner & K_INT(1));
}

K_FN kint ssr_corner_y(ssr_between b, kint corner) {
    return b.y + (corner >> 1);
}

/* A pixel of share 0 is not read: it may hold what is not light. */
K_FN v3 ssr_add_share(v3 sum, v3 color, real share) {
    return v3_select(share > R(0.0), v3_add(sum, v3_scale(color, share)), sum);
}

#endif
