/* tests/render/pictures.h: small pictures, and means of blocks with their standard errors. */
#ifndef TESTS_RENDER_PICTURES_H
#define TESTS_RENDER_PICTURES_H

#include <lobe/render.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* What third parties keep until the process ends is no leak of ours. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:libembree3\nleak:libembree4\nleak:libtbb\nleak:libassimp\nleak:libgomp\n"
           "leak:libomp\n";
}

/* A panorama of one colour, as a PFM. */
static inline void write_even_light(const char *path, float radiance) {
    float even[4 * 2 * 3];
    for (int i = 0; i < 4 * 2 * 3; ++i) even[i] = radiance;
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "PF\n4 2\n-1.0\n");
    fwrite(even, sizeof even, 1, file);
    fclose(file);
}

static inline lobe_scene *load(const char *name) {
    lobe_scene *scene = NULL;
    if (lobe_scene_load(name, lobe_scene_default_options(), &scene) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    return scene;
}

static inline lobe_render_options small(int width, int height, uint32_t samples) {
    lobe_render_options o = lobe_render_default_options();
    o.width = width;
    o.height = height;
    o.samples = samples;
    return o;
}

static inline lobe_film *render(const lobe_scene *scene, lobe_render_options o,
                                lobe_render_statistics *statistics) {
    lobe_film *film = NULL;
    if (lobe_render(scene, o, &film, statistics) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    return film;
}

static inline float *colors(const lobe_film *film) {
    float *rgb =
        malloc(3 * sizeof *rgb * (size_t)lobe_film_width(film) * (size_t)lobe_film_height(film));
    lobe_film_copy_rgb(film, rgb);
    return rgb;
}

enum { BLOCKS = 4, SEEDS = 6 };

/* Means of a 4 x 4 grid of blocks over independent seeds, with the standard error of each. */
typedef struct block_means {
    double mean[BLOCKS * BLOCKS], error[BLOCKS * BLOCKS];
} block_means;

static inline double block_of(const float *rgb, int width, int height, int block) {
    int w = width / BLOCKS, h = height / BLOCKS;
    double sum = 0;
    for (int y = block / BLOCKS * h; y < (block / BLOCKS + 1) * h; ++y)
        for (int x = block % BLOCKS * w; x < (block % BLOCKS + 1) * w; ++x)
            for (int c = 0; c < 3; ++c) sum += fminf(rgb[3 * (y * width + x) + c], 1e6f);
    return sum / (3.0 * w * h);
}

static inline block_means measure(const lobe_scene *scene, lobe_render_options o) {
    double sum[BLOCKS * BLOCKS] = {0}, squares[BLOCKS * BLOCKS] = {0};
    const uint64_t first = 1000 * o.seed + 1;
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
        o.seed = first + seed;
        lobe_film *film = render(scene, o, NULL);
        float *rgb = colors(film);
        for (int b = 0; b < BLOCKS * BLOCKS; ++b) {
            double m = block_of(rgb, o.width, o.height, b);
            sum[b] += m;
            squares[b] += m * m;
        }
        free(rgb);
        lobe_film_free(film);
    }
    block_means result;
    for (int b = 0; b < BLOCKS * BLOCKS; ++b) {
        result.mean[b] = sum[b] / SEEDS;
        double variance = fmax(squares[b] / SEEDS - result.mean[b] * result.mean[b], 0);
        result.error[b] = sqrt(variance / (SEEDS - 1));
    }
    return result;
}

/* Blocks agree: the root mean square of the z-scores is near 1, whatever single ones do. Student's t
 * of 2 x 5 degrees of freedom has a variance of 1.25; 16 of them together stay below 2.2 with a
 * probability above 0.999. */
static inline double disagreement(const block_means *a, const block_means *b) {
    double sum = 0;
    for (int k = 0; k < BLOCKS * BLOCKS; ++k) {
        double d = a->mean[k] - b->mean[k];
        /* the floor: rounding of nearly constant blocks */
        double e2 =
            a->error[k] * a->error[k] + b->error[k] * b->error[k] + 1e-8 * a->mean[k] * a->mean[k];
        sum += d * d / e2;
    }
    return sqrt(sum / (BLOCKS * BLOCKS));
}

/* Each of these ways to combine light and surface samples gives the picture of `o`, from other seeds. */
static inline void assert_estimators_agree(const lobe_scene *scene, lobe_render_options o,
                                           const lobe_heuristic *others, int count,
                                           uint64_t first_seed) {
    const block_means expected = measure(scene, o);
    for (int k = 0; k < count; ++k) {
        o.heuristic = others[k];
        o.seed = first_seed + (uint64_t)k;
        const block_means means = measure(scene, o);
        const double z = disagreement(&means, &expected);
        if (!(z < 2.2))
            fail_msg("%s is off by %g standard errors", lobe_heuristic_name(others[k]), z);
    }
}

#endif
