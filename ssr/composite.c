/* Composite: what the screen does not show comes from the environment. */
#include "pipeline.h"

static void composite_pixel(lobe_ssr *s, const lobe_ssr_frame *f, const ssr_camera *c, int x,
                            int y) {
    const size_t pixel = (size_t)y * (size_t)s->width + (size_t)x;
    float *radiance = s->radiance + 3 * pixel, *composite = s->composite + 3 * pixel;
    for (int k = 0; k < 3; k++) radiance[k] = composite[k] = 0.0f;
    ssr_surface surface;
    if ((f->mask && !f->mask[pixel]) || !lobe_ssr_surface_at(c, f, x, y, &surface)) return;
    const v3 fallback =
        lobe_ssr_environment_at(&f->environment, ssr_mirrored(surface), f->roughness[pixel]);
    const v3 light = ssr_radiance(ssr_reflected_at(s->reflection + 4 * pixel), fallback);
    memcpy(radiance, &light, sizeof light);
    const v3 f0 = f->f0 ? ssr_v3(f->f0 + 3 * pixel) : v3_of(1.0f, 1.0f, 1.0f);
    const v3 reflected = ssr_with_fresnel(light, f0, surface.to_viewer.z);
    memcpy(composite, &reflected, sizeof reflected);
}

void lobe_ssr_pass_composite(lobe_ssr *s, const lobe_ssr_frame *f) {
    const ssr_camera c = lobe_ssr_kernel_camera(s, &f->camera);
#pragma omp parallel for num_threads(s->threads)
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) composite_pixel(s, f, &c, x, y);
}
