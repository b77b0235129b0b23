#include "exr_film.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exr_lines.h"
#include "image.h"
#include "message.h"

const char *lobe_exr_components(lobe_aov aov) {
    static const char *const components[LOBE_AOV_COUNT] = {
        [LOBE_AOV_ALBEDO] = "RGB", [LOBE_AOV_NORMAL] = "XYZ",      [LOBE_AOV_DEPTH] = "Z",
        [LOBE_AOV_REJECTED] = "Y", [LOBE_AOV_VNDF_INTEGRAL] = "Y", [LOBE_AOV_MOTION] = "XY"};
    return components[aov];
}

void lobe_exr_options(char text[EXR_OPTIONS_ROOM], const char *identity, float exposure) {
    snprintf(text, EXR_OPTIONS_ROOM, "%s", identity);
    if (exposure != 0.0f) snprintf(text + strlen(text), 32, "exposure %.9g\n", (double)exposure);
}

enum { CHANNELS_MAX = 5 + 3 * LOBE_AOV_COUNT };

typedef struct planes {
    int width, height, count;
    const char *names[CHANNELS_MAX]; /* of the file */
    float *values[CHANNELS_MAX];     /* owned */
} planes;

static const float *plane_of(const planes *p, const char *prefix, char component) {
    char name[64];
    snprintf(name, sizeof name, "%s%c", prefix, component);
    for (int i = 0; i < p->count; i++)
        if (strcmp(p->names[i], name) == 0) return p->values[i];
    return NULL;
}

static void aim(exr_decode_pipeline_t *pipe, int line, void *user) {
    const planes *p = user;
    for (int i = 0; i < pipe->channel_count && i < p->count; i++) {
        exr_coding_channel_info_t *channel = &pipe->channels[i];
        channel->decode_to_ptr = (uint8_t *)(p->values[i] + (size_t)line * (size_t)p->width);
        channel->user_pixel_stride = (int32_t)sizeof(float);
        channel->user_line_stride = (int32_t)sizeof(float) * p->width;
        channel->user_bytes_per_element = (int16_t)sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
}

/* ---- Attributes ------------------------------------------------------------------------------ */

/* 0: there is none, or it does not fit. */
static int read_text(exr_context_t file, const char *name, char *text, size_t room) {
    int32_t length = 0;
    const char *value = NULL;
    if (exr_attr_get_string(file, 0, name, &length, &value) != EXR_ERR_SUCCESS || !value ||
        length < 0 || (size_t)length >= room)
        return 0;
    memset(text, 0, room);
    memcpy(text, value, (size_t)length);
    return 1;
}

/* "3,7" */
static int read_seeds(const char *text, lobe_film *film) {
    uint32_t count = 1;
    for (const char *c = text; *c; c++) count += *c == ',';
    uint64_t *seeds = malloc(count * sizeof *seeds);
    int is_good = seeds != NULL;
    for (uint32_t i = 0; i < count && is_good; i++) {
        char *end;
        errno = 0;
        seeds[i] = strtoull(text, &end, 10);
        is_good =
            *text >= '0' && *text <= '9' && errno == 0 && *end == (i + 1 < count ? ',' : '\0');
        text = end + 1;
    }
    is_good = is_good && lobe_film_set_seeds(film, seeds, count);
    free(seeds);
    return is_good;
}

static int read_all_seeds(exr_context_t file, lobe_film *film) {
    int32_t length = 0;
    const char *value = NULL;
    if (exr_attr_get_string(file, 0, EXR_SEED, &length, &value) != EXR_ERR_SUCCESS || !value ||
        length < 1)
        return 0;
    char *text = strndup(value, (size_t)length);
    const int is_good = text && read_seeds(text, film);
    free(text);
    return is_good;
}

static int read_metadata(exr_context_t file, lobe_film *film) {
    film_metadata *m = &film->metadata;
    int32_t samples = 0;
    m->is_rounded = 1;
    if (exr_attr_get_int(file, 0, EXR_SAMPLES, &samples) != EXR_ERR_SUCCESS || samples < 1)
        return 0;
    m->samples = (uint32_t)samples;
    return read_text(file, EXR_SCENE, m->scene, sizeof m->scene) &&
           read_text(file, EXR_METHOD, m->method, sizeof m->method) &&
           read_text(file, EXR_OPTIONS, m->identity, sizeof m->identity) &&
           read_all_seeds(file, film);
}

/* ---- Pixels ---------------------------------------------------------------------------------- */

/* A mean times a number of samples is exact in double, and so is the way back. */
static void fill_layer(lobe_film *film, const planes *p, lobe_aov aov, int first_value) {
    char prefix[32];
    snprintf(prefix, sizeof prefix, "%s.", lobe_aov_name(aov));
    for (int c = 0; c < lobe_aov_channels(aov); c++) {
        const float *plane = plane_of(p, prefix, lobe_exr_components(aov)[c]);
        for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++)
            film->first_hit[i * FILM_FIRST_HIT_VALUES + (size_t)(first_value + c)] =
                (double)plane[i] * lobe_film_weight(film, i);
    }
}

/* A share of draws, as if there were 2^32 a sample: all that half and float hold is kept. */
static void fill_rejected(lobe_film *film, const planes *p) {
    const float *plane = plane_of(p, "rejected.", 'Y');
    for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++) {
        film_pixel *pixel = &film->pixels[i];
        const double share = plane[i] >= 0.0f && plane[i] <= 1.0f ? (double)plane[i] : 0.0;
        pixel->draws = (uint64_t)pixel->samples << 32;
        pixel->rejected = (uint64_t)(share * (double)pixel->draws);
    }
}

static int fill_samples(lobe_film *film, const planes *p) {
    const float *plane = plane_of(p, EXR_SAMPLES_LAYER, 'Y');
    for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++) {
        if (plane && !(plane[i] >= 0.0f && plane[i] <= 0x1p31f && plane[i] == floorf(plane[i])))
            return 0;
        film->pixels[i].samples = plane ? (uint32_t)plane[i] : film->metadata.samples;
    }
    return 1;
}

/* 0: no memory, or no weights. */
static int fill_weights(lobe_film *film, const planes *p) {
    const float *plane = plane_of(p, EXR_WEIGHTS_LAYER, 'Y');
    if (!plane) return 1;
    if (!lobe_film_add_weights(film)) return 0;
    for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++) {
        if (!(plane[i] >= 0.0f && plane[i] <= 0x1p31f) ||
            (plane[i] > 0.0f) != (film->pixels[i].samples > 0))
            return 0;
        film->weights[i] = (double)plane[i];
    }
    return 1;
}

static void fill_colors(lobe_film *film, const planes *p) {
    for (int c = 0; c < 3; c++) {
        const float *plane = plane_of(p, "", "RGB"[c]);
        for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++)
            film->pixels[i].rgb[c] =
                film->pixels[i].samples ? (double)plane[i] * lobe_film_weight(film, i) : 0.0;
    }
}

/* The extra channels that are there; -1: one of a layer is missing, or colour is. */
static int64_t aovs_of(const planes *p) {
    uint32_t aovs = 0;
    for (int c = 0; c < 3; c++)
        if (!plane_of(p, "", "RGB"[c])) return -1;
    for (int aov = 0; aov < LOBE_AOV_COUNT; aov++) {
        char prefix[32];
        int found = 0;
        const char *components = lobe_exr_components((lobe_aov)aov);
        snprintf(prefix, sizeof prefix, "%s.", lobe_aov_name((lobe_aov)aov));
        for (const char *c = components; *c; c++) found += plane_of(p, prefix, *c) != NULL;
        if (found == (int)strlen(components)) aovs |= LOBE_AOV_BIT(aov);
        if (found != 0 && found != (int)strlen(components)) return -1;
    }
    return aovs;
}

static lobe_render_result not_ours(const char *path) {
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: does not tell its samples and options; merge what lobe render wrote",
                     path);
}

static lobe_render_result film_of(const char *path, exr_context_t file, const planes *p,
                                  lobe_film **film) {
    static const int first_values[LOBE_AOV_COUNT] = {[LOBE_AOV_ALBEDO] = 0,
                                                     [LOBE_AOV_NORMAL] = 3,
                                                     [LOBE_AOV_DEPTH] = 6,
                                                     [LOBE_AOV_VNDF_INTEGRAL] = 7,
                                                     [LOBE_AOV_MOTION] = 8};
    const int64_t aovs = aovs_of(p);
    if (aovs < 0) return not_ours(path);
    *film = lobe_film_create(p->width, p->height, (uint32_t)aovs);
    if (!*film) return lobe_fail_memory(path);
    if (!read_metadata(file, *film) || !fill_samples(*film, p) || !fill_weights(*film, p))
        return not_ours(path);
    fill_colors(*film, p);
    for (int aov = 0; aov < LOBE_AOV_COUNT; aov++) {
        if (!(aovs & LOBE_AOV_BIT(aov))) continue;
        if (aov == LOBE_AOV_REJECTED)
            fill_rejected(*film, p);
        else
            fill_layer(*film, p, (lobe_aov)aov, first_values[aov]);
    }
    return LOBE_RENDER_OK;
}

static int create_planes(exr_context_t file, exr_attr_box2i_t window, planes *p) {
    const exr_attr_chlist_t *channels;
    const int64_t width = (int64_t)window.max.x - window.min.x + 1;
    const int64_t height = (int64_t)window.max.y - window.min.y + 1;
    if (exr_get_channels(file, 0, &channels) != EXR_ERR_SUCCESS || width < 1 || height < 1 ||
        width > LOBE_RENDER_SIZE_MAX || height > LOBE_RENDER_SIZE_MAX ||
        (size_t)width * (size_t)height > LOBE_IMAGE_PIXELS_MAX ||
        channels->num_channels > CHANNELS_MAX)
        return 0;
    *p = (planes){.width = (int)width, .height = (int)height};
    for (int i = 0; i < channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &channels->entries[i];
        if (entry->x_sampling != 1 || entry->y_sampling != 1) return 0;
        p->names[i] = entry->name.str;
        p->values[i] = calloc((size_t)width * (size_t)height, sizeof(float));
        p->count++;
        if (!p->values[i]) return 0;
    }
    return 1;
}

static int is_in_lines(exr_context_t file) {
    exr_storage_t storage;
    exr_compression_t compression;
    return exr_get_storage(file, 0, &storage) == EXR_ERR_SUCCESS &&
           storage == EXR_STORAGE_SCANLINE &&
           exr_get_compression(file, 0, &compression) == EXR_ERR_SUCCESS &&
           compression != EXR_COMPRESSION_DWAA && compression != EXR_COMPRESSION_DWAB;
}

lobe_render_result lobe_exr_read_film(const char *path, lobe_film **film) {
    exr_context_t file;
    exr_attr_box2i_t window;
    planes p = {0};
    *film = NULL;
    lobe_render_result result = lobe_exr_open(path, &file);
    if (result != LOBE_RENDER_OK) return result;
    if (!is_in_lines(file) || exr_get_data_window(file, 0, &window) != EXR_ERR_SUCCESS ||
        !create_planes(file, window, &p)) {
        result = not_ours(path);
    } else {
        const exr_result_t status = lobe_exr_decode(file, window.min.y, p.height, aim, &p);
        result =
            status == EXR_ERR_SUCCESS
                ? film_of(path, file, &p, film)
                : lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: cannot be decoded (%s); is it complete?",
                            path, exr_get_default_error_message(status));
    }
    for (int i = 0; i < p.count; i++) free(p.values[i]);
    exr_finish(&file);
    if (result == LOBE_RENDER_OK) return result;
    lobe_film_free(*film);
    *film = NULL;
    return result;
}
