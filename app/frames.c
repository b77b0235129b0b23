#include "frames.h"

#include <math.h>
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

lobe_app_status lobe_app_check_shapes(const char *file, const lobe_camera_path *path,
                                      lobe_app_size size) {
    const double wanted = (double)size.width / size.height;
    for (int i = 0; i < lobe_camera_path_count(path); i++) {
        const lobe_path_camera *c = &lobe_camera_path_get(path, i)->camera;
        const double shape = c->tan_x > 0 ? (double)c->tan_x / (double)c->tan_y : wanted;
        if (!(fabs(shape / wanted - 1) <= 0.01))
            return lobe_app_reject(file, "give a --size of that shape",
                                   "the picture of camera %d is %.4g times as wide as high, "
                                   "not %.4g",
                                   i + 1, shape, wanted);
    }
    return LOBE_APP_DONE;
}
