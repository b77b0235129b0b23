/* Colour between the pixels of a picture. */
#ifndef LOBE_SSR_ROOM_BETWEEN_H
#define LOBE_SSR_ROOM_BETWEEN_H

#include "pipeline.h"

/* x and y in [0, 1] across it. */
K_FN v3 ssr_color_between(const float *rgb, int width, int height, float x, float y) {
    const ssr_between b = ssr_between_of(x * (float)width, y * (float)height);
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    K_UNROLL
    for (int k = 0; k < 4; k++) {
        const size_t tx = (size_t)ssr_inside(ssr_corner_x(b, k), width);
        const size_t ty = (size_t)ssr_inside(ssr_corner_y(b, k), height);
        sum = ssr_add_share(sum, ssr_v3(rgb + 3 * (ty * (size_t)width + tx)), ssr_share(b, k));
    }
    return sum;
}

#endif
