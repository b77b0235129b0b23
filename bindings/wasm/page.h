/* What the files of this room share: the arrays that the page sees, and the two prepared models. The page
 * calls the functions that have an export name, with numbers only, and reads and writes these arrays
 * through views of the memory. Everything has its place from the start: nothing is allocated, so the memory
 * of the page stays as large as it is. */
#ifndef LOBE_WASM_PAGE_H
#define LOBE_WASM_PAGE_H

#include <lobe/lobe.h>

#define EXPORT(name) __attribute__((export_name(#name)))

enum {
    ROWS = 1 << 16, /* draws of a method at most */
    METHODS = 2,    /* A and B, side by side */
    CURVE = 1024    /* points of a curve at most */
};

/* Draws of one method, an array a number. */
typedef struct rows {
    float m[3][ROWS], wo[3][ROWS];
    float cos_im[ROWS], pdf_m[ROWS], pdf[ROWS], weight[ROWS];
} rows;

/* What is looked at: a direction, roughness, a geometric normal, and what is sampled. */
typedef struct scene {
    lobe_reflection_options options;
    lobe_vec3_f32 wi, plane;
    float alpha[2];
} scene;

extern float page_numbers[3][ROWS]; /* u1, u2, u3 */
extern float page_query[3][ROWS];   /* directions to evaluate */
extern float page_answer[2][ROWS];  /* density, f cos */
extern float page_curve[4][CURVE];  /* curves, and the coordinates of one */
extern double page_result[16];      /* the numbers of whatever was asked last */
extern rows page_rows[METHODS];
extern scene page_scene[METHODS];
extern lobe_reflection_f32 page_model[METHODS];

static inline lobe_vec3_f32 page_scaled(lobe_vec3_f32 v, float s) {
    return (lobe_vec3_f32){s * v.x, s * v.y, s * v.z};
}

static inline float page_dot(lobe_vec3_f32 a, lobe_vec3_f32 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline float page_min(float a, float b) {
    return a < b ? a : b;
}

static inline float page_max(float a, float b) {
    return a > b ? a : b;
}

lobe_vec3_f32 page_unit(lobe_vec3_f32 v);
/* i reflected about m */
lobe_vec3_f32 page_reflected(lobe_vec3_f32 i, lobe_vec3_f32 m);

/* The first three Sobol dimensions: the point after `x`, which is the one of index `i`. */
void page_sobol_next(uint32_t x[3], uint32_t i);

/* Draws with page_numbers from `first` on: to the same rows. */
void page_draw_rows(int method, int first, int count);
/* Density and f cos of the first `count` directions of page_query. */
void page_eval_rows(int method, int count);

#endif
