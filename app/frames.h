/* app/frames.h: what commands that make several pictures have in common. */
#ifndef LOBE_APP_FRAMES_H
#define LOBE_APP_FRAMES_H

#include <limits.h>
#include <stdbool.h>

#include <lobe/camera_path.h>

#include "options.h"

enum { LOBE_APP_FRAMES_MAX = 100000, LOBE_APP_FRAME_NAME = PATH_MAX };

/* "a/b.exr" to "a/b.0007.exr"; false: too long. */
bool lobe_app_frame_picture(char name[LOBE_APP_FRAME_NAME], const char *path, int number);

/* "a/c" to "a/c.0007", whatever its ending. */
bool lobe_app_frame_checkpoint(char name[LOBE_APP_FRAME_NAME], const char *path, int number);

/* A camera with a matrix has a picture of one shape: bad input if it is not that of `size`. */
lobe_app_status lobe_app_check_shapes(const char *file, const lobe_camera_path *path,
                                      lobe_app_size size);

#endif
