/* The file: a header of fixed size, the seeds, the pixels, the sums of the first hits if they are kept, the weights and
 * the tiles of an adaptive picture, the hash. In the byte order of the machine, which the header tells. */
#include "checkpoint.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <xxhash.h>

#include "message.h"
#include "output.h"
#include "schedule.h"

enum { BYTE_ORDER_MARK = 0x01020304, FORMAT = 3, SEEDS_MAX = 1 << 20 };

static const char magic[16] = "lobe checkpoint";

typedef struct header {
    char magic[16];
    uint32_t byte_order, format;
    int32_t width, height;
    uint32_t aovs, seed_count, part, parts;
    uint32_t is_weighted, tiles, round, unused;
    uint64_t size; /* of the whole file */
    checkpoint_cost cost;
    char scene[256], method[32], identity[IDENTITY_ROOM];
} header;

_Static_assert(sizeof(header) == 16 + 12 * 4 + 8 + 24 + 256 + 32 + IDENTITY_ROOM, "no padding");
_Static_assert(sizeof(film_tile) == 2 * 8 + 4 * 4, "no padding");
_Static_assert(sizeof(film_pixel) == 4 * 8 + 2 * 4 + 2 * 8, "no padding");

static uint32_t tiles_of(int32_t width, int32_t height) {
    return (uint32_t)((width + TILE - 1) / TILE) * (uint32_t)((height + TILE - 1) / TILE);
}

static size_t pixels_of(const header *h) {
    return (size_t)h->width * (size_t)h->height;
}

static size_t first_hit_bytes(const lobe_film *film) {
    const size_t values = (size_t)film->width * (size_t)film->height * FILM_FIRST_HIT_VALUES;
    return film->first_hit ? values * sizeof *film->first_hit : 0;
}

static size_t weight_bytes(const lobe_film *film) {
    const size_t pixels = (size_t)film->width * (size_t)film->height;
    return film->weights ? pixels * sizeof *film->weights : 0;
}

static uint64_t size_of(const header *h, const lobe_film *film) {
    return sizeof *h + h->seed_count * sizeof(uint64_t) + pixels_of(h) * sizeof(film_pixel) +
           first_hit_bytes(film) + weight_bytes(film) + h->tiles * sizeof(film_tile) +
           sizeof(XXH128_canonical_t);
}

/* ---- Writing --------------------------------------------------------------------------------- */

static void put(output *out, XXH3_state_t *hash, const void *data, size_t size) {
    XXH3_128bits_update(hash, data, size);
    lobe_output_write(out, data, size);
}

static header header_of(const lobe_film *film, checkpoint_cost cost) {
    const film_metadata *m = &film->metadata;
    header h = {.byte_order = BYTE_ORDER_MARK,
                .format = FORMAT,
                .width = film->width,
                .height = film->height,
                .aovs = film->aovs,
                .seed_count = m->seed_count,
                .part = m->part,
                .parts = m->parts,
                .is_weighted = film->weights != NULL,
                .tiles = film->tiles ? tiles_of(film->width, film->height) : 0,
                .round = film->round,
                .cost = cost};
    memcpy(h.magic, magic, sizeof h.magic);
    memcpy(h.scene, m->scene, sizeof h.scene);
    memcpy(h.method, m->method, sizeof h.method);
    memcpy(h.identity, m->identity, sizeof h.identity);
    h.size = size_of(&h, film);
    return h;
}

lobe_render_result lobe_checkpoint_write(const char *path, const lobe_film *film,
                                         checkpoint_cost cost) {
    output out;
    XXH3_state_t *hash = XXH3_createState();
    if (!hash) return lobe_fail_memory(path);
    lobe_render_result result = lobe_output_open_durable(&out, path);
    if (result == LOBE_RENDER_OK) {
        const header h = header_of(film, cost);
        XXH3_128bits_reset(hash);
        put(&out, hash, &h, sizeof h);
        put(&out, hash, film->metadata.seeds, h.seed_count * sizeof(uint64_t));
        put(&out, hash, film->pixels, pixels_of(&h) * sizeof *film->pixels);
        if (film->first_hit) put(&out, hash, film->first_hit, first_hit_bytes(film));
        if (film->weights) put(&out, hash, film->weights, weight_bytes(film));
        if (film->tiles) put(&out, hash, film->tiles, h.tiles * sizeof *film->tiles);
        XXH128_canonical_t end;
        XXH128_canonicalFromHash(&end, XXH3_128bits_digest(hash));
        lobe_output_write(&out, &end, sizeof end);
    }
    XXH3_freeState(hash);
    return lobe_output_close(&out, result);
}

/* ---- Reading --------------------------------------------------------------------------------- */

static int get(FILE *file, XXH3_state_t *hash, void *data, size_t size) {
    if (fread(data, 1, size, file) != size) return 0;
    if (hash) XXH3_128bits_update(hash, data, size);
    return 1;
}

static lobe_render_result not_whole(const char *path) {
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: not a whole checkpoint, it is cut short or changed; take another one",
                     path);
}

static int is_terminated(const char *text, size_t room) {
    return memchr(text, '\0', room) != NULL;
}

/* Numbers that no other part of the program has to doubt. */
static int is_sane(const header *h) {
    return h->width >= 1 && h->height >= 1 && h->width <= LOBE_RENDER_SIZE_MAX &&
           h->height <= LOBE_RENDER_SIZE_MAX && h->aovs < 1u << LOBE_AOV_COUNT &&
           h->seed_count >= 1 && h->seed_count <= SEEDS_MAX && h->part >= 1 &&
           h->part <= h->parts && h->is_weighted <= 1 &&
           (h->tiles == 0 || (h->is_weighted && h->tiles == tiles_of(h->width, h->height))) &&
           is_terminated(h->scene, sizeof h->scene) && is_terminated(h->method, sizeof h->method) &&
           is_terminated(h->identity, sizeof h->identity);
}

static lobe_render_result read_header(const char *path, FILE *file, XXH3_state_t *hash, header *h) {
    const int is_complete = get(file, hash, h, sizeof *h);
    if (!is_complete && ferror(file))
        return lobe_fail(LOBE_RENDER_FAILED, "%s: cannot be read (%s); check the disk", path,
                         strerror(errno));
    if (!is_complete && !lobe_checkpoint_is_one(path))
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: not a checkpoint; give a file of --checkpoint",
                         path);
    if (!is_complete) return not_whole(path);
    if (memcmp(h->magic, magic, sizeof magic) != 0)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: not a checkpoint; give a file of --checkpoint",
                         path);
    if (h->byte_order == __builtin_bswap32(BYTE_ORDER_MARK))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: of a machine with another byte order; go on where it was made", path);
    if (h->byte_order == BYTE_ORDER_MARK && h->format != FORMAT)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: format %u, not %d; go on with the version that wrote it", path,
                         h->format, FORMAT);
    return h->byte_order == BYTE_ORDER_MARK && is_sane(h) ? LOBE_RENDER_OK : not_whole(path);
}

/* 0: no memory. */
static int add_weights(lobe_film *film, const header *h) {
    if (h->is_weighted && !lobe_film_add_weights(film)) return 0;
    if (h->tiles) film->tiles = malloc(h->tiles * sizeof *film->tiles);
    film->round = h->round;
    return !h->tiles || film->tiles;
}

static int read_body(FILE *file, XXH3_state_t *hash, const header *h, lobe_film *film) {
    if (size_of(h, film) != h->size) return 0;
    film_metadata *m = &film->metadata;
    m->seeds = malloc(h->seed_count * sizeof *m->seeds);
    m->seed_count = h->seed_count;
    m->part = h->part;
    m->parts = h->parts;
    m->seconds = h->cost.seconds;
    memcpy(m->scene, h->scene, sizeof m->scene);
    memcpy(m->method, h->method, sizeof m->method);
    memcpy(m->identity, h->identity, sizeof m->identity);
    XXH128_canonical_t end;
    return m->seeds && get(file, hash, m->seeds, h->seed_count * sizeof *m->seeds) &&
           get(file, hash, film->pixels, pixels_of(h) * sizeof *film->pixels) &&
           (!film->first_hit || get(file, hash, film->first_hit, first_hit_bytes(film))) &&
           (!film->weights || get(file, hash, film->weights, weight_bytes(film))) &&
           (!film->tiles || get(file, hash, film->tiles, h->tiles * sizeof *film->tiles)) &&
           get(file, NULL, &end, sizeof end) &&
           XXH128_isEqual(XXH128_hashFromCanonical(&end), XXH3_128bits_digest(hash));
}

static lobe_render_result read_all(const char *path, FILE *file, XXH3_state_t *hash,
                                   lobe_film **film, checkpoint_cost *cost) {
    header h;
    lobe_render_result result = read_header(path, file, hash, &h);
    if (result != LOBE_RENDER_OK) return result;
    /* before memory for so many pixels is asked for */
    struct stat status;
    if (fstat(fileno(file), &status) != 0 || (uint64_t)status.st_size != h.size ||
        h.size / sizeof(film_pixel) < pixels_of(&h))
        return not_whole(path);
    *film = lobe_film_create(h.width, h.height, h.aovs);
    if (!*film || !add_weights(*film, &h)) {
        lobe_film_free(*film);
        *film = NULL;
        return lobe_fail_memory(path);
    }
    *cost = h.cost;
    if (read_body(file, hash, &h, *film)) {
        (*film)->metadata.samples = lobe_film_most_samples(*film);
        return LOBE_RENDER_OK;
    }
    lobe_film_free(*film);
    *film = NULL;
    return not_whole(path);
}

lobe_render_result lobe_checkpoint_read(const char *path, lobe_film **film, checkpoint_cost *cost) {
    *film = NULL;
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: not a file; give a file of --checkpoint",
                         path);
    FILE *file = fopen(path, "rb");
    if (!file)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: cannot be read (%s); give a file of --checkpoint", path,
                         strerror(errno));
    XXH3_state_t *hash = XXH3_createState();
    lobe_render_result result = LOBE_RENDER_FAILED;
    if (hash) {
        XXH3_128bits_reset(hash);
        result = read_all(path, file, hash, film, cost);
    } else {
        result = lobe_fail_memory(path);
    }
    XXH3_freeState(hash);
    fclose(file);
    return result;
}

int lobe_checkpoint_is_one(const char *path) {
    char start[sizeof magic];
    FILE *file = fopen(path, "rb");
    const int is_one = file && fread(start, 1, sizeof start, file) == sizeof start &&
                       memcmp(start, magic, sizeof magic) == 0;
    if (file) fclose(file);
    return is_one;
}

int lobe_checkpoint_would_destroy(const char *path) {
    struct stat status;
    if (stat(path, &status) != 0) return 0;
    return status.st_size > 0 && !lobe_checkpoint_is_one(path);
}
