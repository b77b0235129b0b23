/* What a frame holds at a pixel. */
#include <math.h>

#include "pipeline.h"

ssr_camera lobe_ssr_camera_of(const lobe_ssr_camera *c, float width, float height) {
    return (ssr_camera){.eye = v3_of(c->eye.x, c->eye.y, c->eye.z),
                        .right = v3_of(c->right.x, c->right.y, c->right.z),
                        .up = v3_of(c->up.x, c->up.y, c->up.z),
                        .forward = v3_of(c->forward.x, c->forward.y, c->forward.z),
                        .tan_x = c->tan_x,
                        .tan_y = c->tan_y,
                        .near_z = c->near_z,
                        .far_z = c->far_z,
                        .width = width,
                        .height = height};
}

ssr_camera lobe_ssr_kernel_camera(const lobe_ssr *s, const lobe_ssr_camera *c) {
    return lobe_ssr_camera_of(c, (float)s->width, (float)s->height);
}

float lobe_ssr_z_at(const lobe_ssr_frame *f, size_t pixel) {
    const float z = f->z[pixel];
    return z > 0.0f && z < f->camera.far_z ? k_max(z, f->camera.near_z) : 0.0f;
}

void lobe_ssr_motion_at(const lobe_ssr_frame *f, size_t pixel, float motion[2]) {
    motion[0] = f->motion ? f->motion[2 * pixel] : 0.0f;
    motion[1] = f->motion ? f->motion[2 * pixel + 1] : 0.0f;
    if (isfinite(motion[0]) && isfinite(motion[1])) return;
    motion[0] = motion[1] = 0.0f;
}

/* Continuous but for one point (Duff et al. 2017). */
v3 lobe_ssr_across(v3 z) {
    const float sign = copysignf(1.0f, z.z), a = -1.0f / (sign + z.z);
    return v3_of(1.0f + sign * z.x * z.x * a, sign * z.x * z.y * a, -sign * z.x);
}

v3 lobe_ssr_cross(v3 a, v3 b) {
    return v3_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* alpha along the axes of the frame, whose x becomes the tangent where that makes a difference. */
static void set_roughness(const lobe_ssr_frame *f, size_t pixel, ssr_surface *surface) {
    const float r = k_saturate(f->roughness[pixel]);
    const float a = f->anisotropy ? f->anisotropy[pixel] : 0.0f;
    surface->alpha_x = surface->alpha_y = r * r;
    if (!f->tangent || !(k_abs(a) > 0.0f) || !isfinite(a)) return;
    const v3 given = ssr_v3(f->tangent + 3 * pixel);
    const v3 across = v3_sub(given, v3_scale(surface->z, v3_dot(given, surface->z)));
    const float length2 = v3_dot(across, across);
    /* also false for what is not a number */
    if (!(length2 > 1e-12f) || !(length2 < 1e12f)) return;
    surface->x = v3_normalize(across);
    surface->y = lobe_ssr_cross(surface->z, surface->x);
    surface->alpha_x *= 1.0f + ssr_clamp(a, -1.0f, 1.0f);
    surface->alpha_y *= 1.0f - ssr_clamp(a, -1.0f, 1.0f);
}

int lobe_ssr_surface_at(const ssr_camera *c, const lobe_ssr_frame *f, int x, int y,
                        ssr_surface *surface) {
    const size_t pixel = (size_t)y * (size_t)c->width + (size_t)x;
    const float z = lobe_ssr_z_at(f, pixel);
    const v3 normal = ssr_v3(f->normal + 3 * pixel);
    const float length2 = v3_dot(normal, normal), roughness = f->roughness[pixel];
    /* also false for what is not a number */
    if (!(z > 0.0f) || !(length2 > 1e-12f) || !(length2 < 1e12f) || !isfinite(roughness)) return 0;
    surface->z = v3_normalize(normal);
    surface->x = lobe_ssr_across(surface->z);
    surface->y = lobe_ssr_cross(surface->z, surface->x);
    set_roughness(f, pixel, surface);
    const v3 view = ssr_view_vector(*c, (float)x + 0.5f, (float)y + 0.5f, z);
    surface->distance = k_sqrt(v3_dot(view, view));
    if (!(surface->distance > 0.0f) || !isfinite(surface->distance)) return 0;
    const v3 to_viewer = v3_scale(view, -1.0f / surface->distance);
    surface->to_viewer = v3_of(v3_dot(to_viewer, surface->x), v3_dot(to_viewer, surface->y),
                               v3_dot(to_viewer, surface->z));
    return surface->to_viewer.z > 0.0f;
}
