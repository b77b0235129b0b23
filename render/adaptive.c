#include "adaptive.h"

#include <math.h>
#include <stdlib.h>

enum { FIRST_ROUND = 32, GROWTH = 4, SHARE_MAX = 16, ROUNDS_MAX = 16 };

static const double even_share = 0.25;

typedef struct tile_area {
    size_t left, top, right, bottom;
} tile_area;

static size_t tiles_across(const lobe_film *film) {
    return (size_t)(film->width + TILE - 1) / TILE;
}

static size_t tile_count(const lobe_film *film) {
    return tiles_across(film) * ((size_t)(film->height + TILE - 1) / TILE);
}

static size_t min_of(size_t a, size_t b) {
    return a < b ? a : b;
}

static tile_area area_of(const lobe_film *film, size_t tile) {
    const size_t left = tile % tiles_across(film) * TILE, top = tile / tiles_across(film) * TILE;
    return (tile_area){left, top, min_of(left + TILE, (size_t)film->width),
                       min_of(top + TILE, (size_t)film->height)};
}

static double pixels_of(const lobe_film *film, size_t tile) {
    const tile_area a = area_of(film, tile);
    return (double)((a.right - a.left) * (a.bottom - a.top));
}

/* The picture grows by the same factor from round to round: plans become better, and few samples are spent by the
 * first ones. What would be a short last round is added to the one before. */
static uint32_t end_of_round(uint32_t before, uint32_t samples) {
    const uint64_t end = before ? (uint64_t)GROWTH * before : FIRST_ROUND;
    return samples < end + end / 2 ? samples : (uint32_t)end;
}

uint32_t lobe_adaptive_before(uint32_t round, uint32_t samples) {
    uint32_t before = 0;
    for (uint32_t r = 0; r < round; r++) before = end_of_round(before, samples);
    return before;
}

/* Squared relative error of a pixel: half the difference of the halves has the variance of their mean. */
static double error_of(const lobe_film *film, size_t pixel) {
    const film_pixel *p = &film->pixels[pixel];
    const double weight = film->weights[pixel];
    if (!(weight > 0.0)) return 0.0;
    const double all = 0.2126 * p->rgb[0] + 0.7152 * p->rgb[1] + 0.0722 * p->rgb[2];
    const double difference = (2.0 * p->half - all) / weight, mean = all / weight;
    return difference * difference / (mean * mean + 0.01);
}

/* Standard deviation of one sample of a tile, whose weights are known: the variance of their mean is s^2 times the sum of
 * their squares over the square of their sum. */
static double deviation_of(const lobe_film *film, size_t tile, uint32_t before) {
    const tile_area a = area_of(film, tile);
    double sum = 0.0;
    for (size_t y = a.top; y < a.bottom; y++)
        for (size_t x = a.left; x < a.right; x++)
            sum += error_of(film, y * (size_t)film->width + x);
    return before * sqrt(sum / (pixels_of(film, tile) * film->tiles[tile].squares));
}

/* Samples a pixel of a tile, in units of the mean. */
static double share_of(double deviation, double scale) {
    return fmin(even_share + scale * deviation, SHARE_MAX);
}

static double mean_share(const lobe_film *film, double scale) {
    double sum = 0.0;
    for (size_t t = 0; t < tile_count(film); t++)
        sum += pixels_of(film, t) * share_of(film->tiles[t].deviation, scale);
    return sum / ((double)film->width * film->height);
}

/* What makes the mean share 1, or nearly: few tiles can take only so much. */
static double find_scale(const lobe_film *film) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 200 && mean_share(film, high) < 1.0; i++) high *= 2.0;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (mean_share(film, middle) < 1.0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Rounding is carried from tile to tile, so that the sum is right. */
static void plan_tiles(lobe_film *film, uint32_t samples) {
    const double scale = find_scale(film);
    double carried = 0.0;
    for (size_t t = 0; t < tile_count(film); t++) {
        const double pixels = pixels_of(film, t);
        const double wanted =
            samples * share_of(film->tiles[t].deviation, scale) + carried / pixels;
        const double planned = fmax(floor(wanted / ROUND_STEP + 0.5), 1.0) * ROUND_STEP;
        carried = (wanted - planned) * pixels;
        film->tiles[t].planned = (uint32_t)planned;
    }
}

static void find_deviations(lobe_film *film, uint32_t before) {
    double sum = 0.0;
    for (size_t t = 0; t < tile_count(film); t++)
        sum += film->tiles[t].deviation = deviation_of(film, t, before);
    /* without any noise, or with numbers too large for squares, all tiles are alike */
    for (size_t t = 0; t < tile_count(film) && !(sum > 0.0 && isfinite(sum)); t++)
        film->tiles[t].deviation = 1.0;
}

int lobe_adaptive_plan(lobe_film *film, uint32_t samples) {
    const uint32_t before = lobe_adaptive_before(film->round, samples);
    const uint32_t planned = end_of_round(before, samples) - before;
    if (planned == 0) return 0;
    if (before > 0) find_deviations(film, before);
    for (size_t t = 0; t < tile_count(film); t++) {
        film_tile *tile = &film->tiles[t];
        tile->before += tile->planned;
        tile->planned = FIRST_ROUND;
        tile->done = 0;
    }
    if (before > 0) plan_tiles(film, planned);
    film->round++;
    return 1;
}

int lobe_adaptive_begin(lobe_film *film, uint32_t samples) {
    film->tiles = calloc(tile_count(film), sizeof *film->tiles);
    return film->tiles && lobe_film_add_weights(film) && lobe_adaptive_plan(film, samples);
}

void lobe_adaptive_schedule(const lobe_film *film, uint32_t samples, schedule *s) {
    const uint32_t before = lobe_adaptive_before(film->round - 1, samples);
    for (size_t t = 0; t < s->tiles; t++) {
        s->planned[t] = film->tiles[t].planned;
        s->done[t] = film->tiles[t].done;
    }
    lobe_schedule_begin_round(s, film->round - 1, end_of_round(before, samples) - before);
}

/* Every pixel has the weight that follows from the tile's numbers, but for samples that were dropped. */
static int has_weights(const lobe_film *film, size_t tile, double weight) {
    const tile_area a = area_of(film, tile);
    for (size_t y = a.top; y < a.bottom; y++)
        for (size_t x = a.left; x < a.right; x++) {
            const size_t i = y * (size_t)film->width + x;
            if (!(film->weights[i] <= weight * (1.0 + 1e-9))) return 0;
            if (!film->pixels[i].dropped && !(film->weights[i] >= weight * (1.0 - 1e-9))) return 0;
        }
    return 1;
}

int lobe_adaptive_is_sane(const lobe_film *film, uint32_t samples) {
    if (film->round < 1 || film->round > ROUNDS_MAX) return 0;
    const uint32_t before = lobe_adaptive_before(film->round - 1, samples);
    const uint32_t mean = end_of_round(before, samples) - before;
    for (size_t t = 0; t < tile_count(film) && mean > 0; t++) {
        const film_tile *tile = &film->tiles[t];
        if (tile->planned < ROUND_STEP || tile->planned % ROUND_STEP != 0 ||
            tile->planned > INT32_MAX || tile->done > tile->planned ||
            tile->done % ROUND_STEP != 0 || tile->before > INT32_MAX ||
            (before > 0 && !(tile->squares > 0.0)) ||
            !has_weights(film, t, before + (double)tile->done * mean / tile->planned))
            return 0;
    }
    return mean > 0;
}
