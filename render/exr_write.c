/* A film as OpenEXR: colour, extra channels as layers, and what made the picture as attributes. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "../exr/chunk.h"
#include "exr_film.h"
#include "lobe/version.h"
#include "message.h"
#include "output.h"

enum { CHANNELS_MAX = 5 + 3 * LOBE_AOV_COUNT };

typedef struct channel {
    char name[32];
    const float *values; /* the first pixel's */
    int stride;          /* floats from pixel to pixel */
} channel;

typedef struct layers {
    float *planes[3 + LOBE_AOV_COUNT]; /* owned */
    int plane_count;
    channel channels[CHANNELS_MAX];
    int count;
} layers;

static void silent(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context, (void)code, (void)message;
}

static int64_t write_at(exr_const_context_t context, void *user, const void *data, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t error) {
    (void)context, (void)error;
    output *out = user;
    if (!out->error && fseeko(out->file, (off_t)offset, SEEK_SET) != 0) out->error = errno;
    lobe_output_write(out, data, (size_t)size);
    return out->error ? -1 : (int64_t)size;
}

static void add_layer(layers *l, const char *prefix, const char *components, float *plane) {
    int count = (int)strlen(components);
    l->planes[l->plane_count++] = plane;
    for (int i = 0; i < count; i++) {
        channel *c = &l->channels[l->count++];
        *c = (channel){"", plane + i, count};
        snprintf(c->name, sizeof c->name, "%s%c", prefix, components[i]);
    }
}

static int by_name(const void *a, const void *b) {
    return strcmp(((const channel *)a)->name, ((const channel *)b)->name);
}

/* Whether one number says how many samples the pixels have. */
static int is_even(const lobe_film *film) {
    for (size_t i = 0; i < (size_t)film->width * (size_t)film->height; i++)
        if (film->pixels[i].samples != film->metadata.samples) return 0;
    return 1;
}

static int add_samples(layers *l, const lobe_film *film) {
    size_t count = (size_t)film->width * (size_t)film->height;
    float *plane = malloc(count * sizeof *plane);
    if (!plane) return 0;
    for (size_t i = 0; i < count; i++) plane[i] = (float)film->pixels[i].samples;
    add_layer(l, EXR_SAMPLES_LAYER, "Y", plane);
    return 1;
}

static int add_weights(layers *l, const lobe_film *film) {
    size_t count = (size_t)film->width * (size_t)film->height;
    float *plane = malloc(count * sizeof *plane);
    if (!plane) return 0;
    for (size_t i = 0; i < count; i++) plane[i] = (float)film->weights[i];
    add_layer(l, EXR_WEIGHTS_LAYER, "Y", plane);
    return 1;
}

/* Planes of all channels, sorted by name as the format demands. 0: no memory. */
static int gather(const lobe_film *film, float scale, layers *l) {
    size_t count = (size_t)film->width * (size_t)film->height;
    float *rgb = malloc(count * 3 * sizeof *rgb);
    if (!rgb) return 0;
    lobe_film_copy_rgb(film, rgb);
    for (size_t i = 0; i < 3 * count; i++) rgb[i] *= scale;
    add_layer(l, "", "RGB", rgb);
    for (int aov = 0; aov < LOBE_AOV_COUNT; aov++) {
        if (!(film->aovs & LOBE_AOV_BIT(aov))) continue;
        float *plane = malloc(count * (size_t)lobe_aov_channels((lobe_aov)aov) * sizeof *plane);
        if (!plane) return 0;
        lobe_film_copy_aov(film, (lobe_aov)aov, plane);
        char prefix[24];
        snprintf(prefix, sizeof prefix, "%s.", lobe_aov_name((lobe_aov)aov));
        add_layer(l, prefix, lobe_exr_components((lobe_aov)aov), plane);
    }
    if (film->metadata.identity[0] && !is_even(film) && !add_samples(l, film)) return 0;
    if (film->metadata.identity[0] && film->weights && !add_weights(l, film)) return 0;
    qsort(l->channels, (size_t)l->count, sizeof *l->channels, by_name);
    return 1;
}

/* "3,7" */
static void write_seeds(exr_context_t file, const film_metadata *m) {
    const size_t room = 24 * (size_t)m->seed_count + 1;
    char *text = calloc(room, 1);
    size_t used = 0;
    for (uint32_t i = 0; i < m->seed_count && text; i++)
        used += (size_t)snprintf(text + used, room - used, "%s%llu", i ? "," : "",
                                 (unsigned long long)m->seeds[i]);
    if (text) exr_attr_set_string(file, 0, EXR_SEED, text);
    free(text);
}

static void write_metadata(exr_context_t file, const film_metadata *metadata,
                           const lobe_film_write_options *options) {
    char identity[EXR_OPTIONS_ROOM];
    exr_attr_set_string(file, 0, "software", "lobe " LOBE_VERSION_STRING);
    if (!metadata->identity[0]) return;
    exr_attr_set_string(file, 0, EXR_SCENE, metadata->scene);
    exr_attr_set_string(file, 0, EXR_METHOD, metadata->method);
    exr_attr_set_string(file, 0, "lobe.version", LOBE_VERSION_STRING);
    lobe_exr_options(identity, metadata->identity, options->exposure);
    exr_attr_set_string(file, 0, EXR_OPTIONS, identity);
    write_seeds(file, metadata);
    exr_attr_set_int(file, 0, EXR_SAMPLES, (int32_t)metadata->samples);
    if (options->keep_seconds)
        exr_attr_set_float(file, 0, "lobe.seconds", (float)metadata->seconds);
}

static exr_result_t write_header(exr_context_t file, const lobe_film *film, const layers *l,
                                 lobe_film_write_options options) {
    static const exr_compression_t compressions[] = {
        [LOBE_FILM_COMPRESSION_NONE] = EXR_COMPRESSION_NONE,
        [LOBE_FILM_COMPRESSION_RLE] = EXR_COMPRESSION_RLE,
        [LOBE_FILM_COMPRESSION_ZIPS] = EXR_COMPRESSION_ZIPS,
        [LOBE_FILM_COMPRESSION_ZIP] = EXR_COMPRESSION_ZIP,
        [LOBE_FILM_COMPRESSION_PIZ] = EXR_COMPRESSION_PIZ};
    int part;
    exr_result_t status = exr_add_part(file, "lobe", EXR_STORAGE_SCANLINE, &part);
    if (status == EXR_ERR_SUCCESS)
        status = exr_initialize_required_attr_simple(file, 0, film->width, film->height,
                                                     compressions[options.compression]);
    for (int i = 0; i < l->count && status == EXR_ERR_SUCCESS; i++) {
        /* Distances, motion and numbers of samples need more than the eleven bits of half. */
        int is_float = options.pixels == LOBE_FILM_FLOAT ||
                       strcmp(l->channels[i].name, "depth.Z") == 0 ||
                       strncmp(l->channels[i].name, "motion.", 7) == 0 ||
                       strcmp(l->channels[i].name, EXR_SAMPLES_LAYER "Y") == 0 ||
                       strcmp(l->channels[i].name, EXR_WEIGHTS_LAYER "Y") == 0;
        status = exr_add_channel(file, 0, l->channels[i].name,
                                 is_float ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF,
                                 EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    }
    if (status != EXR_ERR_SUCCESS) return status;
    write_metadata(file, &film->metadata, &options);
    return exr_write_header(file);
}

static void aim_channels(exr_encode_pipeline_t *pipe, const layers *l, size_t first, int width) {
    for (int i = 0; i < pipe->channel_count; i++) {
        exr_coding_channel_info_t *info = &pipe->channels[i];
        const channel *source = &l->channels[i];
        info->encode_from_ptr = (const uint8_t *)(source->values + first * (size_t)source->stride);
        info->user_pixel_stride = source->stride * (int32_t)sizeof(float);
        info->user_line_stride = info->user_pixel_stride * width;
        info->user_bytes_per_element = (int16_t)sizeof(float);
        info->user_data_type = EXR_PIXEL_FLOAT;
    }
}

static exr_result_t write_lines(exr_context_t file, const lobe_film *film, const layers *l) {
    int32_t step = 1;
    exr_chunk_compressor own = {NULL};
    exr_encode_pipeline_t pipe = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t status = exr_get_scanlines_per_chunk(file, 0, &step);
    for (int y = 0; y < film->height && status == EXR_ERR_SUCCESS; y += step) {
        exr_chunk_info_t chunk;
        status = exr_write_scanline_chunk_info(file, 0, y, &chunk);
        if (status == EXR_ERR_SUCCESS)
            status = y == 0 ? exr_encoding_initialize(file, 0, &chunk, &pipe)
                            : exr_encoding_update(file, 0, &chunk, &pipe);
        if (status != EXR_ERR_SUCCESS) break;
        aim_channels(&pipe, l, (size_t)y * (size_t)film->width, film->width);
        if (y == 0) status = exr_chunk_choose_routines(file, &pipe, &own);
        if (status == EXR_ERR_SUCCESS) status = exr_encoding_run(file, 0, &pipe);
    }
    exr_encoding_destroy(file, &pipe);
    return status;
}

lobe_render_result lobe_film_write_exr(const lobe_film *film, output *out, float scale,
                                       lobe_film_write_options options) {
    layers l = {0};
    lobe_render_result result = LOBE_RENDER_OK;
    exr_context_t file = NULL;
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = silent;
    settings.user_data = out;
    settings.write_fn = write_at;
    if (!gather(film, scale, &l)) {
        result = lobe_fail_memory(out->path);
    } else {
        exr_result_t status = exr_start_write(&file, out->path, EXR_WRITE_FILE_DIRECTLY, &settings);
        if (status == EXR_ERR_SUCCESS) status = write_header(file, film, &l, options);
        if (status == EXR_ERR_SUCCESS) status = write_lines(file, film, &l);
        exr_result_t finished = file ? exr_finish(&file) : EXR_ERR_SUCCESS;
        if (status == EXR_ERR_SUCCESS) status = finished;
        if (status != EXR_ERR_SUCCESS)
            result = lobe_fail(LOBE_RENDER_FAILED, "%s: cannot be encoded (%s); try another format",
                               out->path, exr_get_default_error_message(status));
    }
    for (int i = 0; i < l.plane_count; i++) free(l.planes[i]);
    return result;
}
