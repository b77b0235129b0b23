/* The state of the pipeline, and its passes: one file each. A pass runs over rows in parallel; no pixel
 * reads what the same pass writes, so the bits do not depend on the number of threads. */
#ifndef LOBE_SSR_PIPELINE_H
#define LOBE_SSR_PIPELINE_H

#include <string.h>

#include "lobe/ssr.h"
#include "passes/bind_c.h"

enum { SSR_LEVELS_MAX = 17 }; /* 32768 pixels down to one */

typedef struct pyramid {
    int levels;
    int width[SSR_LEVELS_MAX], height[SSR_LEVELS_MAX];
    ssr_cell *depth[SSR_LEVELS_MAX];
    float *color
        [SSR_LEVELS_MAX]; /* r, g, b; level 0 is the frame's, the others are made for APPROX only */
} pyramid;

struct lobe_ssr {
    int width, height, threads;
    lobe_ssr_options options;
    uint64_t frame; /* number of the present one */
    ssr_noise_keys noise;
    pyramid pyramid;
    lobe_ssr_ray *rays;
    float *found; /* per ray: r, g, b at what was met, and the fade there; 0: nothing */
    float *resolved, *reflection, *history; /* r, g, b times opacity; opacity */
    float *last_z;                          /* of the frame before; 0: none */
    float *radiance, *composite;
    const struct ssr_driver *driver;
    void *driver_state;
    char device[512]; /* its name */
};

static inline size_t ssr_pixels(const lobe_ssr *s) {
    return (size_t)s->width * (size_t)s->height;
}

static inline ssr_reflected ssr_reflected_at(const float *values) {
    return (ssr_reflected){v3_of(values[0], values[1], values[2]), values[3]};
}

static inline void ssr_put_reflected(float *values, ssr_reflected l) {
    memcpy(values, &l, sizeof l);
}

static inline v3 ssr_v3(const float *values) {
    return v3_of(values[0], values[1], values[2]);
}

ssr_camera lobe_ssr_camera_of(const lobe_ssr_camera *c, float width, float height);
ssr_camera lobe_ssr_kernel_camera(const lobe_ssr *s, const lobe_ssr_camera *c);

/* Whether a camera can be used: see lobe_ssr_camera. */
int lobe_ssr_is_camera(const lobe_ssr_camera *c);

/* 0: no surface there. */
float lobe_ssr_z_at(const lobe_ssr_frame *f, size_t pixel);

/* Motion of a place that does not move itself and is seen at pixel (x, y) now. */
void lobe_ssr_motion_of(const ssr_camera *now, const ssr_camera *before, int x, int y, v3 place,
                        float motion[2]);

/* 0: none there, not seen from the front. */
int lobe_ssr_surface_at(const ssr_camera *c, const lobe_ssr_frame *f, int x, int y,
                        ssr_surface *surface);

/* What the random numbers of this frame are made of. */
ssr_noise_keys lobe_ssr_noise_keys(uint64_t seed, uint64_t frame);

/* Light at a direction, 0 without an environment. */
v3 lobe_ssr_environment_at(const lobe_ssr_environment *e, v3 direction, float roughness);

/* The passes, in order. */
void lobe_ssr_pass_pyramid(lobe_ssr *s, const lobe_ssr_frame *f);
void lobe_ssr_pass_trace(lobe_ssr *s, const lobe_ssr_frame *f, lobe_ssr_statistics *statistics);
void lobe_ssr_pass_reproject(lobe_ssr *s, const lobe_ssr_frame *f);
void lobe_ssr_pass_resolve(lobe_ssr *s, const lobe_ssr_frame *f);
void lobe_ssr_pass_accumulate(lobe_ssr *s, const lobe_ssr_frame *f);
void lobe_ssr_pass_composite(lobe_ssr *s, const lobe_ssr_frame *f);

#endif
