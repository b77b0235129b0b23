/* Depth pyramid: nearest and farthest of 2 x 2 cells, and of the colours their mean. A level covers the one
 * below to the last row and column: its size is rounded up. */
#include "pipeline.h"

static void depth_of_pixels(lobe_ssr *s, const lobe_ssr_frame *f) {
    const ssr_camera c = lobe_ssr_kernel_camera(s, &f->camera);
#pragma omp parallel for num_threads(s->threads)
    for (size_t i = 0; i < ssr_pixels(s); i++) s->pyramid.depth[0][i] = ssr_cell_of(c, f->z[i]);
}

/* Small levels are faster alone than the start of the threads. */
enum { CELLS_WORTH_THREADS = 1 << 14 };

static void halve_depth(lobe_ssr *s, int level) {
    const pyramid *p = &s->pyramid;
    const int width = p->width[level - 1], height = p->height[level - 1];
    const ssr_cell *fine = p->depth[level - 1];
#pragma omp parallel for num_threads(s->threads) if (p->width[level] * p->height[level] >=         \
                                                     CELLS_WORTH_THREADS)
    for (int y = 0; y < p->height[level]; y++)
        for (int x = 0; x < p->width[level]; x++) {
            const int x0 = 2 * x, x1 = x0 + 1 < width ? x0 + 1 : x0;
            const size_t row0 = (size_t)(2 * y) * (size_t)width;
            const size_t row1 = 2 * y + 1 < height ? row0 + (size_t)width : row0;
            p->depth[level][(size_t)y * (size_t)p->width[level] + (size_t)x] =
                ssr_cell_of_four(fine[row0 + (size_t)x0], fine[row0 + (size_t)x1],
                                 fine[row1 + (size_t)x0], fine[row1 + (size_t)x1]);
        }
}

static void halve_color(lobe_ssr *s, int level, const float *fine) {
    const pyramid *p = &s->pyramid;
    const int width = p->width[level - 1], height = p->height[level - 1];
#pragma omp parallel for num_threads(s->threads) if (p->width[level] * p->height[level] >=         \
                                                     CELLS_WORTH_THREADS)
    for (int y = 0; y < p->height[level]; y++)
        for (int x = 0; x < p->width[level]; x++) {
            const int x0 = 2 * x, x1 = x0 + 1 < width ? x0 + 1 : x0;
            const size_t row0 = (size_t)(2 * y) * (size_t)width;
            const size_t row1 = 2 * y + 1 < height ? row0 + (size_t)width : row0;
            const v3 mean = ssr_mean_light(
                ssr_v3(fine + 3 * (row0 + (size_t)x0)), ssr_v3(fine + 3 * (row0 + (size_t)x1)),
                ssr_v3(fine + 3 * (row1 + (size_t)x0)), ssr_v3(fine + 3 * (row1 + (size_t)x1)));
            memcpy(p->color[level] + 3 * ((size_t)y * (size_t)p->width[level] + (size_t)x), &mean,
                   sizeof mean);
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
