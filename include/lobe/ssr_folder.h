/* lobe/ssr_folder.h: frames for lobe/ssr.h in a folder: gbuffer.json (cameras) and OpenEXR pictures, of this
 * program or of any renderer. docs/gbuffer.md says what is in them.
 *
 *     lobe_ssr_folder *folder = NULL;
 *     if (lobe_ssr_folder_open("gbuffer", &folder) != LOBE_SSR_OK) ...
 *     for (int i = 0; lobe_ssr_folder_get(folder, i, &frame) == LOBE_SSR_OK; i++) ...
 *     lobe_ssr_folder_free(folder);
 */
#ifndef LOBE_SSR_FOLDER_H
#define LOBE_SSR_FOLDER_H

#include "ssr.h"

LOBE_BEGIN_C

typedef struct lobe_ssr_folder lobe_ssr_folder;

/* Reads gbuffer.json and the environment. *folder is to be freed after LOBE_SSR_OK; otherwise it is NULL. */
LOBE_API lobe_ssr_result lobe_ssr_folder_open(const char *path, lobe_ssr_folder **folder);
LOBE_API void lobe_ssr_folder_free(lobe_ssr_folder *folder); /* NULL is fine */

LOBE_API int lobe_ssr_folder_width(const lobe_ssr_folder *folder);
LOBE_API int lobe_ssr_folder_height(const lobe_ssr_folder *folder);
LOBE_API int lobe_ssr_folder_count(const lobe_ssr_folder *folder); /* frames, 1 at least */

/* Reads the pictures of frame `index`. What *frame points to is valid until the next call. */
LOBE_API lobe_ssr_result lobe_ssr_folder_get(lobe_ssr_folder *folder, int index,
                                             lobe_ssr_frame *frame);

/* ---- Writing --------------------------------------------------------------------------------- */

typedef struct lobe_ssr_folder_writer lobe_ssr_folder_writer;

/* Into a folder that exists; of a folder that was there already, gbuffer.json is replaced at the end. */
LOBE_API lobe_ssr_result lobe_ssr_folder_begin(const char *path, int width, int height,
                                               lobe_ssr_folder_writer **writer);

/* The next frame; reading it back gives the same bits. The environment of the first one is written, for all. */
LOBE_API lobe_ssr_result lobe_ssr_folder_add(lobe_ssr_folder_writer *writer,
                                             const lobe_ssr_frame *frame);

/* Writes gbuffer.json if there is a frame, and frees the writer (NULL is fine). */
LOBE_API lobe_ssr_result lobe_ssr_folder_finish(lobe_ssr_folder_writer *writer);

LOBE_END_C

#endif
