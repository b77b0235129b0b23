/* Named channels from OpenEXR, by its C core. */
#include "exr_read.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include <OpenEXR/openexr.h>

#include "lobe/ssr_picture.h"
#include "message.h"

enum { CHANNELS_MAX = 32 };

static void silent(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context, (void)code, (void)message;
}

/* What is asked for. */
typedef struct request {
    const char *path;
    int width, height, count;
    ssr_wanted *wanted;
} request;

static int has_key(exr_context_t file, const char *key) {
    const char *text = NULL;
    int32_t length = 0;
    if (!key) return 1;
    return exr_attr_get_string(file, 0, "lobe.key", &length, &text) == EXR_ERR_SUCCESS && text &&
           (size_t)length == strlen(key) && memcmp(text, key, (size_t)length) == 0;
}

static lobe_ssr_result check_form(exr_context_t file, const request *r) {
    exr_storage_t storage;
    exr_attr_box2i_t window;
    if (exr_get_storage(file, 0, &storage) != EXR_ERR_SUCCESS || storage != EXR_STORAGE_SCANLINE)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "%s: not in scan lines; write it without tiles and depths", r->path);
    if (exr_get_data_window(file, 0, &window) != EXR_ERR_SUCCESS || window.min.x != 0 ||
        window.min.y != 0 || window.max.x != r->width - 1 || window.max.y != r->height - 1)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "%s: it holds no %d x %d pixels from (0, 0); give "
                             "all pictures the size that is announced",
                             r->path, r->width, r->height);
    return LOBE_SSR_OK;
}

static lobe_ssr_result find_channels(exr_context_t file, const request *r) {
    const exr_attr_chlist_t *channels;
    if (exr_get_channels(file, 0, &channels) != EXR_ERR_SUCCESS)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: no channels; write it again", r->path);
    for (int k = 0; k < r->count; k++) {
        ssr_wanted *w = &r->wanted[k];
        w->is_there = 0;
        for (int i = 0; i < channels->num_channels; i++) {
            const exr_attr_chlist_entry_t *entry = &channels->entries[i];
            if (strcmp(entry->name.str, w->name) != 0) continue;
            if (entry->x_sampling != 1 || entry->y_sampling != 1)
                return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                                     "%s: channel %s does not have every pixel; write it whole",
                                     r->path, w->name);
            w->is_there = 1;
        }
        if (w->is_needed && !w->is_there)
            return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: no channel %s; see docs/gbuffer.md",
                                 r->path, w->name);
    }
    return LOBE_SSR_OK;
}

static void aim_channels(exr_decode_pipeline_t *pipe, const request *r, size_t first) {
    for (int i = 0; i < pipe->channel_count; i++) {
        exr_coding_channel_info_t *from = &pipe->channels[i];
        for (int k = 0; k < r->count; k++) {
            const ssr_wanted *w = &r->wanted[k];
            if (strcmp(from->channel_name, w->name) != 0) continue;
            from->decode_to_ptr = (uint8_t *)(w->values + first * (size_t)w->stride);
            from->user_pixel_stride = (int32_t)sizeof(float) * w->stride;
            from->user_line_stride = from->user_pixel_stride * r->width;
            from->user_bytes_per_element = (int16_t)sizeof(float);
            from->user_data_type = EXR_PIXEL_FLOAT;
        }
    }
}

static exr_result_t read_lines(exr_context_t file, const request *r) {
    int32_t step = 1;
    exr_decode_pipeline_t pipe = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t status = exr_get_scanlines_per_chunk(file, 0, &step);
    for (int y = 0; y < r->height && status == EXR_ERR_SUCCESS; y += step) {
        exr_chunk_info_t chunk;
        status = exr_read_scanline_chunk_info(file, 0, y, &chunk);
        if (status == EXR_ERR_SUCCESS)
            status = y == 0 ? exr_decoding_initialize(file, 0, &chunk, &pipe)
                            : exr_decoding_update(file, 0, &chunk, &pipe);
        if (status != EXR_ERR_SUCCESS) break;
        aim_channels(&pipe, r, (size_t)y * (size_t)r->width);
        if (y == 0) status = exr_decoding_choose_default_routines(file, 0, &pipe);
        if (status == EXR_ERR_SUCCESS) status = exr_decoding_run(file, 0, &pipe);
    }
    exr_decoding_destroy(file, &pipe);
    return status;
}

/* The core says of a file that is missing the same as of one that is broken. */
static lobe_ssr_result open_file(const char *path, exr_context_t *file) {
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = silent;
    FILE *probe = fopen(path, "rb");
    if (!probe)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: cannot be read (%s); is it there?", path,
                             strerror(errno));
    fclose(probe);
    if (exr_start_read(file, path, &settings) == EXR_ERR_SUCCESS) return LOBE_SSR_OK;
    return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                         "%s: not an OpenEXR picture that can be read; is it complete?", path);
}

lobe_ssr_result lobe_ssr_read_channels(const char *path, int width, int height, ssr_wanted *wanted,
                                       int count, const char *key) {
    const request r = {path, width, height, count, wanted};
    exr_context_t file = NULL;
    lobe_ssr_result result = open_file(path, &file);
    if (result != LOBE_SSR_OK) return result;
    result = check_form(file, &r);
    if (result == LOBE_SSR_OK) result = find_channels(file, &r);
    if (result == LOBE_SSR_OK && !has_key(file, key))
        result = lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: made in another way; make it again", path);
    if (result == LOBE_SSR_OK && read_lines(file, &r) != EXR_ERR_SUCCESS)
        result =
            lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                          "%s: cannot be decoded; is it complete? ZIP is a good compression", path);
    exr_finish(&file);
    return result;
}

int lobe_ssr_read_exr(const char *path, int width, int height, const char *const *names, int count,
                      const char *key, float *const *values) {
    ssr_wanted wanted[CHANNELS_MAX];
    if (count < 1 || count > CHANNELS_MAX) return 0;
    for (int k = 0; k < count; k++) wanted[k] = (ssr_wanted){names[k], values[k], 1, 1, 0};
    return lobe_ssr_read_channels(path, width, height, wanted, count, key) == LOBE_SSR_OK;
}
