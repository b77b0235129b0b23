#include "film.h"

#include <stdlib.h>
#include <string.h>

#include "image.h"
#include "lobe/metrics.h"
#include "message.h"

/* Channels that come from the sums of the first hit. */
static const uint32_t first_hit_aovs =
    LOBE_AOV_BIT(LOBE_AOV_ALBEDO) | LOBE_AOV_BIT(LOBE_AOV_NORMAL) | LOBE_AOV_BIT(LOBE_AOV_DEPTH) |
    LOBE_AOV_BIT(LOBE_AOV_VNDF_INTEGRAL) | LOBE_AOV_BIT(LOBE_AOV_MOTION);

lobe_film *lobe_film_create(int width, int height, uint32_t aovs) {
    size_t count = (size_t)width * (size_t)height;
    lobe_film *film = calloc(1, sizeof *film);
    if (!film) return NULL;
    *film = (lobe_film){.width = width, .height = height, .aovs = aovs};
    film->metadata.part = film->metadata.parts = 1;
    film->pixels = calloc(count, sizeof *film->pixels);
    if (aovs & first_hit_aovs)
        film->first_hit = calloc(count * FILM_FIRST_HIT_VALUES, sizeof *film->first_hit);
    if (!film->pixels || ((aovs & first_hit_aovs) && !film->first_hit)) {
        lobe_film_free(film);
        return NULL;
    }
    return film;
}

int lobe_film_add_weights(lobe_film *film) {
    film->weights = calloc((size_t)film->width * (size_t)film->height, sizeof *film->weights);
    return film->weights != NULL;
}

void lobe_film_free(lobe_film *film) {
    if (!film) return;
    free(film->pixels);
    free(film->weights);
    free(film->tiles);
    free(film->first_hit);
    free(film->metadata.seeds);
    free(film);
}

int lobe_film_width(const lobe_film *film) {
    return film->width;
}

int lobe_film_height(const lobe_film *film) {
    return film->height;
}

void lobe_film_add(lobe_film *film, size_t index, const film_sample *sample) {
    film_pixel *pixel = &film->pixels[index];
    pixel->draws += sample->draws;
    pixel->rejected += sample->rejected;
    if (!v3_is_finite(sample->radiance)) {
        pixel->dropped++;
        return;
    }
    pixel->samples++;
    pixel->rgb[0] += (double)sample->radiance.x;
    pixel->rgb[1] += (double)sample->radiance.y;
    pixel->rgb[2] += (double)sample->radiance.z;
    if (sample->is_first_half) pixel->half += (double)v3_luminance(sample->radiance);
    if (film->first_hit) {
        const float values[FILM_FIRST_HIT_VALUES] = {
            sample->albedo.x,  sample->albedo.y, sample->albedo.z, sample->normal.x,
            sample->normal.y,  sample->normal.z, sample->depth,    sample->vndf_integral,
            sample->motion[0], sample->motion[1]};
        for (int i = 0; i < FILM_FIRST_HIT_VALUES; i++)
            film->first_hit[index * FILM_FIRST_HIT_VALUES + (size_t)i] += (double)values[i];
    }
}

void lobe_film_clear(lobe_film *film) {
    const size_t count = (size_t)film->width * (size_t)film->height;
    memset(film->pixels, 0, count * sizeof *film->pixels);
    if (film->first_hit)
        memset(film->first_hit, 0, count * FILM_FIRST_HIT_VALUES * sizeof *film->first_hit);
}

static void add_pixel(film_pixel *sum, const film_pixel *more, double weight) {
    for (int c = 0; c < 3; c++) sum->rgb[c] += weight * more->rgb[c];
    sum->half += weight * more->half;
    sum->samples += more->samples;
    sum->dropped += more->dropped;
    sum->draws += more->draws;
    sum->rejected += more->rejected;
}

void lobe_film_add_part(lobe_film *film, int left, int top, const lobe_film *part, double weight) {
    for (int y = 0; y < part->height && top + y < film->height; y++)
        for (int x = 0; x < part->width && left + x < film->width; x++) {
            const size_t to = (size_t)(top + y) * (size_t)film->width + (size_t)(left + x);
            const size_t from = (size_t)y * (size_t)part->width + (size_t)x;
            add_pixel(&film->pixels[to], &part->pixels[from], weight);
            if (film->weights) film->weights[to] += weight * lobe_film_weight(part, from);
            for (size_t i = 0; film->first_hit && i < FILM_FIRST_HIT_VALUES; i++)
                film->first_hit[to * FILM_FIRST_HIT_VALUES + i] +=
                    weight * part->first_hit[from * FILM_FIRST_HIT_VALUES + i];
        }
}

int lobe_film_set_seeds(lobe_film *film, const uint64_t *seeds, uint32_t count) {
    uint64_t *copy = malloc(count * sizeof *copy + 1);
    if (!copy) return 0;
    memcpy(copy, seeds, count * sizeof *copy);
    free(film->metadata.seeds);
    film->metadata.seeds = copy;
    film->metadata.seed_count = count;
    return 1;
}

uint32_t lobe_film_most_samples(const lobe_film *film) {
    uint32_t most = 0;
    for (size_t i = 0; i < (size_t)film->width * (size_t)film->height; i++)
        if (lobe_film_tried(film, i) > most) most = lobe_film_tried(film, i);
    return most;
}

lobe_film_samples lobe_film_get_samples(const lobe_film *film) {
    lobe_film_samples s = {UINT32_MAX, lobe_film_most_samples(film), film->metadata.seed_count};
    for (size_t i = 0; i < (size_t)film->width * (size_t)film->height; i++)
        if (lobe_film_tried(film, i) < s.fewest) s.fewest = lobe_film_tried(film, i);
    return s;
}

/* How many of the first `samples` belong to the first half. */
static uint32_t first_half_of(uint32_t samples) {
    const uint32_t pair = 2 * FILM_HALF_BLOCK, rest = samples % pair;
    return samples / pair * FILM_HALF_BLOCK + (rest < FILM_HALF_BLOCK ? rest : FILM_HALF_BLOCK);
}

double lobe_film_noise(const lobe_film *film) {
    double sum = 0.0;
    size_t pixels = 0;
    for (size_t i = 0; i < (size_t)film->width * (size_t)film->height; i++) {
        const film_pixel *p = &film->pixels[i];
        const double n = lobe_film_weight(film, i);
        const double first = film->weights ? 0.5 * n : first_half_of(p->samples);
        const double second = n - first;
        if (p->samples == 0) continue;
        if (p->samples < 2 * FILM_HALF_BLOCK) return NAN;
        const double all = 0.2126 * p->rgb[0] + 0.7152 * p->rgb[1] + 0.0722 * p->rgb[2];
        const double difference = p->half / first - (all - p->half) / second, mean = all / n;
        sum += difference * difference * first * second / (n * n) / (mean * mean + 0.01);
        pixels++;
    }
    return pixels ? sqrt(sum / (double)pixels) : NAN;
}

vec3 lobe_film_mean(const lobe_film *film, size_t index) {
    const film_pixel *pixel = &film->pixels[index];
    const double weight = lobe_film_weight(film, index);
    if (!(weight > 0.0)) return v3_all(0.0f);
    return v3((float)(pixel->rgb[0] / weight), (float)(pixel->rgb[1] / weight),
              (float)(pixel->rgb[2] / weight));
}

int lobe_film_copy_rgb(const lobe_film *film, float *rgb) {
    for (size_t i = 0; i < (size_t)film->width * (size_t)film->height; i++) {
        vec3 mean = lobe_film_mean(film, i);
        memcpy(rgb + 3 * i, &mean, 3 * sizeof *rgb);
    }
    return 1;
}

static void copy_first_hit(const lobe_film *film, int offset, int channels, float *values) {
    for (size_t i = 0; i < (size_t)film->width * (size_t)film->height; i++) {
        const double *sums = film->first_hit + i * FILM_FIRST_HIT_VALUES + offset;
        const double weight = lobe_film_weight(film, i);
        for (int c = 0; c < channels; c++)
            *values++ = weight > 0.0 ? (float)(sums[c] / weight) : 0.0f;
    }
}

static void copy_rejected(const lobe_film *film, float *values) {
    for (size_t i = 0; i < (size_t)film->width * (size_t)film->height; i++) {
        const film_pixel *pixel = &film->pixels[i];
        values[i] = pixel->draws ? (float)((double)pixel->rejected / (double)pixel->draws) : 0.0f;
    }
}

int lobe_film_copy_aov(const lobe_film *film, lobe_aov aov, float *values) {
    static const int offsets[LOBE_AOV_COUNT] = {[LOBE_AOV_ALBEDO] = 0,
                                                [LOBE_AOV_NORMAL] = 3,
                                                [LOBE_AOV_DEPTH] = 6,
                                                [LOBE_AOV_VNDF_INTEGRAL] = 7,
                                                [LOBE_AOV_MOTION] = 8};
    if ((unsigned)aov >= LOBE_AOV_COUNT || !(film->aovs & LOBE_AOV_BIT(aov))) return 0;
    if (aov == LOBE_AOV_REJECTED)
        copy_rejected(film, values);
    else
        copy_first_hit(film, offsets[aov], lobe_aov_channels(aov), values);
    return 1;
}

lobe_render_result lobe_film_from_rgb(const float *rgb, int width, int height, lobe_film **film) {
    *film = lobe_film_create(width, height, 0);
    for (size_t i = 0; *film && i < (size_t)width * (size_t)height; i++)
        lobe_film_add(*film, i,
                      &(film_sample){.radiance = v3(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2])});
    return *film ? LOBE_RENDER_OK : lobe_fail_memory("picture");
}

static size_t count_not_finite(const image *picture) {
    size_t count = 0;
    for (size_t i = 0; i < (size_t)picture->width * (size_t)picture->height; i++)
        count += !v3_is_finite(picture->pixels[i]);
    return count;
}

lobe_render_result lobe_film_read(const char *path, lobe_film **film) {
    *film = NULL;
    image picture;
    lobe_render_result result = lobe_image_decode(path, &picture);
    if (result != LOBE_RENDER_OK) return result;
    const size_t bad = count_not_finite(&picture);
    if (bad)
        result = lobe_fail(LOBE_RENDER_BAD_INPUT,
                           "%s: %zu pixels are infinite or no number; an error of it would be too",
                           path, bad);
    else
        result = lobe_film_from_rgb(&picture.pixels->x, picture.width, picture.height, film);
    lobe_image_free(&picture);
    return result;
}

lobe_render_result lobe_film_compare(const lobe_film *film, const lobe_film *reference,
                                     lobe_picture_difference *difference) {
    *difference = (lobe_picture_difference){0};
    if (film->width != reference->width || film->height != reference->height)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "compare: sizes differ, %d x %d and %d x %d; render both at one size",
                         film->width, film->height, reference->width, reference->height);
    const size_t count = (size_t)film->width * (size_t)film->height;
    float *rgb[2] = {malloc(3 * count * sizeof(float)), malloc(3 * count * sizeof(float))};
    const int ok = rgb[0] && rgb[1];
    if (ok) {
        lobe_film_copy_rgb(film, rgb[0]);
        lobe_film_copy_rgb(reference, rgb[1]);
        *difference = lobe_compare_pictures(rgb[0], rgb[1], count);
    }
    free(rgb[0]);
    free(rgb[1]);
    return ok ? LOBE_RENDER_OK : lobe_fail_memory("compare");
}
