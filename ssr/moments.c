/* The scene of each frame: the same one, or a file at its moments. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frames.h"
#include "message.h"

/* An error of the renderer becomes one of this room. */
static lobe_ssr_result pass_on(lobe_render_result result) {
    const lobe_ssr_result own = result == LOBE_RENDER_INTERRUPTED ? LOBE_SSR_INTERRUPTED
                                : result == LOBE_RENDER_BAD_INPUT ? LOBE_SSR_BAD_INPUT
                                                                  : LOBE_SSR_FAILED;
    return lobe_ssr_fail(own, "%s", lobe_render_error_message());
}

static void close_moment(ssr_moment *m) {
    lobe_rays_free(m->rays);
    lobe_scene_free(m->scene);
    *m = (ssr_moment){0};
}

/* The view of a scene that has no camera is made for the first frame: it would jump with the box around all. */
static lobe_render_result find_view(const lobe_ssr_frames *f, const lobe_scene *scene,
                                    lobe_view *view) {
    const lobe_ssr_scene_options *o = &f->options;
    if (o->cameras) return LOBE_RENDER_OK;
    if (f->now.rays && !lobe_scene_camera_name(scene, 0)) {
        *view = f->animation.first_view;
        return LOBE_RENDER_OK;
    }
    return lobe_scene_view(scene, o->camera, (float)o->width / (float)o->height, view);
}

/* Of a scene; *m is nothing after a failure. */
static lobe_ssr_result open_moment(const lobe_ssr_frames *f, const lobe_scene *scene,
                                   ssr_moment *m) {
    lobe_render_result result = find_view(f, scene, &m->view);
    if (result == LOBE_RENDER_OK) result = lobe_rays_create(scene, &m->rays);
    if (result == LOBE_RENDER_OK) return LOBE_SSR_OK;
    close_moment(m);
    return pass_on(result);
}

static lobe_ssr_result load_moment(const lobe_ssr_frames *f, int index, ssr_moment *m) {
    lobe_scene_options options = f->animation.options;
    *m = (ssr_moment){.index = index};
    options.frame_time += index * f->animation.seconds;
    options.cancel = f->options.cancel;
    if (f->now.rays) options.warning = NULL; /* the first one has said it all */
    const lobe_render_result loaded = lobe_scene_load(f->animation.source, options, &m->scene);
    return loaded == LOBE_RENDER_OK ? open_moment(f, m->scene, m) : pass_on(loaded);
}

lobe_ssr_result lobe_ssr_moments_of_scene(lobe_ssr_frames *f, const lobe_scene *scene) {
    return open_moment(f, scene, &f->now);
}

static int is_animated(const lobe_scene *scene) {
    for (size_t i = 0; i < lobe_scene_item_count(scene); i++)
        if (lobe_scene_get_item(scene, i)->part == LOBE_SCENE_ANIMATION) return 1;
    return 0;
}

lobe_ssr_result lobe_ssr_moments_of_file(lobe_ssr_frames *f, const char *source,
                                         lobe_scene_options options, double seconds) {
    if (!isfinite(options.frame_time) || !isfinite(seconds))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "%s: the moment of a frame is not a number; use seconds", source);
    f->animation.options = options;
    f->animation.seconds = seconds;
    f->animation.source = strdup(source);
    if (!f->animation.source) return lobe_ssr_fail_memory(source);
    const lobe_ssr_result result = load_moment(f, 0, &f->now);
    if (result != LOBE_SSR_OK) return result;
    f->animation.first_view = f->now.view;
    f->animation.is_moving = is_animated(f->now.scene);
    return LOBE_SSR_OK;
}

/* One scene is let go before another is loaded: no more than two are in memory. After a failure `now` is what it was. */
lobe_ssr_result lobe_ssr_moments_get(lobe_ssr_frames *f, int index) {
    const int last = index > 0 ? index - 1 : 0;
    ssr_moment fresh;
    if (!f->animation.is_moving) return LOBE_SSR_OK;
    if (f->now.index == index && lobe_ssr_moment_before(f)->index == last) return LOBE_SSR_OK;
    close_moment(&f->before);
    lobe_ssr_result result = LOBE_SSR_OK;
    if (f->now.index != last) {
        result = load_moment(f, last, &fresh);
        if (result != LOBE_SSR_OK) return result;
        close_moment(&f->now);
        f->now = fresh;
    }
    if (index == last) return LOBE_SSR_OK;
    result = load_moment(f, index, &fresh);
    if (result != LOBE_SSR_OK) return result;
    f->before = f->now;
    f->now = fresh;
    return LOBE_SSR_OK;
}

void lobe_ssr_moments_free(lobe_ssr_frames *f) {
    close_moment(&f->before);
    close_moment(&f->now);
    free(f->animation.source);
}
