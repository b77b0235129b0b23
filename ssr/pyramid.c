/* Depth pyramid: nearest and farthest of 2 x 2 cells, and of the colours their mean. A level covers the one
 * below to the last row and column: its size is rounded up. */
#include <math.h>

#include "pipeline.h"

static void depth_of_pixels(lobe_ssr *s, const lobe_ssr_frame *f) {
    const ssr_camera c = lobe_ssr_kernel_camera(s, &f->camera);
#pragma omp parallel for num_threads(s->threads)
    for (size_t i = 0; i < ssr_pixels(s); i++) {
        const float z = lobe_ssr_z_at(f, i);
        const float depth = z > 0.0f ? k_saturate(ssr_depth_of(c, z)) : 0.0f;
        s->pyramid.depth[0][i] = (depth_cell){depth, depth};
    }
}

/* Small levels are faster alone than the start of the threads. */
enum { CELLS_WORTH_THREADS = 1 << 14 };

static void halve_depth(lobe_ssr *s, int level) {
    const pyramid *p = &s->pyramid;
    const int width = p->width[level - 1], height = p->height[level - 1];
    const depth_cell *fine = p->depth[level - 1];
#pragma omp parallel for num_threads(s->threads) if (p->width[level] * p->height[level] >=         \
                                                     CELLS_WORTH_THREADS)
    for (int y = 0; y < p->height[level]; y++)
        for (int x = 0; x < p->width[level]; x++) {
            const int x0 = 2 * x, x1 = x0 + 1 < width ? x0 + 1 : x0;
            const size_t row0 = (size_t)(2 * y) * (size_t)width;
            const size_t row1 = 2 * y + 1 < height ? row0 + (size_t)width : row0;
            const depth_cell a = fine[row0 + (size_t)x0], b = fine[row0 + (size_t)x1],
                             c = fine[row1 + (size_t)x0], d = fine[row1 + (size_t)x1];
            p->depth[level][(size_t)y * (size_t)p->width[level] + (size_t)x] =
                (depth_cell){k_max(k_max(a.nearest, b.nearest), k_max(c.nearest, d.nearest)),
                             k_min(k_min(a.farthest, b.farthest), k_min(c.farthest, d.farthest))};
        }
}

/* Light that cannot be is dark here: a mean must not spread it. */
static float usable(float light) {
    return k_usable(light);
}

static void halve_color(lobe_ssr *s, int level, const float *fine) {
    const pyramid *p = &s->pyramid;
    const int width = p->width[level - 1], height = p->height[level - 1];
#pragma omp parallel for num_threads(s->threads) if (p->width[level] * p->height[level] >=         \
                                                     CELLS_WORTH_THREADS)
    for (int y = 0; y < p->height[level]; y++)
        for (int x = 0; x < p->width[level]; x++)
            for (int k = 0; k < 3; k++) {
                const int x0 = 2 * x, x1 = x0 + 1 < width ? x0 + 1 : x0;
                const size_t row0 = (size_t)(2 * y) * (size_t)width;
                const size_t row1 = 2 * y + 1 < height ? row0 + (size_t)width : row0;
                const size_t at = (size_t)y * (size_t)p->width[level] + (size_t)x;
                p->color[level][3 * at + (size_t)k] =
                    0.25f * (usable(fine[3 * (row0 + (size_t)x0) + (size_t)k]) +
                             usable(fine[3 * (row0 + (size_t)x1) + (size_t)k]) +
                             usable(fine[3 * (row1 + (size_t)x0) + (size_t)k]) +
                             usable(fine[3 * (row1 + (size_t)x1) + (size_t)k]));
            }
}

void lobe_ssr_pass_pyramid(lobe_ssr *s, const lobe_ssr_frame *f) {
    depth_of_pixels(s, f);
    for (int level = 1; level < s->pyramid.levels; level++) {
        halve_depth(s, level);
        if (s->options.resolve == LOBE_SSR_APPROX)
            halve_color(s, level, level == 1 ? f->previous_color : s->pyramid.color[level - 1]);
    }
}
