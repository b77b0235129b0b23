/* Named channels as OpenEXR, by its C core. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../exr/chunk.h"
#include "lobe/ssr_picture.h"
#include "lobe/version.h"
#include "message.h"
#include "output.h"

enum { CHANNELS_MAX = 32 };

static void silent(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context, (void)code, (void)message;
}

static int64_t write_at(exr_const_context_t context, void *user, const void *data, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t error) {
    (void)context, (void)error;
    ssr_output *out = user;
    if (!out->error && fseeko(out->file, (off_t)offset, SEEK_SET) != 0) out->error = errno;
    lobe_ssr_output_write(out, data, (size_t)size);
    return out->error ? -1 : (int64_t)size;
}

static int by_name(const void *a, const void *b) {
    return strcmp(((const lobe_ssr_channel *)a)->name, ((const lobe_ssr_channel *)b)->name);
}

static exr_result_t write_header(exr_context_t file, int width, int height,
                                 const lobe_ssr_channel *channels, int count, const char *key) {
    int part;
    exr_result_t status = exr_add_part(file, "lobe", EXR_STORAGE_SCANLINE, &part);
    if (status == EXR_ERR_SUCCESS)
        status = exr_initialize_required_attr_simple(file, 0, width, height, EXR_COMPRESSION_ZIP);
    for (int i = 0; i < count && status == EXR_ERR_SUCCESS; i++)
        status = exr_add_channel(file, 0, channels[i].name, EXR_PIXEL_FLOAT,
                                 EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    if (status == EXR_ERR_SUCCESS)
        status = exr_attr_set_string(file, 0, "software", "lobe " LOBE_VERSION_STRING);
    if (status == EXR_ERR_SUCCESS && key) status = exr_attr_set_string(file, 0, "lobe.key", key);
    return status == EXR_ERR_SUCCESS ? exr_write_header(file) : status;
}

static void aim_channels(exr_encode_pipeline_t *pipe, const lobe_ssr_channel *channels,
                         size_t first, int width) {
    for (int i = 0; i < pipe->channel_count; i++) {
        exr_coding_channel_info_t *to = &pipe->channels[i];
        to->encode_from_ptr =
            (const uint8_t *)(channels[i].values + first * (size_t)channels[i].stride);
        to->user_pixel_stride = channels[i].stride * (int32_t)sizeof(float);
        to->user_line_stride = to->user_pixel_stride * width;
        to->user_bytes_per_element = (int16_t)sizeof(float);
        to->user_data_type = EXR_PIXEL_FLOAT;
    }
}

static exr_result_t write_lines(exr_context_t file, int width, int height,
                                const lobe_ssr_channel *channels) {
    int32_t step = 1;
    exr_chunk_compressor own = {NULL};
    exr_encode_pipeline_t pipe = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t status = exr_get_scanlines_per_chunk(file, 0, &step);
    for (int y = 0; y < height && status == EXR_ERR_SUCCESS; y += step) {
        exr_chunk_info_t chunk;
        status = exr_write_scanline_chunk_info(file, 0, y, &chunk);
        if (status == EXR_ERR_SUCCESS)
            status = y == 0 ? exr_encoding_initialize(file, 0, &chunk, &pipe)
                            : exr_encoding_update(file, 0, &chunk, &pipe);
        if (status != EXR_ERR_SUCCESS) break;
        aim_channels(&pipe, channels, (size_t)y * (size_t)width, width);
        if (y == 0) status = exr_chunk_choose_routines(file, &pipe, &own);
        if (status == EXR_ERR_SUCCESS) status = exr_encoding_run(file, 0, &pipe);
    }
    exr_encoding_destroy(file, &pipe);
    return status;
}

lobe_ssr_result lobe_ssr_write_exr(const char *path, int width, int height,
                                   const lobe_ssr_channel *channels, int count, const char *key) {
    lobe_ssr_channel sorted[CHANNELS_MAX]; /* as the format demands */
    if (count < 1 || count > CHANNELS_MAX)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: %d channels are out of range; use 1 to %d",
                             path, count, CHANNELS_MAX);
    memcpy(sorted, channels, (size_t)count * sizeof *sorted);
    qsort(sorted, (size_t)count, sizeof *sorted, by_name);
    ssr_output out;
    const lobe_ssr_result opened = lobe_ssr_output_open(&out, path);
    if (opened != LOBE_SSR_OK) return opened;
    exr_context_t file = NULL;
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = silent;
    settings.user_data = &out;
    settings.write_fn = write_at;
    exr_result_t status = exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &settings);
    if (status == EXR_ERR_SUCCESS) status = write_header(file, width, height, sorted, count, key);
    if (status == EXR_ERR_SUCCESS) status = write_lines(file, width, height, sorted);
    const exr_result_t finished = file ? exr_finish(&file) : EXR_ERR_SUCCESS;
    return lobe_ssr_output_close(&out, status == EXR_ERR_SUCCESS && finished == EXR_ERR_SUCCESS);
}
