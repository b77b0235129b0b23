/* exr/chunk.h: what both writers of OpenEXR files, of render/ and of ssr/, need beside the library.
 *
 * OpenEXR 3.1 leaves a chunk compressed if that is exactly as long as its pixels. Readers take what is so long for the
 * pixels themselves, and noise becomes garbage. */
#ifndef LOBE_EXR_CHUNK_H
#define LOBE_EXR_CHUNK_H

#include <string.h>

#include <OpenEXR/openexr.h>

/* Stays where it is for as long as the pipeline. */
typedef struct exr_chunk_compressor {
    exr_result_t (*compress)(exr_encode_pipeline_t *pipe); /* the library's */
} exr_chunk_compressor;

static inline exr_result_t exr_chunk_compress(exr_encode_pipeline_t *pipe) {
    const exr_chunk_compressor *own = pipe->encoding_user_data;
    const exr_result_t status = own->compress(pipe);
    if (status == EXR_ERR_SUCCESS && pipe->compressed_bytes == pipe->packed_bytes)
        memcpy(pipe->compressed_buffer, pipe->packed_buffer, (size_t)pipe->packed_bytes);
    return status;
}

/* exr_encoding_choose_default_routines, and whole chunks. */
static inline exr_result_t exr_chunk_choose_routines(exr_context_t file,
                                                     exr_encode_pipeline_t *pipe,
                                                     exr_chunk_compressor *own) {
    const exr_result_t status = exr_encoding_choose_default_routines(file, 0, pipe);
    own->compress = pipe->compress_fn;
    pipe->encoding_user_data = own;
    if (status == EXR_ERR_SUCCESS && own->compress) pipe->compress_fn = exr_chunk_compress;
    return status;
}

#endif
