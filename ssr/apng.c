/* Animated PNG: the first frame's chunks are an ordinary picture; the data of the others goes into chunks of
 * their own, with their number before it. Encoded by stb, one picture at a time. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <stb/stb_image_write.h>

#include "lobe/ssr_picture.h"
#include "message.h"
#include "output.h"
#include "screen.h"

struct lobe_ssr_animation {
    ssr_output out;
    char path[4096];
    int width, height, milliseconds;
    uint32_t frames, chunks; /* numbered together: controls and data */
};

static uint32_t crc_of(uint32_t crc, const unsigned char *bytes, size_t size) {
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (crc & 1u ? 0xedb88320u : 0u);
    }
    return crc;
}

static void put32(unsigned char *to, uint32_t value) {
    for (int k = 0; k < 4; k++) to[k] = (unsigned char)(value >> (24 - 8 * k));
}

static uint32_t get32(const unsigned char *from) {
    return (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 | from[3];
}

/* A chunk whose data has two parts; the second may be empty. */
static void write_chunk(ssr_output *out, const char *name, const unsigned char *first,
                        uint32_t first_size, const unsigned char *second, uint32_t second_size) {
    unsigned char head[8], tail[4];
    put32(head, first_size + second_size);
    memcpy(head + 4, name, 4);
    uint32_t crc = crc_of(0xffffffffu, head + 4, 4);
    crc = crc_of(crc_of(crc, first, first_size), second, second_size);
    put32(tail, ~crc);
    lobe_ssr_output_write(out, head, sizeof head);
    lobe_ssr_output_write(out, first, first_size);
    lobe_ssr_output_write(out, second, second_size);
    lobe_ssr_output_write(out, tail, sizeof tail);
}

/* How many frames there are; 0 plays: without end. */
static void write_control(lobe_ssr_animation *a) {
    unsigned char data[8];
    put32(data, a->frames);
    put32(data + 4, 0);
    write_chunk(&a->out, "acTL", data, sizeof data, data, 0);
}

static void write_frame_control(lobe_ssr_animation *a) {
    unsigned char data[26] = {0};
    put32(data, a->chunks++);
    put32(data + 4, (uint32_t)a->width);
    put32(data + 8, (uint32_t)a->height);
    data[20] = (unsigned char)(a->milliseconds >> 8);
    data[21] = (unsigned char)a->milliseconds;
    data[22] = 1000 >> 8;
    data[23] = 1000 & 255;
    write_chunk(&a->out, "fcTL", data, sizeof data, data, 0);
}

enum { SIGNATURE = 8, HEADER_END = SIGNATURE + 25 };

/* The chunks of one picture; the header of the first only. */
static void write_picture(lobe_ssr_animation *a, const unsigned char *png, size_t size) {
    if (a->frames == 0) {
        lobe_ssr_output_write(&a->out, png, HEADER_END);
        write_control(a);
    }
    write_frame_control(a);
    for (size_t at = HEADER_END; at + 12 <= size;) {
        const uint32_t length = get32(png + at);
        unsigned char number[4];
        if (memcmp(png + at + 4, "IDAT", 4) == 0) {
            put32(number, a->chunks);
            if (a->frames == 0)
                lobe_ssr_output_write(&a->out, png + at, length + 12);
            else
                write_chunk(&a->out, "fdAT", number, 4, png + at + 8, length);
            a->chunks += a->frames > 0;
        }
        at += length + 12;
    }
    a->frames++;
}

/* stb gives the whole file at once. */
static void take_picture(void *animation, void *png, int size) {
    write_picture(animation, png, (size_t)size);
}

lobe_ssr_result lobe_ssr_animation_begin(const char *path, int width, int height, int milliseconds,
                                         lobe_ssr_animation **animation) {
    *animation = NULL;
    lobe_ssr_animation *a = calloc(1, sizeof *a);
    if (!a) return lobe_ssr_fail_memory(path);
    *a = (lobe_ssr_animation){.width = width, .height = height, .milliseconds = milliseconds};
    snprintf(a->path, sizeof a->path, "%s", path);
    const lobe_ssr_result result = lobe_ssr_output_open(&a->out, a->path);
    if (result == LOBE_SSR_OK)
        *animation = a;
    else
        free(a);
    return result;
}

lobe_ssr_result lobe_ssr_animation_add(lobe_ssr_animation *a, const float *rgb, int stride) {
    unsigned char *bytes = lobe_ssr_screen_bytes(a->width, a->height, rgb, stride);
    const int is_good = bytes && stbi_write_png_to_func(take_picture, a, a->width, a->height, 3,
                                                        bytes, 3 * a->width);
    free(bytes);
    return is_good ? LOBE_SSR_OK : lobe_ssr_fail_memory(a->path);
}

lobe_ssr_result lobe_ssr_animation_finish(lobe_ssr_animation *a) {
    static const unsigned char nothing = 0;
    if (!a) return LOBE_SSR_OK;
    write_chunk(&a->out, "IEND", &nothing, 0, &nothing, 0);
    /* the number of frames is known now */
    if (fseeko(a->out.file, HEADER_END, SEEK_SET) == 0) write_control(a);
    const lobe_ssr_result result = lobe_ssr_output_close(&a->out, a->frames > 0);
    free(a);
    return result;
}
