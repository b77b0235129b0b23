/* app/comparison.h: what `lobe compare` finds, and the statistics of it. */
#ifndef LOBE_APP_COMPARISON_H
#define LOBE_APP_COMPARISON_H

#include <stdbool.h>
#include <stdint.h>

#include <lobe/render.h>

enum { LOBE_APP_CONTENDERS_MAX = 12, LOBE_APP_SIZES_MAX = 12, LOBE_APP_SEEDS_MAX = 64 };

/* A method with its own options. */
typedef struct lobe_app_contender {
    char name[64]; /* as the user wrote it: "horizon:floor=0.5" */
    char file[64]; /* the same, fit for the name of a file */
    lobe_model model;
    double floor;
    lobe_normalization normalization;
} lobe_app_contender;

/* One picture against the reference. */
typedef struct lobe_app_measurement {
    double mse, relmse; /* without the noise of the reference */
    double flip;        /* LDR, at the exposure */
    double seconds, cpu_seconds;
    double rays, draws, rejected;
} lobe_app_measurement;

/* All pictures of a contender with one number of samples. */
typedef struct lobe_app_cell {
    uint32_t spp;
    int count; /* of seeds that are finished */
    lobe_app_measurement runs[LOBE_APP_SEEDS_MAX];
    double flip_hdr; /* of the first seed */
    float *rgb;      /* of the first seed */
    float *flip;     /* of the first seed, by pixel */
    float *relative; /* squared relative error by pixel, summed over the seeds */
    /* By value, for the floor; NULL: not kept. */
    double *sum;     /* of the pictures */
    double *product; /* of (picture - half 0) (picture - half 1) */
} lobe_app_cell;

/* The error that more samples do not remove: the squared bias, relative as relmse is. */
typedef struct lobe_app_floor {
    double relmse;
    double
        deviations; /* of its estimate, in standard deviations of what an unbiased method gives */
    bool is_known, is_biased;
} lobe_app_floor;

typedef struct lobe_app_estimate {
    double value, error; /* standard error, from the seeds; NAN: one seed */
} lobe_app_estimate;

typedef enum lobe_app_axis { LOBE_APP_AXIS_SAMPLES, LOBE_APP_AXIS_TIME } lobe_app_axis;

typedef struct lobe_app_comparison {
    const char *title;   /* the scene, or the picture */
    const char *command; /* the line that was typed */
    bool is_of_files;    /* two pictures; else a scene */
    bool is_interrupted;
    int width, height;
    double exposure;
    lobe_app_axis equal;
    int contenders, sizes, seeds;
    lobe_app_contender contender[LOBE_APP_CONTENDERS_MAX];
    lobe_app_cell cell[LOBE_APP_CONTENDERS_MAX][LOBE_APP_SIZES_MAX];
    const char *reference_name; /* the file; NULL: rendered */
    uint32_t reference_spp;     /* of both halves together */
    float *half[2];             /* independent pictures of the truth; a file is both */
    float *reference;           /* their mean */
} lobe_app_comparison;

void lobe_app_free_comparison(lobe_app_comparison *c);

/* Takes the picture `rgb` of one more seed; the first one's is kept. false: out of memory. */
bool lobe_app_add_picture_to(lobe_app_comparison *c, int contender, int size, const float *rgb,
                             lobe_app_measurement measured);

/* Makes `reference` of the halves. false: out of memory. */
bool lobe_app_set_reference(lobe_app_comparison *c);

/* Root of the mean squared difference of the two halves, as noise of their mean; 0 of a file. */
double lobe_app_reference_noise(const lobe_app_comparison *c);

/* Means over the seeds. */
lobe_app_estimate lobe_app_rmse(const lobe_app_cell *cell);
lobe_app_estimate lobe_app_relmse(const lobe_app_cell *cell);
lobe_app_estimate lobe_app_flip(const lobe_app_cell *cell);
double lobe_app_rejected_share(const lobe_app_cell *cell);
double lobe_app_median_seconds(const lobe_app_cell *cell);
double lobe_app_cpu_seconds(const lobe_app_cell *cell);
double lobe_app_rays_per_second(const lobe_app_cell *cell);

/* d log relmse / d log samples; the error of an unbiased method falls with -1. NAN: fewer than two sizes. */
lobe_app_estimate lobe_app_slope(const lobe_app_comparison *c, int contender, lobe_app_axis axis);

/* The share of the samples (or the processor time) of `base` that `contender` needs for the same relmse. NAN:
 * nothing to tell it from. */
lobe_app_estimate lobe_app_need(const lobe_app_comparison *c, int contender, int base,
                                lobe_app_axis axis);

/* The share differs from 1 with a confidence of 95 %: Student's t of the seeds. */
bool lobe_app_is_told_apart(lobe_app_estimate need, int seeds);

lobe_app_floor lobe_app_find_floor(const lobe_app_comparison *c, int contender);

/* The contender that needs least, biased ones aside; and whom it is held against: the first one, or the next
 * best if it is the first itself. -1: there is none. */
int lobe_app_best_contender(const lobe_app_comparison *c, lobe_app_axis axis);
int lobe_app_rival(const lobe_app_comparison *c, int best, lobe_app_axis axis);

/* "On this scene horizon needs 62 % of the samples of ellipsoid" in `text`. */
void lobe_app_headline(const lobe_app_comparison *c, char *text, size_t size);

/* The value that a share of `values` does not exceed; infinity: out of memory. */
float lobe_app_quantile(const float *values, size_t count, double share);

/* A square where the contenders differ most. */
typedef struct lobe_app_crop {
    int x, y, size;
} lobe_app_crop;

/* At most `most`, apart from each other, the most telling one first; returns how many. */
int lobe_app_find_crops(const lobe_app_comparison *c, int size, lobe_app_crop *crops, int most);

#endif
