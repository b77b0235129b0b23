/* Cameras and lights of a file that is being imported. */
#ifndef LOBE_RENDER_IMPORT_CAMERA_H
#define LOBE_RENDER_IMPORT_CAMERA_H

#include "scene.h"

struct aiScene;

/* To be called while the file still has its nodes: baking them renames the cameras. */
void lobe_import_cameras(lobe_scene *s, const struct aiScene *file);
void lobe_import_lights(lobe_scene *s, const struct aiScene *file);

#endif
