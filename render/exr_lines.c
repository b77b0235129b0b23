#include "exr_lines.h"

#include "message.h"

static void silent(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context, (void)code, (void)message;
}

lobe_render_result lobe_exr_open(const char *path, exr_context_t *file) {
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = silent;
    *file = NULL;
    const exr_result_t status = exr_start_read(file, path, &settings);
    if (status == EXR_ERR_SUCCESS) return LOBE_RENDER_OK;
    *file = NULL;
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: not an OpenEXR picture that can be read (%s); is it complete?", path,
                     exr_get_default_error_message(status));
}

exr_result_t lobe_exr_decode(exr_context_t file, int top, int height, exr_aim *aim, void *user) {
    int32_t step = 1;
    exr_decode_pipeline_t pipe = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t status = exr_get_scanlines_per_chunk(file, 0, &step);
    for (int y = 0; y < height && status == EXR_ERR_SUCCESS; y += step) {
        exr_chunk_info_t chunk;
        status = exr_read_scanline_chunk_info(file, 0, top + y, &chunk);
        if (status == EXR_ERR_SUCCESS)
            status = y == 0 ? exr_decoding_initialize(file, 0, &chunk, &pipe)
                            : exr_decoding_update(file, 0, &chunk, &pipe);
        if (status != EXR_ERR_SUCCESS) break;
        aim(&pipe, y, user);
        if (y == 0) status = exr_decoding_choose_default_routines(file, 0, &pipe);
        if (status == EXR_ERR_SUCCESS) status = exr_decoding_run(file, 0, &pipe);
    }
    exr_decoding_destroy(file, &pipe);
    return status;
}
