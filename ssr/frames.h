/* A sequence of frames of a scene, in the making. */
#ifndef LOBE_SSR_ROOM_FRAMES_H
#define LOBE_SSR_ROOM_FRAMES_H

#include "lobe/ssr_frames.h"
#include "pipeline.h"

enum { ENVIRONMENT_WIDTH = 128, ENVIRONMENT_HEIGHT = 64, ENVIRONMENT_LEVELS = 6 };

/* The scene as a frame shows it. */
typedef struct ssr_moment {
    lobe_scene *scene; /* NULL: the caller's */
    lobe_rays *rays;   /* NULL: there is no such moment */
    lobe_view view;    /* before it goes along the path of the camera */
    int index;         /* of the frame */
} ssr_moment;

/* Where moments come from. */
typedef struct ssr_animation {
    int is_moving; /* 0: `now` is of every frame, and there is no `before` */
    char *source;
    lobe_scene_options options;
    double seconds; /* from frame to frame */
    lobe_view first_view;
} ssr_animation;

struct lobe_ssr_frames {
    ssr_moment now, before;
    ssr_animation animation;
    lobe_ssr_scene_options options;
    int threads;
    float *environment;   /* prefiltered */
    lobe_ssr_frame frame; /* the present one */
    float *z, *normal, *roughness, *f0, *motion, *color, *tangent, *anisotropy;
    float *motion_z;   /* NULL: nothing moves but the camera */
    float *previous_z; /* as seen by the previous camera */
};

/* The first moment; to be freed in any case. */
lobe_ssr_result lobe_ssr_moments_of_scene(lobe_ssr_frames *f, const lobe_scene *scene);
lobe_ssr_result lobe_ssr_moments_of_file(lobe_ssr_frames *f, const char *source,
                                         lobe_scene_options options, double seconds);
void lobe_ssr_moments_free(lobe_ssr_frames *f);

/* Makes `now` and `before` those of a frame. */
lobe_ssr_result lobe_ssr_moments_get(lobe_ssr_frames *f, int index);

/* Of the frame before; of the first frame, and where nothing moves, `now`. */
static inline const ssr_moment *lobe_ssr_moment_before(const lobe_ssr_frames *f) {
    return f->before.rays ? &f->before : &f->now;
}

/* Light from a direction. */
typedef v3 ssr_light(const void *source, v3 direction);

/* What surrounds a scene, for each roughness: ENVIRONMENT_LEVELS pictures; NULL: no memory. */
float *lobe_ssr_prefilter(ssr_light *light, const void *source, int threads);

/* Camera of a frame, and where the one before was seen from: of the present moments. */
lobe_ssr_camera lobe_ssr_frame_camera(const lobe_ssr_frames *f, int index);
lobe_ssr_camera lobe_ssr_previous_camera(const lobe_ssr_frames *f, int index);

/* Runs `row` for all rows in parallel, with progress from `from` to `to`; 0: cancelled. */
int lobe_ssr_rows(lobe_ssr_frames *f, void (*row)(void *work, int y), void *work, double from,
                  double to);

/* A direction from `eye` of length 1, and the length of the vector. */
static inline v3 ssr_unit(v3 d, float *length) {
    *length = k_sqrt(v3_dot(d, d));
    return v3_scale(d, 1.0f / *length);
}

static inline lobe_vec3_f32 ssr_out(v3 a) {
    return (lobe_vec3_f32){a.x, a.y, a.z};
}

static inline v3 ssr_in(lobe_vec3_f32 a) {
    return v3_of(a.x, a.y, a.z);
}

#endif
