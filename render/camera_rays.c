#include "camera_rays.h"

#include "circle.h"

camera_rays lobe_camera_rays(const lobe_view *view, int width, int height) {
    const float slope = tanf(0.5f * view->vertical_degrees * (LOBE_PI / 180.0f));
    const vec3 forward =
        v3_normalize_or(v3_sub(view->target, view->position), v3(0.0f, 0.0f, -1.0f));
    const vec3 right = v3_normalize_or(v3_cross(forward, view->up), v3_across(forward));
    return (camera_rays){.eye = view->position,
                         .forward = forward,
                         .right = v3_scale(right, slope * (float)width / (float)height),
                         .up = v3_scale(v3_cross(right, forward), slope)};
}

void lobe_camera_add_lens(camera_rays *c, float radius, float focus) {
    c->lens_right = v3_scale(v3_normalize_or(c->right, v3_across(c->forward)), radius);
    c->lens_up = v3_cross(c->lens_right, c->forward);
    c->closeness = 1.0f / focus;
    c->has_lens = 1;
}

/* Uniform in the unit disk, neighbours stay neighbours (Shirley and Chiu 1997). */
static void disk_at(float u, float v, float *x, float *y) {
    const float a = 2.0f * u - 1.0f, b = 2.0f * v - 1.0f;
    const int is_wide = fabsf(a) > fabsf(b);
    const float radius = is_wide ? a : b;
    const float eighths = radius != 0.0f ? (is_wide ? b / a : 2.0f - a / b) : 0.0f;
    float sine, cosine;
    circle_at(0.125f * eighths, &sine, &cosine);
    *x = radius * cosine;
    *y = radius * sine;
}

void lobe_camera_ray(const camera_rays *c, float x, float y, float u, float v, vec3 *origin,
                     vec3 *direction) {
    /* its end lies at a distance of 1 along the axis */
    vec3 d = v3_add(c->forward, v3_add(v3_scale(c->right, x), v3_scale(c->up, y)));
    *origin = c->eye;
    if (c->has_lens) {
        float across, above;
        disk_at(u, v, &across, &above);
        const vec3 aside = v3_add(v3_scale(c->lens_right, across), v3_scale(c->lens_up, above));
        *origin = v3_add(c->eye, aside);
        d = v3_sub(d, v3_scale(aside, c->closeness));
    }
    *direction = v3_normalize_or(d, c->forward);
}

/* From the eye along `to` to the place of the picture, as lobe_camera_ray has it; 0: there is none. */
static int project(const camera_rays *c, vec3 to, float *x, float *y) {
    const float along = v3_dot(to, c->forward);
    *x = v3_dot(to, c->right) / (v3_dot(c->right, c->right) * along);
    *y = v3_dot(to, c->up) / (v3_dot(c->up, c->up) * along);
    return along > 0.0f && isfinite(*x) && isfinite(*y);
}

void lobe_camera_motion(const camera_rays *now, const camera_rays *before, vec3 origin,
                        vec3 direction, float distance, float motion[2]) {
    const vec3 place = v3_add(origin, v3_scale(direction, distance));
    const int is_far = distance == 0.0f;
    float x, y, old_x, old_y;
    const int is_seen =
        project(now, is_far ? direction : v3_sub(place, now->eye), &x, &y) &&
        project(before, is_far ? direction : v3_sub(place, before->eye), &old_x, &old_y);
    motion[0] = is_seen ? 0.5f * (x - old_x) : 2.0f;
    motion[1] = is_seen ? 0.5f * (old_y - y) : 0.0f;
}
