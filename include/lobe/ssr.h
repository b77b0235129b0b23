/* lobe/ssr.h: screen-space reflections: rays through the depth buffer of a frame, drawn by the samplers of
 * lobe/reflection.h, colours from the frame before.
 *
 *     lobe_ssr *ssr = NULL;
 *     lobe_ssr_options options = lobe_ssr_default_options();
 *     options.fade_start = options.fade_end = 1.0f;                  // rough surfaces too
 *     if (lobe_ssr_create(1920, 1080, options, &ssr) != LOBE_SSR_OK) ...
 *     for (each frame)
 *         lobe_ssr_run(ssr, &frame, &statistics);                    // then lobe_ssr_composite(ssr), ...
 *     lobe_ssr_free(ssr);
 *
 * Per frame: depth pyramid, trace, reproject, resolve, accumulate, composite. World: right-handed. Pictures
 * have rows from the top; positions on the screen are in [0, 1], from the left and from the top.
 * Any input is defined: what is not finite, a normal of length 0 or a depth out of range is taken as "no
 * surface" or "no light"; no output is ever NaN. The same frames give the same bits on any number of
 * threads.
 *
 * Different handles may be used by different threads at once; one handle by one thread at a time. */
#ifndef LOBE_SSR_H
#define LOBE_SSR_H

#include <stddef.h>

#include "reflection.h"
#include "types.h"

LOBE_BEGIN_C

typedef enum lobe_ssr_result {
    LOBE_SSR_OK,
    LOBE_SSR_INTERRUPTED, /* asked to stop: what was finished stays */
    LOBE_SSR_BAD_INPUT,   /* a file, name or option is unusable: exit status 2 */
    LOBE_SSR_FAILED       /* memory, file, GPU: exit status 1 */
} lobe_ssr_result;

/* Why the last call of this thread did not return LOBE_SSR_OK: one line "WHERE: WHAT; HINT". */
LOBE_API const char *lobe_ssr_error_message(void);

#define LOBE_SSR_SIZE_MAX 32768

/* ---- Frames ---------------------------------------------------------------------------------- */

typedef struct lobe_ssr_camera {
    lobe_vec3_f32 eye;
    lobe_vec3_f32 right, up, forward; /* orthonormal */
    float tan_x, tan_y;               /* tangents of half the angles of view, above 0 */
    float near_z, far_z;              /* distances along `forward`, 0 < near_z < far_z */
} lobe_ssr_camera;

/* `aspect`: width over height. Degenerate directions give some frame that is orthonormal. */
LOBE_API lobe_ssr_camera lobe_ssr_look_at(lobe_vec3_f32 eye, lobe_vec3_f32 target, lobe_vec3_f32 up,
                                          float vertical_degrees, float aspect, float near_z,
                                          float far_z);

/* Light from everywhere, prefiltered: level k of `levels` for perceptual roughness k/(levels - 1), each of
 * width x height x 3 floats, fewer than 2^31 in all; direction d at u = 1/2 + atan2(d.z, d.x)/(2 pi),
 * v = acos(d.y)/pi. */
typedef struct lobe_ssr_environment {
    int width, height, levels;
    const float *rgb;
} lobe_ssr_environment;

typedef struct lobe_ssr_frame {
    const float *z;         /* along the camera's axis; not above 0 or not finite: no surface */
    const float *normal;    /* x, y, z in the world; any length but 0 */
    const float *roughness; /* perceptual, [0, 1] */
    /* Brushed surfaces: alpha = roughness^2 (1 + anisotropy) along the tangent, (1 - anisotropy) across it;
     * -1 to 1. The tangent: x, y, z in the world, any length, need not be across the normal. NULL: none. */
    const float *anisotropy, *tangent;
    const float *f0;     /* r, g, b: reflectance at normal incidence; NULL: 1 */
    const float *motion; /* x, y: position on the screen, now minus before; NULL: none */
    /* Distance of the surface along the axis of the camera now minus that along the axis of the camera before, where
     * things move beside the camera; NULL: what follows from the cameras. */
    const float *motion_z;
    const float *previous_color;      /* r, g, b of the frame before */
    const unsigned char *mask;        /* 0: this pixel receives no reflection; NULL: all do */
    lobe_ssr_environment environment; /* where nothing on the screen is met; rgb NULL: black */
    lobe_ssr_camera camera, previous_camera;
} lobe_ssr_frame;

/* ---- Options --------------------------------------------------------------------------------- */

typedef enum lobe_ssr_mode {
    LOBE_SSR_MIRROR, /* the view direction reflected about the normal */
    LOBE_SSR_NDF,    /* normals by D cos */
    LOBE_SSR_VNDF    /* visible normals, by any method of Smith-GGX */
} lobe_ssr_mode;

typedef enum lobe_ssr_resolve {
    LOBE_SSR_APPROX,              /* one lookup in the colour pyramid, by roughness */
    LOBE_SSR_NEIGHBOURHOOD,       /* 3 x 3 rays, weights of visible normals with D cancelled */
    LOBE_SSR_NEIGHBOURHOOD_RATIO, /* the same, value here over density there (Stachowiak 2015) */
    /* The ratio over the 13 nearest rays, times how much each tells: one that is lost next to nothing, one that
     * leaves the screen a half, with the environment's light in its direction. */
    LOBE_SSR_CONFIDENCE,
    LOBE_SSR_OWN /* none: what the pixel's own ray met, for comparison */
} lobe_ssr_resolve;

typedef enum lobe_ssr_backend {
    LOBE_SSR_CPU,
    LOBE_SSR_GL,  /* OpenGL 4.5 without a window, by whatever driver there is */
    LOBE_SSR_AUTO /* OpenGL on a GPU; the processor where there is none */
} lobe_ssr_backend;

typedef struct lobe_ssr_options {
    lobe_ssr_mode mode;         /* default LOBE_SSR_VNDF */
    lobe_method method;         /* of VNDF; default LOBE_METHOD_BOUNDED */
    lobe_ssr_resolve resolve;   /* default LOBE_SSR_NEIGHBOURHOOD_RATIO */
    int max_iterations;         /* cells a ray may step through, 1 to 1000000; 64 */
    float thickness;            /* of what is seen, a share of its distance, [0, 1]; 0.01 */
    float edge_fade;            /* share of half the screen, [0, 1]; 0.1 */
    float fade_start, fade_end; /* perceptual roughness at which reflections begin to fade, and end;
                                      0.1 both */
    float accumulation;         /* share of the history, [0, 1]; 0.75 */
    float bias; /* shortens the lobe: the radial random number times 1 - bias, [0, 1); 0.5 */
    float speed_rejection; /* share of the history lost to motion: per pixel of motion a frame */
    float speed_scale;     /* speed_rejection * speed_scale; [0, 1] both; 0.5 and 0.2 */
    int reflect_sky;  /* a ray that leaves through a pixel without surface takes its colour; 1 */
    int linear_march; /* step texel by texel: the reference for the pyramid; 0 */
    int as_hdrp; /* for comparison: resolve weights of world-space vectors, pyramid of nearest depths
                         only, draws that are dropped resolved as misses; 0 */
    uint64_t seed;
    int threads;              /* 0: as many as OpenMP offers; of the processor */
    lobe_ssr_backend backend; /* what runs the passes; LOBE_SSR_CPU */
} lobe_ssr_options;

LOBE_API lobe_ssr_options lobe_ssr_default_options(void);

/* 1 if `bias` is known for the method: it has one random number that tells how far from the lobe's centre. */
LOBE_API int lobe_ssr_has_bias(lobe_method method);

/* ---- Running --------------------------------------------------------------------------------- */

typedef enum lobe_ssr_pass {
    LOBE_SSR_PASS_PYRAMID,
    LOBE_SSR_PASS_TRACE,
    LOBE_SSR_PASS_REPROJECT,
    LOBE_SSR_PASS_RESOLVE,
    LOBE_SSR_PASS_ACCUMULATE,
    LOBE_SSR_PASS_COMPOSITE,
    LOBE_SSR_PASS_COUNT
} lobe_ssr_pass;

LOBE_API const char *lobe_ssr_pass_name(lobe_ssr_pass pass); /* "pyramid", …; out of range: NULL */

typedef struct lobe_ssr_statistics {
    uint64_t rays;     /* drawn */
    uint64_t rejected; /* of them not traced: below the surface, or of next to no weight */
    uint64_t hits;     /* of them that met something, the sky included */
    uint64_t steps;    /* of all rays: each looks at one cell of the pyramid */
    double milliseconds[LOBE_SSR_PASS_COUNT]; /* on a GPU: by its own clock */
} lobe_ssr_statistics;

typedef enum lobe_ssr_state {
    LOBE_SSR_NO_RAY,
    LOBE_SSR_REJECTED,
    LOBE_SSR_MISS, /* left the screen or the depth range */
    LOBE_SSR_HIT,
    LOBE_SSR_SKY,
    LOBE_SSR_LOST /* went behind something, or ended after max_iterations: what it meets is unknown */
} lobe_ssr_state;

/* The ray of a pixel. */
typedef struct lobe_ssr_ray {
    lobe_vec3_f32 direction; /* world */
    float pdf, weight;       /* of the draw */
    float length;            /* world, to what was met; 0: nothing */
    int32_t x, y;            /* the pixel that was met; -1: none */
    int32_t state;           /* lobe_ssr_state */
    int32_t steps;
} lobe_ssr_ray;

typedef struct lobe_ssr lobe_ssr;

/* *ssr is to be freed by lobe_ssr_free after LOBE_SSR_OK; otherwise it is NULL. */
LOBE_API lobe_ssr_result lobe_ssr_create(int width, int height, lobe_ssr_options options,
                                         lobe_ssr **ssr);
LOBE_API void lobe_ssr_free(lobe_ssr *ssr); /* NULL is fine */

/* What runs the passes: LOBE_SSR_CPU or LOBE_SSR_GL; and its name, for LOBE_SSR_AUTO with the reason why it is
 * the processor. The same text of each pass runs on both; their results agree to the tolerances of
 * docs/shaders.md. */
LOBE_API lobe_ssr_backend lobe_ssr_backend_of(const lobe_ssr *ssr);
LOBE_API const char *lobe_ssr_device(const lobe_ssr *ssr);

/* The next frame. Frames are numbered from the creation on; `statistics` may be NULL. */
LOBE_API lobe_ssr_result lobe_ssr_run(lobe_ssr *ssr, const lobe_ssr_frame *frame,
                                      lobe_ssr_statistics *statistics);

/* Results of the last frame, one a pixel; valid until the next call. */
LOBE_API const lobe_ssr_ray *lobe_ssr_rays(const lobe_ssr *ssr);
LOBE_API const float *lobe_ssr_resolved(const lobe_ssr *ssr);   /* r, g, b times opacity; opacity */
LOBE_API const float *lobe_ssr_reflection(const lobe_ssr *ssr); /* the same, accumulated */
/* r, g, b: reflection + (1 - opacity) * environment; 0 where there is no surface: the radiance over the
 * lobe, without Fresnel. And the same times Fresnel (Schlick, at the normal). */
LOBE_API const float *lobe_ssr_radiance(const lobe_ssr *ssr);
LOBE_API const float *lobe_ssr_composite(const lobe_ssr *ssr);

LOBE_END_C

#endif
