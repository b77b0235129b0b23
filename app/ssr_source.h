/* app/ssr_source.h: where `lobe ssr` has its frames from: a scene, or a folder of docs/gbuffer.md. */
#ifndef LOBE_APP_SSR_SOURCE_H
#define LOBE_APP_SSR_SOURCE_H

#include <stdbool.h>

#include <lobe/ssr_folder.h>
#include <lobe/ssr_frames.h>

#include "report.h"

typedef struct lobe_app_ssr_source {
    lobe_scene *scene;       /* NULL: of the folder, or of the frames */
    lobe_ssr_frames *frames; /* of the scene; NULL: of the folder */
    lobe_ssr_folder *folder;
    lobe_ssr_folder_writer *writer; /* NULL: frames are not written */
} lobe_app_ssr_source;

bool lobe_app_is_folder(const char *path);

/* Reports the message of lobe/ssr.h; the status that it means. */
lobe_app_status lobe_app_ssr_status(lobe_ssr_result result);

/* Those of a scene at rest; warnings are reported. */
lobe_scene_options lobe_app_ssr_scene_options(void);

lobe_app_status lobe_app_load_ssr_scene(lobe_app_ssr_source *source, const char *name,
                                        lobe_scene_options options);
void lobe_app_close_ssr_source(lobe_app_ssr_source *source);

/* Frame `index`, written too where that is asked for. */
lobe_ssr_result lobe_app_get_ssr_frame(lobe_app_ssr_source *source, int index,
                                       lobe_ssr_frame *frame);

#endif
