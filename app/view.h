/* app/view.h: what `lobe render` and `lobe compare` have in common: the options that say what is seen and how
 * light is followed, and what the renderer's answers mean. */
#ifndef LOBE_APP_VIEW_H
#define LOBE_APP_VIEW_H

#include <stdint.h>

#include <lobe/render.h>

#include "model.h"
#include "options.h"

/* One of the two, or none: a pinhole. */
typedef struct lobe_app_aperture {
    double radius, f_number;
} lobe_app_aperture;

typedef struct lobe_app_view {
    lobe_app_size size;
    const char *environment, *camera;
    uint64_t depth, seed, threads;
    const char *animation;
    lobe_app_aperture aperture;
    double focus; /* NaN: not given */
    double exposure, rotation, material[5], floor, frame_time;
    int ndf, masking, g2, normalization, heuristic, multiscatter;
    lobe_metal metal;
    bool strict, ground;
} lobe_app_view;

/* Each fills a lobe_app_view. */
extern const lobe_app_option lobe_app_camera_options[], lobe_app_scene_options[],
    lobe_app_path_options[];

/* Rows of a table of lobe_app_group; VIEW is the address of the lobe_app_view. */
#define LOBE_APP_VIEW_GROUPS(VIEW)                                                                 \
    {"View", lobe_app_camera_options, VIEW}, {"Scene", lobe_app_scene_options, VIEW}, {            \
        "Paths", lobe_app_path_options, VIEW                                                       \
    }

lobe_app_view lobe_app_default_view(void);
lobe_app_status lobe_app_check_view(const lobe_app_view *view);

/* The row of the list of models; method LOBE_METHOD_COUNT: by surface where that choice is known, else the best
 * of the model. */
lobe_app_status lobe_app_choose_render_model(const lobe_app_view *view, int method,
                                             lobe_model *model);

/* Everything but the model's method, samples, channels and progress; an interrupt cancels. */
lobe_render_options lobe_app_view_render_options(const lobe_app_view *view);

/* Warnings go to standard error. */
lobe_scene_options lobe_app_view_scene_options(const lobe_app_view *view);

/* Shows how far the tree is; `progress` is a lobe_app_progress_mode. */
lobe_render_result lobe_app_load_scene(const lobe_app_view *view, int progress, const char *source,
                                       lobe_scene **scene);

/* Reports the renderer's message; the status that it means. */
lobe_app_status lobe_app_render_failed(lobe_render_result result);

#endif
