/* app/frames.h: the files of a call that makes several numbered pictures. */
#ifndef LOBE_APP_FRAMES_H
#define LOBE_APP_FRAMES_H

#include <limits.h>
#include <stdbool.h>

enum { LOBE_APP_FRAMES_MAX = 100000, LOBE_APP_FRAME_NAME = PATH_MAX };

/* "a/b.exr" to "a/b.0007.exr"; false: too long. */
bool lobe_app_frame_picture(char name[LOBE_APP_FRAME_NAME], const char *path, int number);

/* "a/c" to "a/c.0007", whatever its ending. */
bool lobe_app_frame_checkpoint(char name[LOBE_APP_FRAME_NAME], const char *path, int number);

#endif
