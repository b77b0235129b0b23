/* Named channels from OpenEXR, by its C core. */
#include <string.h>

#include <OpenEXR/openexr.h>

#include "lobe/ssr_picture.h"

static void silent(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context, (void)code, (void)message;
}

/* What is asked for. */
typedef struct request {
    int width, height, count;
    const char *const *names;
    float *const *values;
} request;

static int has_key(exr_context_t file, const char *key) {
    const char *text = NULL;
    int32_t length = 0;
    if (!key) return 1;
    return exr_attr_get_string(file, 0, "lobe.key", &length, &text) == EXR_ERR_SUCCESS && text &&
           (size_t)length == strlen(key) && memcmp(text, key, (size_t)length) == 0;
}

static int fits(exr_context_t file, const request *r) {
    exr_storage_t storage;
    exr_attr_box2i_t window;
    const exr_attr_chlist_t *channels;
    if (exr_get_storage(file, 0, &storage) != EXR_ERR_SUCCESS || storage != EXR_STORAGE_SCANLINE ||
        exr_get_data_window(file, 0, &window) != EXR_ERR_SUCCESS || window.min.x != 0 ||
        window.min.y != 0 || window.max.x != r->width - 1 || window.max.y != r->height - 1 ||
        exr_get_channels(file, 0, &channels) != EXR_ERR_SUCCESS)
        return 0;
    int found = 0;
    for (int i = 0; i < channels->num_channels; i++)
        for (int k = 0; k < r->count; k++)
            found += strcmp(channels->entries[i].name.str, r->names[k]) == 0 &&
                     channels->entries[i].x_sampling == 1 && channels->entries[i].y_sampling == 1;
    return found == r->count;
}

static void aim_channels(exr_decode_pipeline_t *pipe, const request *r, size_t first) {
    for (int i = 0; i < pipe->channel_count; i++) {
        exr_coding_channel_info_t *from = &pipe->channels[i];
        for (int k = 0; k < r->count; k++) {
            if (strcmp(from->channel_name, r->names[k]) != 0) continue;
            from->decode_to_ptr = (uint8_t *)(r->values[k] + first);
            from->user_pixel_stride = (int32_t)sizeof(float);
            from->user_line_stride = (int32_t)sizeof(float) * r->width;
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

int lobe_ssr_read_exr(const char *path, int width, int height, const char *const *names, int count,
                      const char *key, float *const *values) {
    const request r = {width, height, count, names, values};
    exr_context_t file = NULL;
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = silent;
    if (exr_start_read(&file, path, &settings) != EXR_ERR_SUCCESS) return 0;
    const int is_read =
        fits(file, &r) && has_key(file, key) && read_lines(file, &r) == EXR_ERR_SUCCESS;
    exr_finish(&file);
    return is_read;
}
