/* The picture in the making: sums over the samples of each pixel. */
#ifndef LOBE_RENDER_FILM_H
#define LOBE_RENDER_FILM_H

#include "lobe/render.h"
#include "vector.h"

/* What is written into the file beside the picture. */
typedef struct film_metadata {
    char scene[256];
    char method[32];
    uint32_t samples;
    uint64_t seed;
    double seconds;
    int is_rendered; /* 0: read from a file */
} film_metadata;

/* One camera path. */
typedef struct film_sample {
    vec3 radiance;
    vec3 albedo, normal;
    float depth;
    float vndf_integral;
    uint32_t draws, rejected; /* of GGX */
} film_sample;

typedef struct film_pixel {
    double rgb[3];
    uint32_t samples;
    uint32_t dropped;
    uint64_t draws, rejected;
} film_pixel;

struct lobe_film {
    int width, height;
    uint32_t aovs;      /* LOBE_AOV_BIT */
    film_pixel *pixels; /* rows from the top */
    float *first_hit;   /* sums of albedo, normal, depth, VNDF integral; NULL: not kept */
    film_metadata metadata;
};

enum { FILM_FIRST_HIT_FLOATS = 8 };

lobe_film *lobe_film_create(int width, int height, uint32_t aovs); /* NULL: no memory */

/* Add a sample to pixel `index`. A sample that is not finite is counted and dropped. */
void lobe_film_add(lobe_film *film, size_t index, const film_sample *sample);

vec3 lobe_film_mean(const lobe_film *film, size_t index);

/* The formats; colours are multiplied by `scale`. */
typedef struct output output;
lobe_render_result lobe_film_write_exr(const lobe_film *film, output *out, float scale,
                                       lobe_film_write_options options);
lobe_render_result lobe_film_write_png(const lobe_film *film, output *out, float scale);
lobe_render_result lobe_film_write_hdr(const lobe_film *film, output *out, float scale);
lobe_render_result lobe_film_write_pfm(const lobe_film *film, output *out, float scale);

#endif
