/* Composite: what the screen does not show comes from the environment. */
#include "bands.h"
#include "block.h"
#include "environment.h"

typedef struct composed {
    surfaces at;
    v3_block color, f0, radiance, composite;
    float opacity[BLOCK];
} composed;

static void read_reflections(composed *p, const ssr_band *b, size_t pixel, int n) {
    const float *reflection = b->s->reflection + 4 * pixel;
    for (int i = 0; i < n; i++) {
        put_v3(&p->color, i, ssr_v3(reflection + 4 * i));
        p->opacity[i] = reflection[4 * i + 3];
    }
    if (b->f->f0)
        read_v3(&p->f0, b->f->f0 + 3 * pixel, n);
    else
        for (int i = 0; i < n; i++) put_v3(&p->f0, i, v3_of(1.0f, 1.0f, 1.0f));
}

/* What the environment adds, into `radiance`. */
static void look_around(composed *p, int n, const lobe_ssr_environment *environment) {
    const lobe_ssr_environment e = *environment;
    if (!e.rgb) {
        for (int i = 0; i < n; i++) put_v3(&p->radiance, i, v3_of(0.0f, 0.0f, 0.0f));
        return;
    }
#pragma omp simd
    for (int i = 0; i < n; i++) {
        /* what is no surface looks somewhere */
        const bool seen = k_is(p->at.seen[i]);
        const v3 d = v3_select(seen, ssr_mirrored(surface_in(&p->at, i)), v3_of(0.0f, 0.0f, 1.0f));
        const float roughness = k_select(seen, p->at.roughness[i], 0.0f);
        put_v3(&p->radiance, i, ssr_environment_light(&e, d, roughness));
    }
}

static void compose(composed *p, int n) {
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const bool seen = k_is(p->at.seen[i]);
        const v3 none = v3_of(0.0f, 0.0f, 0.0f);
        const ssr_reflected own = {v3_in(&p->color, i), p->opacity[i]};
        const v3 light = v3_select(seen, ssr_radiance(own, v3_in(&p->radiance, i)), none);
        const v3 reflected = ssr_with_fresnel(light, v3_in(&p->f0, i), p->at.to_viewer.z[i]);
        put_v3(&p->radiance, i, light);
        put_v3(&p->composite, i, v3_select(seen, reflected, none));
    }
}

static void write_v3(float *out, const v3_block *b, int n) {
    for (int i = 0; i < n; i++) {
        out[3 * i] = b->x[i];
        out[3 * i + 1] = b->y[i];
        out[3 * i + 2] = b->z[i];
    }
}

/* n pixels of row y from x on. */
static void compose_block(const ssr_band *b, const ssr_camera *c, composed *p, int x, int y,
                          int n) {
    const size_t pixel = (size_t)y * (size_t)b->s->width + (size_t)x;
    read_surfaces(&p->at, b->f, pixel, x, y, n);
    read_reflections(p, b, pixel, n);
    const int whole = whole_vectors(n);
    make_surfaces(&p->at, whole, c, b->f);
    for (int i = 0; b->f->mask && i < n; i++)
        p->at.seen[i] &= k_flag(b->f->mask[pixel + (size_t)i] != 0);
    look_around(p, whole, &b->f->environment);
    compose(p, whole);
    write_v3(b->s->radiance + 3 * pixel, &p->radiance, n);
    write_v3(b->s->composite + 3 * pixel, &p->composite, n);
}

void SSR_SYMBOL(composite)(const ssr_band *b) {
    const ssr_camera c = lobe_ssr_kernel_camera(b->s, &b->f->camera);
    composed p;
    memset(&p, 0, sizeof p);
    for (int y = b->first; y < b->end; y++)
        for (int x = 0; x < b->s->width; x += BLOCK)
            compose_block(b, &c, &p, x, y, b->s->width - x < BLOCK ? b->s->width - x : BLOCK);
}
