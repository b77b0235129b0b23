#include "frames.h"

#include <stdio.h>
#include <string.h>

static bool number_name(char *name, const char *path, size_t stem, int number) {
    const int length =
        snprintf(name, LOBE_APP_FRAME_NAME, "%.*s.%04d%s", (int)stem, path, number, path + stem);
    return length > 0 && length < LOBE_APP_FRAME_NAME;
}

bool lobe_app_frame_picture(char name[LOBE_APP_FRAME_NAME], const char *path, int number) {
    const char *slash = strrchr(path, '/'), *file = slash ? slash + 1 : path;
    const char *dot = strrchr(file, '.');
    return number_name(name, path, dot ? (size_t)(dot - path) : strlen(path), number);
}

bool lobe_app_frame_checkpoint(char name[LOBE_APP_FRAME_NAME], const char *path, int number) {
    return number_name(name, path, strlen(path), number);
}
