/* lobe/ray_bench.h: how near the path tracer comes to the bare ray caster.
 *
 * The rays of a picture (camera, bounces, shadows, in the order of the renderer) are noted, and traced again
 * through Embree alone, one by one, on the same scene by the same number of threads. Rounds of both alternate,
 * so that a slow moment of the machine meets both. A ratio of 1: all time is Embree's. */
#ifndef LOBE_RAY_BENCH_H
#define LOBE_RAY_BENCH_H

#include "render.h"

LOBE_BEGIN_C

typedef struct lobe_ray_bench_options {
    /* Of it count the picture, the paths, the threads and `cancel`; the rest is left at its defaults.
     * A noted ray takes 32 bytes. */
    lobe_render_options render;
    int rounds; /* at least 1 */
    void *user;
    void (*on_progress)(void *user, double share); /* NULL: none */
} lobe_ray_bench_options;

/* Times are medians over the rounds. */
typedef struct lobe_ray_bench {
    uint64_t samples, camera_rays, bounce_rays, shadow_rays;
    uint64_t hits; /* rays that met something, shadow rays among them; the same from both */
    int threads;
    double samples_per_cpu_second;
    double rays_per_cpu_second;     /* of the renderer */
    double raw_rays_per_cpu_second; /* of Embree alone */
    double ratio;  /* processor time of Embree alone / of the renderer, of each round */
    double spread; /* (upper - lower quartile) / median of the ratio */
    double seconds, raw_seconds; /* of the wall clock */
} lobe_ray_bench;

/* LOBE_RENDER_INTERRUPTED by `cancel`. */
LOBE_API lobe_render_result lobe_ray_bench_run(const lobe_scene *scene,
                                               const lobe_ray_bench_options *options,
                                               lobe_ray_bench *result);

LOBE_END_C

#endif
