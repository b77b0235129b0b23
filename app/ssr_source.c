#include "ssr_source.h"

#include <sys/stat.h>

bool lobe_app_is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

lobe_app_status lobe_app_ssr_status(lobe_ssr_result result) {
    if (result == LOBE_SSR_OK) return LOBE_APP_DONE;
    if (result == LOBE_SSR_INTERRUPTED) return LOBE_APP_INTERRUPTED;
    lobe_app_report_line(lobe_ssr_error_message());
    return result == LOBE_SSR_BAD_INPUT ? LOBE_APP_BAD_INPUT : LOBE_APP_FAILED;
}

static void print_warning(void *user, const char *message) {
    (void)user;
    lobe_app_report_line(message);
}

lobe_scene_options lobe_app_ssr_scene_options(void) {
    lobe_scene_options options = lobe_scene_default_options();
    options.warning = print_warning;
    return options;
}

lobe_app_status lobe_app_load_ssr_scene(lobe_app_ssr_source *source, const char *name,
                                        lobe_scene_options options) {
    const lobe_render_result loaded = lobe_scene_load(name, options, &source->scene);
    if (loaded == LOBE_RENDER_OK) return LOBE_APP_DONE;
    lobe_app_report_line(lobe_render_error_message());
    return loaded == LOBE_RENDER_BAD_INPUT ? LOBE_APP_BAD_INPUT : LOBE_APP_FAILED;
}

void lobe_app_close_ssr_source(lobe_app_ssr_source *source) {
    lobe_ssr_frames_free(source->frames);
    lobe_ssr_folder_free(source->folder);
    lobe_scene_free(source->scene);
}

lobe_ssr_result lobe_app_get_ssr_frame(lobe_app_ssr_source *source, int index,
                                       lobe_ssr_frame *frame) {
    lobe_ssr_result result = source->folder ? lobe_ssr_folder_get(source->folder, index, frame)
                                            : lobe_ssr_frames_get(source->frames, index, frame);
    if (result == LOBE_SSR_OK && source->writer)
        result = lobe_ssr_folder_add(source->writer, frame);
    return result;
}
