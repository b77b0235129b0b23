/* A block of pixels of a frame, an array a number: what the loops of a pass read and write. */
#ifndef LOBE_SSR_BLOCK_H
#define LOBE_SSR_BLOCK_H

#include "pipeline.h"

/* Stays in the first-level cache; a multiple of every width. */
enum { BLOCK = 128 };

/* n <= BLOCK rounded up to whole vectors: a loop that ends with one needs no second text for its end. */
static inline int whole_vectors(int n) {
    return (n + 15) & ~15;
}

typedef struct v3_block {
    float x[BLOCK], y[BLOCK], z[BLOCK];
} v3_block;

/* What a frame holds, and the surfaces made of it. */
typedef struct surfaces {
    float px[BLOCK], py[BLOCK]; /* centres of the pixels */
    float z[BLOCK], roughness[BLOCK], anisotropy[BLOCK];
    v3_block normal, tangent;
    v3_block x, y, axis, to_viewer; /* of ssr_surface; axis: its z */
    float alpha_x[BLOCK], alpha_y[BLOCK];
    kint seen[BLOCK];
} surfaces;

K_FN v3 v3_in(const v3_block *b, int i) {
    return v3_of(b->x[i], b->y[i], b->z[i]);
}

K_FN void put_v3(v3_block *b, int i, v3 v) {
    b->x[i] = v.x;
    b->y[i] = v.y;
    b->z[i] = v.z;
}

static inline void read_v3(v3_block *b, const float *values, int n) {
    for (int i = 0; i < n; i++) put_v3(b, i, ssr_v3(values + 3 * i));
}

/* n pixels of a row, from pixel (x, y) on. */
static inline void read_surfaces(surfaces *s, const lobe_ssr_frame *f, size_t pixel, int x, int y,
                                 int n) {
    for (int i = 0; i < n; i++) s->px[i] = (float)(x + i) + 0.5f;
    for (int i = 0; i < n; i++) s->py[i] = (float)y + 0.5f;
    memcpy(s->z, f->z + pixel, (size_t)n * sizeof *s->z);
    memcpy(s->roughness, f->roughness + pixel, (size_t)n * sizeof *s->roughness);
    read_v3(&s->normal, f->normal + 3 * pixel, n);
    if (!f->anisotropy || !f->tangent) return;
    memcpy(s->anisotropy, f->anisotropy + pixel, (size_t)n * sizeof *s->anisotropy);
    read_v3(&s->tangent, f->tangent + 3 * pixel, n);
}

K_FN ssr_surface surface_in(const surfaces *s, int i) {
    return (ssr_surface){.x = v3_in(&s->x, i),
                         .y = v3_in(&s->y, i),
                         .z = v3_in(&s->axis, i),
                         .to_viewer = v3_in(&s->to_viewer, i),
                         .alpha_x = s->alpha_x[i],
                         .alpha_y = s->alpha_y[i],
                         .seen = s->seen[i]};
}

/* Surfaces of the first n pixels, whole vectors. */
static inline void make_surfaces(surfaces *s, int n, const ssr_camera *camera,
                                 const lobe_ssr_frame *f) {
    const ssr_camera c = *camera;
    const float near_z = f->camera.near_z, far_z = f->camera.far_z;
    const kint brushed = f->anisotropy && f->tangent;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        ssr_material m = ssr_material_of(v3_in(&s->normal, i), s->roughness[i]);
        m.anisotropy = k_select(k_is(brushed), s->anisotropy[i], 0.0f);
        m.tangent = v3_select(k_is(brushed), v3_in(&s->tangent, i), m.tangent);
        s->z[i] = ssr_usable_z(s->z[i], near_z, far_z);
        const ssr_surface t = ssr_surface_of(c, s->px[i], s->py[i], s->z[i], m);
        put_v3(&s->x, i, t.x);
        put_v3(&s->y, i, t.y);
        put_v3(&s->axis, i, t.z);
        put_v3(&s->to_viewer, i, t.to_viewer);
        s->alpha_x[i] = t.alpha_x;
        s->alpha_y[i] = t.alpha_y;
        s->seen[i] = t.seen;
    }
}

#endif
