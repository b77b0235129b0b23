/* A camera for pictures of one shape: from a place of the picture to a ray, and back. */
#ifndef LOBE_RENDER_CAMERA_RAYS_H
#define LOBE_RENDER_CAMERA_RAYS_H

#include "lobe/render.h"
#include "vector.h"

typedef struct camera_rays {
    vec3 eye, forward, right, up; /* right and up reach to the edge of the picture */
    vec3 lens_right, lens_up;     /* radii of the lens */
    float closeness;              /* 1/distance of the plane that is sharp */
    int has_lens;
} camera_rays;

/* A pinhole. */
camera_rays lobe_camera_rays(const lobe_view *view, int width, int height);

/* Put a thin lens into the pinhole, sharp at `focus` along the axis. */
void lobe_camera_add_lens(camera_rays *c, float radius, float focus);

/* The ray of the place (x, y) of the picture, each from -1 to 1, y upward; u and v in [0, 1) choose the place on the
 * lens. */
void lobe_camera_ray(const camera_rays *c, float x, float y, float u, float v, vec3 *origin,
                     vec3 *direction);

/* How far a place of the picture of `now` has moved since `before`, in widths to the right and heights down; (2, 0) where
 * it was behind the camera, which is off every picture. A lens does not count. `distance` of the place along a ray of
 * `now`; 0: at infinity. */
void lobe_camera_motion(const camera_rays *now, const camera_rays *before, vec3 origin,
                        vec3 direction, float distance, float motion[2]);

#endif
