/* The picture in the making: sums over the samples of each pixel. */
#ifndef LOBE_RENDER_FILM_H
#define LOBE_RENDER_FILM_H

#include "identity.h"
#include "lobe/render.h"
#include "vector.h"

/* What is written into the file beside the picture. */
typedef struct film_metadata {
    char scene[256];
    char method[32];
    char identity[IDENTITY_ROOM]; /* what decides the bits: identity.h; "": not known */
    uint64_t *seeds;              /* of all that was added up, rising; owned */
    uint32_t seed_count;
    uint32_t samples;     /* of the pixel that has most; 0: in the making */
    uint32_t part, parts; /* rendered was part `part` of `parts`; 1 of 1: the whole picture */
    double seconds;
    int is_rounded; /* read from a picture: the sums are not those of the render */
} film_metadata;

/* One camera path. */
typedef struct film_sample {
    vec3 radiance;
    vec3 albedo, normal;
    float depth;
    float vndf_integral;
    float motion[2];
    uint32_t draws, rejected; /* of GGX */
    int is_first_half;        /* see film_pixel; of weighted samples, half of the weight */
} film_sample;

typedef struct film_pixel {
    double rgb[3];
    double half; /* luminance of the samples of one half, to tell the noise by */
    uint32_t samples;
    uint32_t dropped;
    uint64_t draws, rejected;
} film_pixel;

/* How far a tile of an adaptive picture is (adaptive.h): samples of each of its pixels. */
typedef struct film_tile {
    double squares;                 /* sum of the squares of their weights */
    double deviation;               /* of one sample, relative, as the plan of this round had it */
    uint32_t before, planned, done; /* of the rounds before; of this one, and of those rendered */
    uint32_t unused;                /* 0: the structure has no padding */
} film_tile;

struct lobe_film {
    int width, height;
    uint32_t aovs;      /* LOBE_AOV_BIT */
    film_pixel *pixels; /* rows from the top; sums of rgb and half are weighted */
    double *weights;    /* sums of the weights of each pixel's samples; NULL: each weighs 1 */
    film_tile
        *tiles;     /* of TILE x TILE pixels; NULL: not adaptive, or joined from several pictures */
    uint32_t round; /* of `tiles`, from 1; 0: none is planned yet */
    double *first_hit; /* sums of albedo, normal, depth, VNDF integral, motion; NULL: not kept */
    film_metadata metadata;
};

enum { FILM_FIRST_HIT_VALUES = 10, FILM_HALF_BLOCK = 16 };

lobe_film *lobe_film_create(int width, int height, uint32_t aovs); /* NULL: no memory */

/* Make an empty film one of weighted samples. 0: no memory. */
int lobe_film_add_weights(lobe_film *film);

/* What the sums of a pixel are to be divided by; 0: it has no samples. */
static inline double lobe_film_weight(const lobe_film *film, size_t index) {
    return film->weights ? film->weights[index] : film->pixels[index].samples;
}

/* Add a sample to pixel `index`. A sample that is not finite is counted and dropped. */
void lobe_film_add(lobe_film *film, size_t index, const film_sample *sample);

vec3 lobe_film_mean(const lobe_film *film, size_t index);

/* Forget all samples. */
void lobe_film_clear(lobe_film *film);

/* Add `weight` times the sums of `part` to the pixels from (left, top) on; what lies beyond the edge is left out. Both
 * hold the same channels. */
void lobe_film_add_part(lobe_film *film, int left, int top, const lobe_film *part, double weight);

/* Samples of the pixel, those that were dropped among them. */
static inline uint32_t lobe_film_tried(const lobe_film *film, size_t index) {
    return film->pixels[index].samples + film->pixels[index].dropped;
}

/* Of the pixel that has most. */
uint32_t lobe_film_most_samples(const lobe_film *film);

/* The half to which a sample belongs: blocks of 16, each stratified in itself, in turn. */
static inline int lobe_film_is_first_half(uint32_t sample) {
    return (sample & FILM_HALF_BLOCK) == 0;
}

/* Root of the mean over the pixels that have samples of (s / m)^2: s the standard error of the mean m of the
 * luminance, told from the difference of the halves, m^2 + 0.01 for m^2. NaN below 32 samples a pixel. */
double lobe_film_noise(const lobe_film *film);

/* 0: no memory. */
int lobe_film_set_seeds(lobe_film *film, const uint64_t *seeds, uint32_t count);

/* The formats; colours are multiplied by `scale`. */
typedef struct output output;
lobe_render_result lobe_film_write_exr(const lobe_film *film, output *out, float scale,
                                       lobe_film_write_options options);
lobe_render_result lobe_film_write_png(const lobe_film *film, output *out, float scale);
lobe_render_result lobe_film_write_hdr(const lobe_film *film, output *out, float scale);
lobe_render_result lobe_film_write_pfm(const lobe_film *film, output *out, float scale);

#endif
