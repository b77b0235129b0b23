/* lobe/camera_path.h: a camera for each picture of a sequence, from a JSON file: the one of a folder of frames
 * (docs/gbuffer.md), or one written by hand (docs/camera.md).
 *
 *     lobe_camera_path *path = NULL;
 *     if (lobe_camera_path_read("path.json", &path) != LOBE_RENDER_OK) ...
 *     for (int i = 0; i < lobe_camera_path_count(path); i++) {
 *         options.view = &lobe_camera_path_get(path, i)->camera.view;
 *         ...
 *     }
 *     lobe_camera_path_free(path);
 */
#ifndef LOBE_CAMERA_PATH_H
#define LOBE_CAMERA_PATH_H

#include "render.h"

LOBE_BEGIN_C

/* What the file does not say is 0. */
typedef struct lobe_path_camera {
    lobe_view view;
    /* Where it has a matrix: unit vectors, each across the others within 0.01, and the tangents of half the angles of view,
     * above 0 and below 1e6. */
    lobe_vec3_f32 right, up, backward;
    float tan_x, tan_y;
    float near_z, far_z; /* any number */
    float focus;         /* 1e-15 to 1e15 */
} lobe_path_camera;

typedef struct lobe_path_frame {
    lobe_path_camera camera, previous; /* previous: of the frame before; of the first its own */
} lobe_path_frame;

typedef struct lobe_camera_path lobe_camera_path;

#define LOBE_CAMERA_PATH_FRAMES_MAX 1000000

/* *path is to be freed after LOBE_RENDER_OK; otherwise it is NULL. */
LOBE_API lobe_render_result lobe_camera_path_read(const char *file, lobe_camera_path **path);
LOBE_API void lobe_camera_path_free(lobe_camera_path *path); /* NULL is fine */

LOBE_API int lobe_camera_path_count(const lobe_camera_path *path); /* 1 at least */
LOBE_API const lobe_path_frame *lobe_camera_path_get(const lobe_camera_path *path,
                                                     int index); /* out of range: NULL */

LOBE_END_C

#endif
