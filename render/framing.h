/* A camera for a scene that brings none. */
#ifndef LOBE_RENDER_FRAMING_H
#define LOBE_RENDER_FRAMING_H

#include "scene.h"

/* Adds one that looks at the whole scene from the front, a little from above, with some room around it. */
void lobe_scene_frame_automatically(lobe_scene *s);

/* The vertical angle of its picture of width/height `aspect`. */
float lobe_framed_degrees(float aspect);

#endif
