/* What a frame holds at a pixel. */
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
    return ssr_usable_z(f->z[pixel], f->camera.near_z, f->camera.far_z);
}

static ssr_material material_at(const lobe_ssr_frame *f, size_t pixel) {
    ssr_material m = ssr_material_of(ssr_v3(f->normal + 3 * pixel), f->roughness[pixel]);
    if (!f->anisotropy || !f->tangent) return m;
    m.anisotropy = f->anisotropy[pixel];
    m.tangent = ssr_v3(f->tangent + 3 * pixel);
    return m;
}

int lobe_ssr_surface_at(const ssr_camera *c, const lobe_ssr_frame *f, int x, int y,
                        ssr_surface *surface) {
    const size_t pixel = (size_t)y * (size_t)c->width + (size_t)x;
    *surface = ssr_surface_of(*c, (float)x + 0.5f, (float)y + 0.5f, lobe_ssr_z_at(f, pixel),
                              material_at(f, pixel));
    return surface->seen;
}
