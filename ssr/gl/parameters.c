#include "parameters.h"

static void set_levels(ssr_parameters *p) {
    int width = p->width, height = p->height, start = 0;
    for (p->levels = 1;; p->levels++) {
        const int level = p->levels - 1;
        p->level_width[level] = width;
        p->level_height[level] = height;
        p->level_start[level] = start;
        if (width == 1 && height == 1) return;
        start += width * height;
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
}

ssr_parameters lobe_ssr_gl_parameters(const lobe_ssr *s) {
    const lobe_ssr_options *o = &s->options;
    ssr_parameters p = {.width = s->width,
                        .height = s->height,
                        .max_iterations = o->max_iterations,
                        .way = (kint)o->resolve,
                        .mirrors = o->mode == LOBE_SSR_MIRROR,
                        .biases_first = o->mode == LOBE_SSR_NDF,
                        .as_hdrp = o->as_hdrp != 0,
                        .reflects_sky = o->reflect_sky != 0,
                        .thickness = o->thickness,
                        .edge_fade = o->edge_fade,
                        .fade_start = o->fade_start,
                        .fade_end = o->fade_end,
                        .accumulation = o->accumulation,
                        .rejection = o->speed_rejection * o->speed_scale,
                        .bias = o->bias};
    set_levels(&p);
    p.highest_level = o->linear_march ? 0 : p.levels - 1;
    return p;
}

void lobe_ssr_gl_set_frame(ssr_parameters *p, const lobe_ssr *s, const lobe_ssr_frame *f) {
    const lobe_ssr_environment *e = &f->environment;
    p->now = lobe_ssr_kernel_camera(s, &f->camera);
    p->last = lobe_ssr_kernel_camera(s, &f->previous_camera);
    p->noise = lobe_ssr_noise_keys(s->options.seed, s->frame);
    p->has_history = s->frame > 0;
    p->has_mask = f->mask != NULL;
    p->has_motion = f->motion != NULL;
    p->has_motion_z = f->motion_z != NULL;
    p->has_f0 = f->f0 != NULL;
    p->has_tangent = f->anisotropy && f->tangent;
    p->environment_width = e->rgb ? e->width : 0;
    p->environment_height = e->rgb ? e->height : 0;
    p->environment_levels = e->rgb ? e->levels : 0;
}

size_t lobe_ssr_gl_cells(const ssr_parameters *p) {
    return (size_t)p->level_start[p->levels - 1] + 1;
}
