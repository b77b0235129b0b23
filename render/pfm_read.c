/* Portable float maps: "PF" or "Pf", size, scale (negative: little endian), rows from the bottom. */
#include "image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"

static float swap_bytes(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    bits = __builtin_bswap32(bits);
    memcpy(&value, &bits, sizeof bits);
    return value;
}

static int read_rows(FILE *file, image *picture, int channels, int swap) {
    size_t row_floats = (size_t)picture->width * (size_t)channels;
    float *row = malloc(row_floats * sizeof *row);
    int ok = row != NULL;
    for (int y = picture->height - 1; y >= 0 && ok; y--) {
        ok = fread(row, sizeof *row, row_floats, file) == row_floats;
        vec3 *pixels = picture->pixels + (size_t)y * (size_t)picture->width;
        for (int x = 0; x < picture->width && ok; x++) {
            float c[3];
            for (int i = 0; i < 3; i++) {
                float value = row[(size_t)x * (size_t)channels + (size_t)(i % channels)];
                c[i] = swap ? swap_bytes(value) : value;
            }
            pixels[x] = v3(c[0], c[1], c[2]);
        }
    }
    free(row);
    return ok;
}

lobe_render_result lobe_image_read_pfm(const char *path, image *picture) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: cannot be opened; give a picture", path);
    char kind = 0;
    int width = 0, height = 0;
    float scale = 0.0f;
    int fields = fscanf(file, "P%c%d%d%f", &kind, &width, &height, &scale);
    int white = fgetc(file);
    lobe_render_result result = LOBE_RENDER_OK;
    if (fields != 4 || (kind != 'F' && kind != 'f') || width < 1 || height < 1 ||
        width > LOBE_RENDER_SIZE_MAX || height > LOBE_RENDER_SIZE_MAX || white == EOF ||
        (size_t)width * (size_t)height > LOBE_IMAGE_PIXELS_MAX)
        result = lobe_fail(LOBE_RENDER_BAD_INPUT,
                           "%s: not a portable float map of usable size; is it complete?", path);
    else if (!lobe_image_create(picture, width, height))
        result = lobe_fail_memory(path);
    else if (!read_rows(file, picture, kind == 'F' ? 3 : 1, scale > 0.0f))
        result = lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: cannot be decoded; is it complete?", path);
    fclose(file);
    return result;
}
