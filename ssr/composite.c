/* Composite: what the screen does not show comes from the environment. */
#include "lobe/fresnel.h"
#include "pipeline.h"

static float f0_at(const lobe_ssr_frame *f, size_t pixel, size_t k) {
    const float f0 = f->f0 ? f->f0[3 * pixel + k] : 1.0f;
    return f0 >= 0.0f ? k_min(f0, 1.0f) : 0.0f;
}

static void composite_pixel(lobe_ssr *s, const lobe_ssr_frame *f, const ssr_camera *c, int x,
                            int y) {
    const size_t pixel = (size_t)y * (size_t)s->width + (size_t)x;
    const float *reflection = s->reflection + 4 * pixel;
    float *radiance = s->radiance + 3 * pixel, *composite = s->composite + 3 * pixel;
    for (int k = 0; k < 3; k++) radiance[k] = composite[k] = 0.0f;
    ssr_surface surface;
    if ((f->mask && !f->mask[pixel]) || !lobe_ssr_surface_at(c, f, x, y, &surface)) return;
    const v3 v = surface.to_viewer;
    const v3 mirrored = v3_combine(surface.x, -v.x, surface.y, -v.y, surface.z, v.z);
    const v3 light = lobe_ssr_environment_at(&f->environment, mirrored, f->roughness[pixel]);
    const float fallback[3] = {light.x, light.y, light.z};
    for (size_t k = 0; k < 3; k++) {
        radiance[k] = reflection[k] + (1.0f - reflection[3]) * fallback[k];
        composite[k] = radiance[k] * lobe_fresnel_schlick_f32(f0_at(f, pixel, k), v.z);
    }
}

void lobe_ssr_pass_composite(lobe_ssr *s, const lobe_ssr_frame *f) {
    const ssr_camera c = lobe_ssr_kernel_camera(s, &f->camera);
#pragma omp parallel for num_threads(s->threads)
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) composite_pixel(s, f, &c, x, y);
}
