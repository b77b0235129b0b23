/* Where the camera is in each frame. */
#include <math.h>

#include "frames.h"
#include "lobe/random.h"

/* Turned about +Y. */
static v3 turned(v3 a, float degrees) {
    const float s = sinf(degrees * 0.01745329252f), c = cosf(degrees * 0.01745329252f);
    return v3_of(c * a.x + s * a.z, a.y, c * a.z - s * a.x);
}

static v3 by_chance(int index) {
    const lobe_random4 r = lobe_random(0, 0x5b3a, (uint64_t)index);
    return v3_of(lobe_random_unit_f32(r.word[0]) - 0.5f, lobe_random_unit_f32(r.word[1]) - 0.5f,
                 lobe_random_unit_f32(r.word[2]) - 0.5f);
}

lobe_ssr_camera lobe_ssr_frame_camera(const lobe_ssr_frames *f, int index) {
    const v3 target = ssr_in(f->view.target), back = v3_sub(ssr_in(f->view.position), target);
    const float distance = k_max(k_sqrt(v3_dot(back, back)), 1e-6f);
    const int i = index < 0 ? 0 : index;
    v3 from = back;
    if (f->options.path == LOBE_SSR_PATH_ORBIT) from = turned(back, (float)i);
    if (f->options.path == LOBE_SSR_PATH_DOLLY) from = v3_scale(back, powf(0.99f, (float)i));
    if (f->options.path == LOBE_SSR_PATH_SHAKE && i > 0)
        from = v3_add(back, v3_scale(by_chance(i), 0.01f * distance));
    return lobe_ssr_look_at(
        ssr_out(v3_add(target, from)), f->view.target, f->view.up, f->view.vertical_degrees,
        (float)f->options.width / (float)f->options.height, 0.01f * distance, 1000.0f * distance);
}
