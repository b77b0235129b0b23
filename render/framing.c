#include "framing.h"

/* Of the picture, and from where to look: a little from above. */
static const float degrees = 38.0f, room_around = 1.08f;
static const vec3 front = {0.45f, 0.35f, 1.0f}, upward = {0.0f, 1.0f, 0.0f};

/* How far from `centre`, in the direction of f->z, a square picture has to be taken to hold the whole box:
 * `slope` is the tangent of half its angle. */
static float distance_to_hold(const lobe_scene *s, vec3 centre, const frame *f, float slope) {
    float distance = 0.0f;
    for (int corner = 0; corner < 8; corner++) {
        const vec3 p = {corner & 1 ? s->high.x : s->low.x, corner & 2 ? s->high.y : s->low.y,
                        corner & 4 ? s->high.z : s->low.z};
        const vec3 local = frame_to_local(f, v3_sub(p, centre));
        const float aside = fmaxf(fabsf(local.x), fabsf(local.y));
        distance = fmaxf(distance, local.z + aside / slope);
    }
    return distance;
}

static vec3 centre_of(const lobe_scene *s) {
    return v3_lerp(s->low, s->high, 0.5f);
}

static float distance_from(const lobe_scene *s, vec3 from) {
    const frame f = frame_of(from, v3_cross(upward, from));
    const float slope = tanf(0.5f * degrees * (LOBE_PI / 180.0f)) / room_around;
    return fmaxf(distance_to_hold(s, centre_of(s), &f, slope), 1e-6f);
}

void lobe_scene_frame_automatically(lobe_scene *s) {
    const vec3 centre = centre_of(s), from = v3_normalize_or(front, v3(0.0f, 0.0f, 1.0f));
    lobe_scene_add_camera(s, "", v3_add(centre, v3_scale(from, distance_from(s, from))), centre,
                          upward, degrees);
    s->is_framed = 1;
}

/* A square of the width of a picture that is higher than wide shows what a square picture does. */
float lobe_framed_degrees(float aspect) {
    if (!(aspect > 0.0f && aspect < 1.0f)) return degrees;
    const float slope = tanf(0.5f * degrees * (LOBE_PI / 180.0f)) / aspect;
    return 2.0f * atanf(slope) * (180.0f / LOBE_PI);
}

/* ---- From all sides -------------------------------------------------------------------------- */

/* A turn about an axis along +Y, counter-clockwise from above. */
typedef struct turn {
    double sine, cosine;
} turn;

static turn turn_of(int index, int count) {
    const double angle = 6.283185307179586 * index / count;
    return (turn){sin(angle), cos(angle)};
}

static vec3 turned(turn t, vec3 centre, vec3 p) {
    const double x = (double)p.x - (double)centre.x, z = (double)p.z - (double)centre.z;
    return v3((float)((double)centre.x + (t.cosine * x + t.sine * z)), p.y,
              (float)((double)centre.z + (t.cosine * z - t.sine * x)));
}

/* A box that just fits from the front may not do so from its corner. */
static vec3 place_for_all_sides(const lobe_scene *s) {
    enum { SIDES = 256 };
    const vec3 centre = centre_of(s), from = v3_normalize_or(front, v3(0.0f, 0.0f, 1.0f));
    float distance = 0.0f;
    for (int i = 0; i < SIDES; i++)
        distance = fmaxf(distance, distance_from(s, turned(turn_of(i, SIDES), v3_all(0.0f), from)));
    return v3_add(centre, v3_scale(from, distance));
}

lobe_render_result lobe_scene_orbit(const lobe_scene *scene, const char *camera, float aspect,
                                    int index, int count, lobe_view *view) {
    if (count < 1 || index < 0 || index >= count)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "orbit: there is no view %d of %d; count from 0",
                         index, count);
    const lobe_render_result result = lobe_scene_view(scene, camera, aspect, view);
    if (result != LOBE_RENDER_OK) return result;
    if (scene->is_framed) view->position = place_for_all_sides(scene);
    const turn t = turn_of(index, count);
    const vec3 centre = centre_of(scene);
    view->position = turned(t, centre, view->position);
    view->target = turned(t, centre, view->target);
    view->up = turned(t, v3_all(0.0f), view->up);
    return LOBE_RENDER_OK;
}
