/* Pictures of one scene into one. */
#include <stdlib.h>
#include <string.h>

#include "checkpoint.h"
#include "exr_film.h"
#include "image.h"
#include "message.h"

/* What is remembered of each picture: its seeds, and which pixels it has samples of. */
typedef struct source {
    const char *path;
    uint64_t *seeds;
    uint32_t seed_count;
    char spp[IDENTITY_VALUE_ROOM];
    unsigned char *has_pixel; /* a bit each */
} source;

static size_t pixels_of(const lobe_film *film) {
    return (size_t)film->width * (size_t)film->height;
}

static lobe_render_result read_picture(const char *path, lobe_film **film) {
    checkpoint_cost cost;
    if (lobe_path_ends(path, ".exr")) return lobe_exr_read_film(path, film);
    return lobe_checkpoint_read(path, film, &cost);
}

/* 0: no memory. */
static int remember(source *s, const char *path, const lobe_film *film) {
    const film_metadata *m = &film->metadata;
    const size_t pixels = pixels_of(film);
    s->path = path;
    s->seeds = malloc(m->seed_count * sizeof *s->seeds);
    s->has_pixel = calloc(pixels / 8 + 1, 1);
    if (!s->seeds || !s->has_pixel) return 0;
    memcpy(s->seeds, m->seeds, m->seed_count * sizeof *s->seeds);
    s->seed_count = m->seed_count;
    lobe_identity_value(m->identity, "spp", s->spp);
    for (size_t i = 0; i < pixels; i++)
        if (lobe_film_tried(film, i))
            s->has_pixel[i / 8] = (unsigned char)(s->has_pixel[i / 8] | 1u << i % 8);
    return 1;
}

static int shares_seed(const source *a, const source *b, uint64_t *seed) {
    for (uint32_t i = 0; i < a->seed_count; i++)
        for (uint32_t k = 0; k < b->seed_count; k++)
            if (a->seeds[i] == b->seeds[k]) {
                *seed = a->seeds[i];
                return 1;
            }
    return 0;
}

static int shares_pixel(const source *a, const source *b, size_t pixels) {
    for (size_t i = 0; i <= pixels / 8; i++)
        if (a->has_pixel[i] & b->has_pixel[i]) return 1;
    return 0;
}

/* Samples of one seed are the same samples: they may not count twice. */
static lobe_render_result check_seeds(const source *a, const source *b, size_t pixels) {
    uint64_t seed;
    if (!shares_seed(a, b, &seed)) return LOBE_RENDER_OK;
    if (shares_pixel(a, b, pixels))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: seed %llu and pixels as in %s; render it with another --seed",
                         a->path, (unsigned long long)seed, b->path);
    if (strcmp(a->spp, b->spp) != 0)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: part of a render with spp %s, that of %s has %s; give all parts the "
                         "same options",
                         a->path, a->spp, b->path, b->spp);
    return LOBE_RENDER_OK;
}

static lobe_render_result check_same_render(const char *path, const lobe_film *more,
                                            const char *first, const lobe_film *sum) {
    identity_difference d;
    const char *a = more->metadata.identity, *b = sum->metadata.identity;
    if (lobe_identity_differs(a, b, "spp", &d))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: its %s is %s, that of %s is %s; merge pictures of the same scene and "
                         "options",
                         path, d.key, d.value, first, d.other);
    if (lobe_identity_differs(b, a, "spp", &d))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: its %s is %s, that of %s is %s; merge pictures of the same scene and "
                         "options",
                         path, d.key, d.other, first, d.value);
    if (more->width == sum->width && more->height == sum->height && more->aovs == sum->aovs &&
        !more->weights == !sum->weights)
        return LOBE_RENDER_OK;
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: size or channels are not those of %s; merge pictures of the same options",
                     path, first);
}

static int by_value(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* 0: no memory. */
static int unite_seeds(lobe_film *sum, const source *more) {
    const film_metadata *m = &sum->metadata;
    const uint32_t count = m->seed_count + more->seed_count;
    uint64_t *all = malloc(count * sizeof *all);
    if (!all) return 0;
    memcpy(all, m->seeds, m->seed_count * sizeof *all);
    memcpy(all + m->seed_count, more->seeds, more->seed_count * sizeof *all);
    qsort(all, count, sizeof *all, by_value);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (i == 0 || all[i] != all[kept - 1]) all[kept++] = all[i];
    const int is_good = lobe_film_set_seeds(sum, all, kept);
    free(all);
    return is_good;
}

static lobe_render_result check_sum(const char *path, const lobe_film *more, const lobe_film *sum) {
    for (size_t i = 0; i < pixels_of(sum); i++)
        if ((uint64_t)lobe_film_tried(sum, i) + lobe_film_tried(more, i) > INT32_MAX)
            return lobe_fail(LOBE_RENDER_BAD_INPUT,
                             "%s: more than %d samples a pixel together; leave it out", path,
                             INT32_MAX);
    return LOBE_RENDER_OK;
}

static lobe_render_result add(lobe_film *sum, const lobe_film *more, source *sources,
                              size_t index) {
    const source *own = &sources[index];
    lobe_render_result result = check_same_render(own->path, more, sources[0].path, sum);
    for (size_t i = 0; i < index && result == LOBE_RENDER_OK; i++)
        result = check_seeds(own, &sources[i], pixels_of(sum));
    if (result == LOBE_RENDER_OK) result = check_sum(own->path, more, sum);
    if (result != LOBE_RENDER_OK) return result;
    lobe_film_add_part(sum, 0, 0, more, 1.0);
    free(sum->tiles); /* no render goes on from a sum of several */
    sum->tiles = NULL;
    sum->round = 0;
    sum->metadata.is_rounded |= more->metadata.is_rounded;
    return unite_seeds(sum, own) ? LOBE_RENDER_OK : lobe_fail_memory(own->path);
}

static lobe_render_result merge(const char *const *paths, size_t count, source *sources,
                                lobe_film **sum) {
    lobe_render_result result = LOBE_RENDER_OK;
    for (size_t i = 0; i < count && result == LOBE_RENDER_OK; i++) {
        lobe_film *more;
        result = read_picture(paths[i], &more);
        if (result == LOBE_RENDER_OK && !remember(&sources[i], paths[i], more))
            result = lobe_fail_memory(paths[i]);
        if (result == LOBE_RENDER_OK && i == 0) {
            *sum = more;
            continue;
        }
        if (result == LOBE_RENDER_OK) result = add(*sum, more, sources, i);
        lobe_film_free(more);
    }
    return result;
}

lobe_render_result lobe_film_merge(const char *const *paths, size_t count, lobe_film **film) {
    *film = NULL;
    if (count == 0) return lobe_fail(LOBE_RENDER_BAD_INPUT, "merge: no picture; give some");
    source *sources = calloc(count, sizeof *sources);
    lobe_film *sum = NULL;
    lobe_render_result result =
        sources ? merge(paths, count, sources, &sum) : lobe_fail_memory("merge");
    for (size_t i = 0; sources && i < count; i++) {
        free(sources[i].seeds);
        free(sources[i].has_pixel);
    }
    free(sources);
    if (result != LOBE_RENDER_OK) {
        lobe_film_free(sum);
        return result;
    }
    sum->metadata.part = sum->metadata.parts = 1;
    sum->metadata.samples = lobe_film_most_samples(sum);
    *film = sum;
    return LOBE_RENDER_OK;
}

lobe_render_result lobe_film_save(const lobe_film *film, const char *path) {
    if (film->metadata.is_rounded || !film->metadata.identity[0])
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: pictures are rounded, no checkpoint can be made of them; merge "
                         "checkpoints, or end the name with .exr",
                         path);
    if (lobe_checkpoint_would_destroy(path))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: there is a file that is no checkpoint; choose another name", path);
    return lobe_checkpoint_write(path, film, (checkpoint_cost){.seconds = film->metadata.seconds});
}
