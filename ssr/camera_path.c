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

static lobe_ssr_camera camera_of(const lobe_ssr_frames *f, const lobe_view *v, float distance) {
    return lobe_ssr_look_at(v->position, v->target, v->up, v->vertical_degrees,
                            (float)f->options.width / (float)f->options.height, 0.01f * distance,
                            1000.0f * distance);
}

static float distance_to(v3 to) {
    return k_max(k_sqrt(v3_dot(to, to)), 1e-6f);
}

/* What a file says. */
static lobe_ssr_camera given(const lobe_ssr_frames *f, const lobe_path_camera *from) {
    const v3 to = v3_sub(ssr_in(from->view.target), ssr_in(from->view.position));
    lobe_ssr_camera c = camera_of(f, &from->view, distance_to(to));
    if (from->near_z > 0.0f && from->near_z < from->far_z && from->far_z < 1e30f) {
        c.near_z = from->near_z;
        c.far_z = from->far_z;
    }
    return c;
}

/* What a rule says. */
static lobe_ssr_camera moved(const lobe_ssr_frames *f, lobe_view view, int index) {
    const v3 target = ssr_in(view.target), back = v3_sub(ssr_in(view.position), target);
    const float distance = distance_to(back);
    v3 from = back;
    if (f->options.path == LOBE_SSR_PATH_ORBIT) from = turned(back, (float)index);
    if (f->options.path == LOBE_SSR_PATH_DOLLY) from = v3_scale(back, powf(0.99f, (float)index));
    if (f->options.path == LOBE_SSR_PATH_SHAKE && index > 0)
        from = v3_add(back, v3_scale(by_chance(index), 0.01f * distance));
    view.position = ssr_out(v3_add(target, from));
    return camera_of(f, &view, distance);
}

lobe_ssr_camera lobe_ssr_frame_camera(const lobe_ssr_frames *f, int index) {
    const lobe_camera_path *cameras = f->options.cameras;
    return cameras ? given(f, &lobe_camera_path_get(cameras, index)->camera)
                   : moved(f, f->now.view, index);
}

lobe_ssr_camera lobe_ssr_previous_camera(const lobe_ssr_frames *f, int index) {
    const lobe_camera_path *cameras = f->options.cameras;
    if (cameras) return given(f, &lobe_camera_path_get(cameras, index)->previous);
    return moved(f, lobe_ssr_moment_before(f)->view, index > 0 ? index - 1 : 0);
}
