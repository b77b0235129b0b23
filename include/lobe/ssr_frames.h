/* lobe/ssr_frames.h: frames for lobe/ssr.h, rendered from a scene along a path of the camera, at rest or in motion, and
 * the truth about their reflections by real rays.
 *
 *     lobe_ssr_frames *frames = NULL;
 *     lobe_ssr_frames_of_scene(scene, lobe_ssr_scene_default_options(), &frames);
 *     for (int i = 0; lobe_ssr_frames_get(frames, i, &frame) == LOBE_SSR_OK; i++) ...
 *
 * The colour of the frame before is path-traced through the previous camera, in the scene of its moment; of the first frame
 * the previous camera and moment are its own. Near and far plane: a hundredth of, and a thousand times, the distance from the camera to
 * its target, where a camera path does not say them. */
#ifndef LOBE_SSR_FRAMES_H
#define LOBE_SSR_FRAMES_H

#include <signal.h>

#include "camera_path.h"
#include "rays.h"
#include "ssr.h"

LOBE_BEGIN_C

/* How the camera moves from frame to frame. */
typedef enum lobe_ssr_path {
    LOBE_SSR_PATH_ORBIT, /* one degree about its target */
    LOBE_SSR_PATH_DOLLY, /* one percent of the distance toward its target */
    LOBE_SSR_PATH_SHAKE, /* by chance, up to half a percent of the distance to its target */
    LOBE_SSR_PATH_STILL
} lobe_ssr_path;

/* Called by one thread, a few times a second at least; `fraction` of the present frame, [0, 1]. */
typedef void (*lobe_ssr_progress_function)(void *user, double fraction);

typedef struct lobe_ssr_scene_options {
    int width, height;  /* 640 x 360 */
    int count;          /* frames, 1 to 1000000; 8 */
    lobe_ssr_path path; /* ORBIT */
    const lobe_camera_path
        *cameras;     /* in place of path and camera: `count` of them at least; NULL: none */
    uint32_t samples; /* camera paths a pixel of the colour; 16 */
    float
        roughness; /* of all surfaces in place of their own, perceptual; negative: their own; -1 */
    float anisotropy;   /* the same; above 1: their own; 2 */
    const char *camera; /* of the scene; NULL: its first */
    uint64_t seed;
    int threads; /* 0: as many as OpenMP offers */
    lobe_ssr_progress_function progress;
    void *progress_user;
    const volatile sig_atomic_t *cancel; /* not NULL: work ends soon after *cancel != 0 */
} lobe_ssr_scene_options;

LOBE_API lobe_ssr_scene_options lobe_ssr_scene_default_options(void);

typedef struct lobe_ssr_frames lobe_ssr_frames;

/* The scene and the camera path must outlive *frames, which is to be freed after LOBE_SSR_OK; otherwise it is NULL. */
LOBE_API lobe_ssr_result lobe_ssr_frames_of_scene(const lobe_scene *scene,
                                                  lobe_ssr_scene_options options,
                                                  lobe_ssr_frames **frames);

/* The same of a scene in motion: frame k shows lobe_scene_load(source, scene) with scene.frame_time raised by k * seconds.
 * Motion, colour, history and truth follow what is moved, turned, scaled, bent or seen by an animated camera; a path of
 * the camera is about the view of the frame's moment, or of frame 0 where the file has no camera. Texts that `scene`
 * points to must outlive *frames; warnings are those of the first frame. A source that is not animated is loaded once.
 * LOBE_SSR_BAD_INPUT: frame_time or seconds is not finite. */
LOBE_API lobe_ssr_result lobe_ssr_frames_of_animation(const char *source, lobe_scene_options scene,
                                                      double seconds,
                                                      lobe_ssr_scene_options options,
                                                      lobe_ssr_frames **frames);
LOBE_API void lobe_ssr_frames_free(lobe_ssr_frames *frames); /* NULL is fine */

/* Frame `index`, in any order, best in the natural one. What *frame points to is valid until the next call. */
LOBE_API lobe_ssr_result lobe_ssr_frames_get(lobe_ssr_frames *frames, int index,
                                             lobe_ssr_frame *frame);

/* ---- Truth ----------------------------------------------------------------------------------- */

/* What real rays say of the frame that lobe_ssr_frames_get gave last: `rays` a pixel are drawn from the lobe (one
 * where it is a mirror) and meet the scene. What they meet has the colour of the frame before where it was
 * seen then, and is path-traced elsewhere. rgb: width * height * 3, the mean over the lobe; on_screen:
 * width * height, the share of it that came from the screen. 0 where no reflection is traced. */
LOBE_API lobe_ssr_result lobe_ssr_truth(lobe_ssr_frames *frames, lobe_ssr_mode mode, int rays,
                                        float *rgb, float *on_screen);

typedef struct lobe_ssr_judgement {
    double relmse; /* mean of (a - b)^2 / (b^2 + 0.01) over the pixels with a ray, b the truth */
    double
        relmse_onscreen; /* over those of them whose truth came from the screen for half or more */
    double false_hits;   /* share of the rays that claim to meet what real rays do not, */
    double false_misses; /* and of those that miss what real rays meet on the screen */
    double hit_distance; /* mean over true hits: pixels between what was met and the real place */
    uint64_t pixels, pixels_onscreen;
} lobe_ssr_judgement;

/* Judges the last lobe_ssr_run of `ssr` on the same frame. A hit is right if the real ray meets what is seen there,
 * within three pixels. */
LOBE_API lobe_ssr_judgement lobe_ssr_judge(const lobe_ssr_frames *frames, const lobe_ssr *ssr,
                                           const float *rgb, const float *on_screen);

LOBE_END_C

#endif
