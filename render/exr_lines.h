/* Scan lines of an OpenEXR file by the C core. */
#ifndef LOBE_RENDER_EXR_LINES_H
#define LOBE_RENDER_EXR_LINES_H

#include <OpenEXR/openexr.h>

#include "lobe/render.h"

/* Tell the channels of `pipe` where line `line`, from 0, and those after it go. */
typedef void exr_aim(exr_decode_pipeline_t *pipe, int line, void *user);

/* Decode `height` lines from `top` on. */
exr_result_t lobe_exr_decode(exr_context_t file, int top, int height, exr_aim *aim, void *user);

/* Open without a word on standard error. On failure *file is NULL. */
lobe_render_result lobe_exr_open(const char *path, exr_context_t *file);

#endif
