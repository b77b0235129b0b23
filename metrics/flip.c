/* FLIP, after Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild: "FLIP: A Difference
 * Evaluator for Alternating Images" (2020), and of high dynamic range "Visualizing Errors in Rendered High
 * Dynamic Range Images" (2021). Colours are blurred as the eye blurs them and compared; edges and points
 * that only one of the pictures has raise the difference. */
#include "lobe/metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "colour.h"
#include "filter.h"
#include "tone.h"

static const double pi = 3.14159265358979323846;

/* Sensitivity of the eye to contrast, for the channels Y, Cx and Cz: sums of two Gaussians
 * weight * sqrt(pi / width) * exp(-pi^2 d^2 / width), d in degrees. Both weights of the first two lie in one. */
static const struct {
    double weight[2], width[2];
} eye[3] = {
    {{1.0, 0.0}, {0.0047, 1e-5}}, {{1.0, 0.0}, {0.0053, 1e-5}}, {{34.1, 13.5}, {0.04, 0.025}}};

static const float colour_power = 0.7f, feature_power = 0.5f;
static const float knee_at = 0.4f, knee_value = 0.95f;
static const double feature_degrees = 0.082; /* width of what counts as an edge or a point */

enum { CHANNELS = 3, GAUSSIANS = 2 };

/* What depends on the pixels a degree only, and room to work in. */
typedef struct flip_work {
    int width, height;
    size_t count;
    int eye_radius, feature_radius;
    float *eye_rows[CHANNELS][GAUSSIANS];
    double eye_share[CHANNELS][GAUSSIANS]; /* of the sum of both, so that it keeps a constant */
    float *smooth, *first, *second;        /* Gaussian and its derivatives */
    float *planes[CHANNELS];               /* the picture in YCxCz */
    float *blurred[CHANNELS];
    float *scratch, *part;
    colour *perceived[2]; /* of the picture and the reference */
    float *edges[2], *points[2];
} flip_work;

/* ---- Filters --------------------------------------------------------------------------------- */

static double sum_of(const float *weights, int radius) {
    double sum = 0.0;
    for (int i = 0; i <= 2 * radius; i++) sum += (double)weights[i];
    return sum;
}

static void make_eye_filters(flip_work *w, double ppd) {
    for (int c = 0; c < CHANNELS; c++) {
        double amount[GAUSSIANS], total = 0.0;
        for (int g = 0; g < GAUSSIANS; g++) {
            const double width = eye[c].width[g];
            lobe_gaussian(w->eye_rows[c][g], w->eye_radius, ppd * sqrt(width / 2.0) / pi);
            const double sum = sum_of(w->eye_rows[c][g], w->eye_radius);
            for (int i = 0; i <= 2 * w->eye_radius; i++)
                w->eye_rows[c][g][i] = (float)((double)w->eye_rows[c][g][i] / sum);
            amount[g] = eye[c].weight[g] * sqrt(pi / width) * sum * sum;
            total += amount[g];
        }
        for (int g = 0; g < GAUSSIANS; g++) w->eye_share[c][g] = amount[g] / total;
    }
}

/* Scales the positive weights to a sum of 1 and the negative ones to -1. */
static void balance(float *weights, int radius) {
    double plus = 0.0, minus = 0.0;
    for (int i = 0; i <= 2 * radius; i++)
        *(weights[i] > 0.0f ? &plus : &minus) += fabs((double)weights[i]);
    for (int i = 0; i <= 2 * radius; i++)
        weights[i] = (float)((double)weights[i] / (weights[i] > 0.0f ? plus : minus));
}

static void make_feature_filters(flip_work *w, double ppd) {
    const double sigma = 0.5 * feature_degrees * ppd;
    const int radius = w->feature_radius;
    lobe_gaussian(w->smooth, radius, sigma);
    for (int i = -radius; i <= radius; i++) {
        const double at = (double)w->smooth[i + radius];
        w->first[i + radius] = (float)(-i * at);
        w->second[i + radius] = (float)((i * i / (sigma * sigma) - 1.0) * at);
    }
    const double sum = sum_of(w->smooth, radius);
    for (int i = 0; i <= 2 * radius; i++) w->smooth[i] = (float)((double)w->smooth[i] / sum);
    balance(w->first, radius);
    balance(w->second, radius);
}

/* ---- One picture ----------------------------------------------------------------------------- */

static void to_opponent(flip_work *w, const float *rgb) {
    for (size_t i = 0; i < w->count; i++) {
        colour c;
        for (int k = 0; k < 3; k++) c.v[k] = fminf(fmaxf(rgb[3 * i + (size_t)k], 0.0f), 1.0f);
        c = lobe_opponent_of_rgb(c);
        for (int k = 0; k < 3; k++) w->planes[k][i] = c.v[k];
    }
}

static void blur_channel(flip_work *w, int c) {
    memset(w->blurred[c], 0, w->count * sizeof(float));
    for (int g = 0; g < GAUSSIANS; g++) {
        const float share = (float)w->eye_share[c][g];
        if (share == 0.0f) continue;
        const float *row = w->eye_rows[c][g];
        lobe_filter_plane(w->planes[c], w->width, w->height, row, row, w->eye_radius, w->scratch,
                          w->part);
        for (size_t i = 0; i < w->count; i++) w->blurred[c][i] += share * w->part[i];
    }
}

static void perceive(flip_work *w, colour *perceived) {
    for (int c = 0; c < CHANNELS; c++) blur_channel(w, c);
    for (size_t i = 0; i < w->count; i++) {
        colour c =
            lobe_rgb_of_opponent((colour){{w->blurred[0][i], w->blurred[1][i], w->blurred[2][i]}});
        for (int k = 0; k < 3; k++) c.v[k] = fminf(fmaxf(c.v[k], 0.0f), 1.0f);
        perceived[i] = lobe_perceived_of_rgb(c);
    }
}

/* Length of the gradient, or of the second derivatives, of the lightness. */
static void find_features(flip_work *w, const float *derivative, float *features) {
    float *lightness = w->blurred[0], *along_x = w->blurred[1], *along_y = w->blurred[2];
    for (size_t i = 0; i < w->count; i++) lightness[i] = (w->planes[0][i] + 16.0f) / 116.0f;
    lobe_filter_plane(lightness, w->width, w->height, derivative, w->smooth, w->feature_radius,
                      w->scratch, along_x);
    lobe_filter_plane(lightness, w->width, w->height, w->smooth, derivative, w->feature_radius,
                      w->scratch, along_y);
    for (size_t i = 0; i < w->count; i++) features[i] = hypotf(along_x[i], along_y[i]);
}

static void analyse(flip_work *w, const float *rgb, int which) {
    to_opponent(w, rgb);
    perceive(w, w->perceived[which]);
    find_features(w, w->first, w->edges[which]);
    find_features(w, w->second, w->points[which]);
}

/* ---- Two pictures ---------------------------------------------------------------------------- */

static float greatest_colour_difference(void) {
    const colour green = {{0.0f, 1.0f, 0.0f}}, blue = {{0.0f, 0.0f, 1.0f}};
    return powf(lobe_colour_distance(lobe_perceived_of_rgb(green), lobe_perceived_of_rgb(blue)),
                colour_power);
}

/* To [0, 1]: small differences take most of the range. */
static float colour_difference(colour a, colour b, float greatest) {
    const float d = powf(lobe_colour_distance(a, b), colour_power), knee = knee_at * greatest;
    if (d < knee) return d * knee_value / knee;
    return knee_value + (d - knee) / (greatest - knee) * (1.0f - knee_value);
}

static float feature_difference(const flip_work *w, size_t i) {
    const float edges = fabsf(w->edges[0][i] - w->edges[1][i]);
    const float points = fabsf(w->points[0][i] - w->points[1][i]);
    return fminf(powf(fmaxf(edges, points) / sqrtf(2.0f), feature_power), 1.0f);
}

/* Raises map to the differences of what a screen shows of the two pictures. */
static void raise_to_ldr(flip_work *w, const float *picture, const float *reference, float *map) {
    const float greatest = greatest_colour_difference();
    analyse(w, picture, 0);
    analyse(w, reference, 1);
    for (size_t i = 0; i < w->count; i++) {
        const float c = colour_difference(w->perceived[0][i], w->perceived[1][i], greatest);
        const float d = powf(fminf(c, 1.0f), 1.0f - feature_difference(w, i));
        map[i] = fmaxf(map[i], d);
    }
}

/* The greatest difference over the exposures. 0: out of memory. */
static int raise_to_hdr(flip_work *w, const float *picture, const float *reference, float *map) {
    const size_t values = 3 * w->count;
    float *shown[2] = {malloc(values * sizeof(float)), malloc(values * sizeof(float))};
    tone_range range = {0};
    int ok = shown[0] && shown[1] && lobe_find_tone_range(reference, w->count, &range);
    for (int k = 0; ok && k < range.steps; k++) {
        const float scale = exp2f(lobe_tone_exposure(&range, k));
        for (size_t i = 0; i < values; i++) {
            shown[0][i] = lobe_tone(fmaxf(picture[i], 0.0f) * scale);
            shown[1][i] = lobe_tone(fmaxf(reference[i], 0.0f) * scale);
        }
        raise_to_ldr(w, shown[0], shown[1], map);
    }
    free(shown[0]);
    free(shown[1]);
    return ok;
}

/* ---- Memory ---------------------------------------------------------------------------------- */

/* The next `size` floats of a block that is cut up in order; NULL stays NULL, which measures the need. */
static float *take(float *block, size_t *used, size_t size) {
    float *part = block ? block + *used : NULL;
    *used += size;
    return part;
}

static size_t lay_out(flip_work *w, float *block) {
    const size_t eye_size = 2 * (size_t)w->eye_radius + 1;
    const size_t feature_size = 2 * (size_t)w->feature_radius + 1;
    size_t used = 0;
    for (int c = 0; c < CHANNELS; c++) {
        for (int g = 0; g < GAUSSIANS; g++) w->eye_rows[c][g] = take(block, &used, eye_size);
        w->planes[c] = take(block, &used, w->count);
        w->blurred[c] = take(block, &used, w->count);
    }
    w->smooth = take(block, &used, feature_size);
    w->first = take(block, &used, feature_size);
    w->second = take(block, &used, feature_size);
    w->scratch = take(block, &used, w->count);
    w->part = take(block, &used, w->count);
    for (int k = 0; k < 2; k++) {
        w->perceived[k] = (colour *)take(block, &used, 3 * w->count);
        w->edges[k] = take(block, &used, w->count);
        w->points[k] = take(block, &used, w->count);
    }
    return used;
}

static void write_result(const flip_work *w, const float *own_map, float *map, double *mean) {
    double sum = 0.0;
    for (size_t i = 0; i < w->count; i++) sum += (double)own_map[i];
    *mean = sum / (double)w->count;
    if (map) memcpy(map, own_map, w->count * sizeof *map);
}

int lobe_flip(const float *picture, const float *reference, int width, int height,
              lobe_flip_range range, float pixels_per_degree, float *map, double *mean) {
    const double ppd = (double)pixels_per_degree;
    flip_work w = {.width = width, .height = height, .count = (size_t)width * (size_t)height};
    w.eye_radius = (int)ceil(3.0 * sqrt(eye[2].width[0] / (2.0 * pi * pi)) * ppd);
    w.feature_radius = (int)ceil(3.0 * 0.5 * feature_degrees * ppd);
    float *block = malloc(lay_out(&w, NULL) * sizeof *block);
    float *own_map = calloc(w.count, sizeof *own_map);
    int ok = block && own_map;
    if (ok) {
        lay_out(&w, block);
        make_eye_filters(&w, ppd);
        make_feature_filters(&w, ppd);
        if (range == LOBE_FLIP_HDR)
            ok = raise_to_hdr(&w, picture, reference, own_map);
        else
            raise_to_ldr(&w, picture, reference, own_map);
    }
    if (ok) write_result(&w, own_map, map, mean);
    free(own_map);
    free(block);
    return ok;
}
