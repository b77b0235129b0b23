/* OpenEXR pictures: scan lines by the C core, in full float; tiles and what the core cannot decode
 * (DWAA, DWAB) by the RGBA interface, in half. */
#include "image.h"

#include <stdlib.h>
#include <string.h>

#include <OpenEXR/ImfCRgbaFile.h>
#include <OpenEXR/openexr.h>

#include "exr_lines.h"
#include "message.h"

/* Component (0 to 2) of a channel's name, 3 for luminance alone, -1 for any other. */
static int component_of(const char *name) {
    static const char *const names[] = {"R", "G", "B", "Y"};
    for (int i = 0; i < 4; i++)
        if (strcmp(name, names[i]) == 0) return i;
    return -1;
}

typedef struct picture_lines {
    image *picture;
    int is_luminance;
} picture_lines;

/* Let the decoder write the chunk's channels straight into the picture. */
static void aim_channels(exr_decode_pipeline_t *pipe, int line, void *user) {
    picture_lines *lines = user;
    const int width = lines->picture->width;
    vec3 *row = lines->picture->pixels + (size_t)line * (size_t)width;
    for (int i = 0; i < pipe->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipe->channels[i];
        int component = component_of(channel->channel_name);
        if (component < 0) continue;
        lines->is_luminance = component == 3;
        channel->decode_to_ptr = (uint8_t *)row + (component % 3) * (int)sizeof(float);
        channel->user_pixel_stride = (int32_t)sizeof(vec3);
        channel->user_line_stride = (int32_t)sizeof(vec3) * width;
        channel->user_bytes_per_element = (int16_t)sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
}

static exr_result_t decode_lines(exr_context_t file, exr_attr_box2i_t window, image *picture) {
    picture_lines lines = {picture, 0};
    exr_result_t status =
        lobe_exr_decode(file, window.min.y, picture->height, aim_channels, &lines);
    if (lines.is_luminance)
        for (size_t i = 0; i < (size_t)picture->width * (size_t)picture->height; i++)
            picture->pixels[i] = v3_all(picture->pixels[i].x);
    return status;
}

/* Names of the channels that make a colour, as bits: R 1, G 2, B 4, Y 8; 0 if there is no list. */
static unsigned colour_channels(exr_context_t file) {
    const exr_attr_chlist_t *channels;
    unsigned found = 0;
    if (exr_get_channels(file, 0, &channels) != EXR_ERR_SUCCESS) return 0;
    for (int i = 0; i < channels->num_channels; i++) {
        const int component = component_of(channels->entries[i].name.str);
        if (component >= 0) found |= 1u << component;
    }
    return found;
}

static int has_colour(unsigned channels) {
    return (channels & 7u) == 7u || (channels & 8u) != 0;
}

/* What the core decodes without help: scan lines, R G B or Y in full resolution, no DWA. */
static int core_can_read(exr_context_t file) {
    exr_storage_t storage;
    exr_compression_t compression;
    const exr_attr_chlist_t *channels;
    if (exr_get_storage(file, 0, &storage) != EXR_ERR_SUCCESS || storage != EXR_STORAGE_SCANLINE ||
        exr_get_compression(file, 0, &compression) != EXR_ERR_SUCCESS ||
        compression == EXR_COMPRESSION_DWAA || compression == EXR_COMPRESSION_DWAB ||
        exr_get_channels(file, 0, &channels) != EXR_ERR_SUCCESS)
        return 0;
    for (int i = 0; i < channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &channels->entries[i];
        int component = component_of(entry->name.str);
        if (component >= 0 && (entry->x_sampling != 1 || entry->y_sampling != 1)) return 0;
    }
    const unsigned found = colour_channels(file);
    return found == 7u || found == 8u;
}

static lobe_render_result create_checked(const char *path, image *picture, int64_t width,
                                         int64_t height) {
    if (width < 1 || height < 1 || width > LOBE_RENDER_SIZE_MAX || height > LOBE_RENDER_SIZE_MAX ||
        (size_t)width * (size_t)height > LOBE_IMAGE_PIXELS_MAX)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: unusable size %lld x %lld; scale it down",
                         path, (long long)width, (long long)height);
    if (!lobe_image_create(picture, (int)width, (int)height)) return lobe_fail_memory(path);
    return LOBE_RENDER_OK;
}

static void copy_half_line(vec3 *row, const ImfRgba *line, int width) {
    for (int x = 0; x < width; x++) {
        row[x] =
            v3(ImfHalfToFloat(line[x].r), ImfHalfToFloat(line[x].g), ImfHalfToFloat(line[x].b));
        /* A float that half cannot hold arrived as infinity: take half's greatest. */
        row[x] =
            v3(fminf(row[x].x, 65504.0f), fminf(row[x].y, 65504.0f), fminf(row[x].z, 65504.0f));
    }
}

static lobe_render_result read_rgba(const char *path, image *picture) {
    ImfInputFile *file = ImfOpenInputFile(path);
    if (!file)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: not an OpenEXR picture that can be read (%s); is it complete?", path,
                         ImfErrorMessage());
    int x0, y0, x1, y1;
    ImfHeaderDataWindow(ImfInputHeader(file), &x0, &y0, &x1, &y1);
    int64_t width = (int64_t)x1 - x0 + 1, height = (int64_t)y1 - y0 + 1;
    lobe_render_result result = create_checked(path, picture, width, height);
    ImfRgba *line = result == LOBE_RENDER_OK ? calloc((size_t)width, sizeof *line) : NULL;
    if (result == LOBE_RENDER_OK && !line) result = lobe_fail_memory(path);
    for (int y = y0; y <= y1 && result == LOBE_RENDER_OK; y++) {
        /* The library indexes its base pointer by absolute coordinates. */
        ImfRgba *base =
            (ImfRgba *)((uintptr_t)line - (uintptr_t)((intptr_t)x0 * (intptr_t)sizeof *line));
        if (!ImfInputSetFrameBuffer(file, base, 1, 0) || !ImfInputReadPixels(file, y, y))
            result = lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: cannot be decoded (%s); is it complete?",
                               path, ImfErrorMessage());
        else
            copy_half_line(picture->pixels + (size_t)(y - y0) * (size_t)width, line, (int)width);
    }
    free(line);
    ImfCloseInputFile(file);
    return result;
}

lobe_render_result lobe_image_read_exr(const char *path, image *picture) {
    exr_context_t file;
    lobe_render_result result = lobe_exr_open(path, &file);
    if (result != LOBE_RENDER_OK) return result;
    if (!has_colour(colour_channels(file))) {
        exr_finish(&file);
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: no channels R, G and B, and no Y; give a picture with colours", path);
    }
    exr_attr_box2i_t window;
    if (!core_can_read(file) || exr_get_data_window(file, 0, &window) != EXR_ERR_SUCCESS) {
        exr_finish(&file);
        return read_rgba(path, picture);
    }
    result = create_checked(path, picture, (int64_t)window.max.x - window.min.x + 1,
                            (int64_t)window.max.y - window.min.y + 1);
    if (result == LOBE_RENDER_OK) {
        exr_result_t status = decode_lines(file, window, picture);
        if (status != EXR_ERR_SUCCESS)
            result = lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: cannot be decoded (%s); is it complete?",
                               path, exr_get_default_error_message(status));
    }
    exr_finish(&file);
    return result;
}
