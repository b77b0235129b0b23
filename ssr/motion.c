/* How far a place has moved on the screen since the frame before. */
#include "pipeline.h"

void lobe_ssr_motion_of(const ssr_camera *now, const ssr_camera *before, int x, int y, v3 place,
                        float motion[2]) {
    const v3 was = ssr_project(*before, place);
    motion[0] = motion[1] = 0.0f;
    if (!(was.z > 0.0f)) {
        motion[0] = 2.0f; /* off every screen */
        return;
    }
    motion[0] = ((float)x + 0.5f - was.x) / now->width;
    motion[1] = ((float)y + 0.5f - was.y) / now->height;
}
