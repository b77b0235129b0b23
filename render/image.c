#include "image.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include <stb/stb_image.h>

#include "message.h"

int lobe_image_create(image *picture, int width, int height) {
    *picture = (image){width, height, calloc((size_t)width * (size_t)height, sizeof(vec3))};
    return picture->pixels != NULL;
}

void lobe_image_free(image *picture) {
    free(picture->pixels);
    picture->pixels = NULL;
}

float lobe_srgb_to_linear(float c) {
    return c <= 0.04045f ? c / 12.92f : powf((c + 0.055f) / 1.055f, 2.4f);
}

float lobe_linear_to_srgb(float c) {
    return c <= 0.0031308f ? c * 12.92f : 1.055f * powf(c, 1.0f / 2.4f) - 0.055f;
}

int lobe_path_ends(const char *path, const char *ending) {
    size_t length = strlen(path), tail = strlen(ending);
    return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

/* A file that never ends: after the last byte come line ends. At the end of a truncated .hdr stb_image
 * (2.27) reads zeros, and a run of length zero keeps it there for ever; a line end finishes a header
 * and is a run of length ten. */
typedef struct endless_file {
    FILE *file;
    int is_past_end; /* more was wanted than there is */
} endless_file;

static int read_endless(void *user, char *data, int size) {
    endless_file *source = user;
    const size_t count = fread(data, 1, (size_t)size, source->file);
    if (count > 0) return (int)count;
    source->is_past_end = 1;
    memset(data, '\n', (size_t)size);
    return size;
}

static void skip_endless(void *user, int size) {
    endless_file *source = user;
    fseek(source->file, size, SEEK_CUR);
}

static int is_past_end(void *user) {
    return ((endless_file *)user)->is_past_end;
}

/* NULL unless the file is whole. */
static float *load_hdr(const char *path) {
    const stbi_io_callbacks callbacks = {read_endless, skip_endless, is_past_end};
    endless_file source = {fopen(path, "rb"), 0};
    if (!source.file) return NULL;
    int width, height, channels;
    float *data = stbi_loadf_from_callbacks(&callbacks, &source, &width, &height, &channels, 3);
    fclose(source.file);
    if (!source.is_past_end) return data;
    stbi_image_free(data);
    return NULL;
}

static lobe_render_result read_stb(const char *path, image *picture) {
    int width, height, channels;
    if (!stbi_info(path, &width, &height, &channels))
        return lobe_fail(
            LOBE_RENDER_BAD_INPUT,
            "%s: not a picture that can be read (%s); use .exr, .hdr, .pfm, .png, .jpg "
            "or .tga",
            path, stbi_failure_reason());
    if ((size_t)width * (size_t)height > LOBE_IMAGE_PIXELS_MAX)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: %d x %d pixels are too many; scale it down",
                         path, width, height);
    float *data = NULL;
    unsigned char *bytes = NULL;
    if (stbi_is_hdr(path))
        data = load_hdr(path);
    else
        bytes = stbi_load(path, &width, &height, &channels, 3);
    if (!data && !bytes)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: cannot be decoded (%s); is it complete?", path,
                         stbi_failure_reason());
    int ok = lobe_image_create(picture, width, height);
    for (size_t i = 0; ok && i < (size_t)width * (size_t)height; i++) {
        float rgb[3];
        for (int c = 0; c < 3; c++)
            rgb[c] = data ? data[3 * i + c] : lobe_srgb_to_linear(bytes[3 * i + c] / 255.0f);
        picture->pixels[i] = v3(rgb[0], rgb[1], rgb[2]);
    }
    stbi_image_free(data);
    stbi_image_free(bytes);
    return ok ? LOBE_RENDER_OK : lobe_fail_memory(path);
}

static size_t repair(image *picture) {
    size_t repaired = 0;
    for (size_t i = 0; i < (size_t)picture->width * (size_t)picture->height; i++) {
        vec3 *p = &picture->pixels[i];
        if (!v3_is_finite(*p) || p->x < 0.0f || p->y < 0.0f || p->z < 0.0f) {
            repaired++;
            p->x = isfinite(p->x) ? fmaxf(p->x, 0.0f) : 0.0f;
            p->y = isfinite(p->y) ? fmaxf(p->y, 0.0f) : 0.0f;
            p->z = isfinite(p->z) ? fmaxf(p->z, 0.0f) : 0.0f;
        }
    }
    return repaired;
}

lobe_render_result lobe_image_decode(const char *path, image *picture) {
    *picture = (image){0, 0, NULL};
    struct stat status;
    if (stat(path, &status) != 0)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: %s; give a picture", path, strerror(errno));
    if (!S_ISREG(status.st_mode))
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: not a regular file; give a picture", path);
    lobe_render_result result;
    if (lobe_path_ends(path, ".exr"))
        result = lobe_image_read_exr(path, picture);
    else if (lobe_path_ends(path, ".pfm"))
        result = lobe_image_read_pfm(path, picture);
    else
        result = read_stb(path, picture);
    if (result != LOBE_RENDER_OK) lobe_image_free(picture);
    return result;
}

lobe_render_result lobe_image_read(const char *path, image *picture, size_t *repaired) {
    const lobe_render_result result = lobe_image_decode(path, picture);
    if (result != LOBE_RENDER_OK) return result;
    const size_t count = repair(picture);
    if (repaired) *repaired = count;
    return LOBE_RENDER_OK;
}
