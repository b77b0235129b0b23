#include <math.h>
#include <stdlib.h>

#include <stb/stb_image_write.h>

#include "lobe/ssr_picture.h"
#include "message.h"
#include "output.h"
#include "screen.h"

static void write_bytes(void *user, void *data, int size) {
    lobe_ssr_output_write(user, data, (size_t)size);
}

static unsigned char code_of(float linear) {
    const float c = fminf(fmaxf(linear, 0.0f), 1.0f);
    const float s = c <= 0.0031308f ? 12.92f * c : 1.055f * powf(c, 1.0f / 2.4f) - 0.055f;
    return (unsigned char)(255.0f * s + 0.5f);
}

unsigned char *lobe_ssr_screen_bytes(int width, int height, const float *rgb, int stride) {
    const size_t count = (size_t)width * (size_t)height;
    unsigned char *bytes = malloc(3 * count);
    for (size_t i = 0; bytes && i < count; i++)
        for (size_t k = 0; k < 3; k++) bytes[3 * i + k] = code_of(rgb[i * (size_t)stride + k]);
    return bytes;
}

lobe_ssr_result lobe_ssr_write_png(const char *path, int width, int height, const float *rgb,
                                   int stride) {
    unsigned char *bytes = lobe_ssr_screen_bytes(width, height, rgb, stride);
    if (!bytes) return lobe_ssr_fail_memory(path);
    ssr_output out;
    lobe_ssr_result result = lobe_ssr_output_open(&out, path);
    if (result == LOBE_SSR_OK) {
        const int encoded =
            stbi_write_png_to_func(write_bytes, &out, width, height, 3, bytes, 3 * width);
        result = lobe_ssr_output_close(&out, encoded);
    }
    free(bytes);
    return result;
}
