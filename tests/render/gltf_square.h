/* tests/render/gltf_square.h: small .glb files, all of one square of side 2 that faces +Z, its arrays in
 * every form that glTF knows. A camera stands at z = 4 and sees 0.81 to each side. */
#ifndef TESTS_RENDER_GLTF_SQUARE_H
#define TESTS_RENDER_GLTF_SQUARE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 2 x 2 texels: red, green above blue, white; the left ones have no alpha, the right ones all of it. */
#define TGA_HEADER 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 32, 0x28
#define TGA_TEXELS 0, 0, 255, 0, 0, 255, 0, 255, 255, 0, 0, 0, 255, 255, 255, 255

static const struct square_arrays {
    float positions[12], normals[12], uv[8], flipped_uv[8];
    int16_t short_positions[16];
    uint16_t short_uv[8];
    int8_t byte_normals[16];
    uint8_t byte_colors[16];
    uint16_t list[6], sparse_places[4];
    uint32_t fan[4];
    uint8_t strip[4];
    uint8_t picture[36], tilt[36];
    uint8_t draco[164];
} square_arrays = {
    {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0},
    {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1},
    {0, 1, 1, 1, 1, 0, 0, 0},
    {0, 0, 1, 0, 1, 1, 0, 1},
    {-32767, -32767, 0, 99, 32767, -32767, 0, 99, 32767, 32767, 0, 99, -32767, 32767, 0, 99},
    {0, 65535, 65535, 65535, 65535, 0, 0, 0},
    {0, 0, 127, 99, 0, 0, 127, 99, 0, 0, 127, 99, 0, 0, 127, 99},
    {255, 51, 0, 255, 255, 51, 0, 255, 255, 51, 0, 255, 255, 51, 0, 255},
    {0, 1, 2, 0, 2, 3},
    {0, 1, 2, 3},
    {0, 1, 2, 3},
    {0, 1, 3, 2},
    {TGA_HEADER, TGA_TEXELS},
    {TGA_HEADER, 200, 200, 200, 255, 200, 200, 200, 255, 200, 200, 200, 255, 200, 200, 200, 255},
    /* by libdraco 1.5.5: positions, normals, texture coordinates of 11, 8, 10 bits */
    {68, 82,  65,  67,  79,  2,  2,   1,   1,   0,   0,   0,   4,  2, 2,   2,   0,   0,   1,
     31, 255, 1,   17,  255, 1,  17,  255, 1,   17,  3,   255, 0,  0, 0,   0,   0,   1,   0,
     0,  1,   0,   9,   3,   0,  0,   2,   1,   1,   9,   3,   0,  1, 3,   1,   3,   9,   2,
     0,  2,   2,   1,   1,   1,  0,   3,   3,   1,   48,  1,   16, 3, 0,   40,  130, 152, 0,
     0,  0,   0,   0,   255, 7,  0,   0,   0,   0,   128, 191, 0,  0, 128, 191, 0,   0,   0,
     0,  0,   0,   0,   64,  11, 0,   3,   1,   1,   1,   128, 1,  1, 56,  255, 247, 1,   8,
     3,  0,   152, 132, 255, 0,  0,   0,   127, 0,   0,   0,   8,  1, 1,   1,   0,   3,   3,
     1,  32,  1,   32,  3,   0,  240, 131, 166, 0,   0,   0,   0,  0, 255, 3,   0,   0,   0,
     0,  0,   0,   0,   0,   0,  0,   0,   0,   128, 63,  10}};

enum {
    POSITIONS,
    NORMALS,
    UV,
    FLIPPED_UV,
    SHORT_POSITIONS,
    SHORT_UV,
    BYTE_NORMALS,
    BYTE_COLORS,
    LIST,
    FAN,
    STRIP,
    SPARSE_POSITIONS,
    ACCESSORS
};

enum { PICTURE_VIEW = 12, TILT_VIEW, DRACO_VIEW, VIEWS };

/* Pieces of the JSON that differ; NULL: what stands beside. */
typedef struct square_file {
    const char *attributes; /* positions, normals and UV */
    const char *primitive;  /* more of it: indices by LIST */
    const char *material;   /* unlit white */
    const char *nodes;      /* from node 1 on: one of mesh 0; node 0 has the camera */
    const char *children;   /* of the scene: 0, 1 */
    const char *views;      /* after those of the arrays, with a comma before; and so the others: */
    const char *min_filter; /* of the first sampler; none */
    const char *meshes, *textures, *images, *accessors, *buffers, *more;
    const void *binary; /* after the arrays */
    size_t binary_size;
} square_file;

enum { SQUARE_JSON_MAX = 16384 };

static inline const char *piece(const char *given, const char *usual) {
    return given ? given : usual;
}

static inline size_t print_view(char *to, size_t room, size_t offset, size_t size, int stride) {
    char text[40] = "";
    if (stride) snprintf(text, sizeof text, ",\"byteStride\":%d", stride);
    return (size_t)snprintf(to, room, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu%s}",
                            offset ? "," : "", offset, size, text);
}

static inline void print_views(char *to, size_t room) {
#define VIEW(member, stride)                                                                       \
    n += print_view(to + n, room - n, offsetof(struct square_arrays, member),                      \
                    sizeof square_arrays.member, stride)
    size_t n = 0;
    VIEW(positions, 0);
    VIEW(normals, 0);
    VIEW(uv, 0);
    VIEW(flipped_uv, 0);
    VIEW(short_positions, 8);
    VIEW(short_uv, 4);
    VIEW(byte_normals, 4);
    VIEW(byte_colors, 0);
    VIEW(list, 0);
    VIEW(sparse_places, 0);
    VIEW(fan, 0);
    VIEW(strip, 0);
    VIEW(picture, 0);
    VIEW(tilt, 0);
    VIEW(draco, 0);
#undef VIEW
}

static const char square_accessors[] =
    "{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":4},"
    "{\"bufferView\":1,\"componentType\":5126,\"type\":\"VEC3\",\"count\":4},"
    "{\"bufferView\":2,\"componentType\":5126,\"type\":\"VEC2\",\"count\":4},"
    "{\"bufferView\":3,\"componentType\":5126,\"type\":\"VEC2\",\"count\":4},"
    "{\"bufferView\":4,\"componentType\":5122,\"normalized\":true,\"type\":\"VEC3\",\"count\":4},"
    "{\"bufferView\":5,\"componentType\":5123,\"normalized\":true,\"type\":\"VEC2\",\"count\":4},"
    "{\"bufferView\":6,\"componentType\":5120,\"normalized\":true,\"type\":\"VEC3\",\"count\":4},"
    "{\"bufferView\":7,\"componentType\":5121,\"normalized\":true,\"type\":\"VEC4\",\"count\":4},"
    "{\"bufferView\":8,\"componentType\":5123,\"type\":\"SCALAR\",\"count\":6},"
    "{\"bufferView\":10,\"componentType\":5125,\"type\":\"SCALAR\",\"count\":4},"
    "{\"bufferView\":11,\"componentType\":5121,\"type\":\"SCALAR\",\"count\":4},"
    "{\"componentType\":5126,\"type\":\"VEC3\",\"count\":4,\"sparse\":{\"count\":4,\"indices\":{"
    "\"bufferView\":9,\"componentType\":5123},\"values\":{\"bufferView\":0}}}";

/* Length of the JSON. */
static inline size_t print_square(const square_file *f, char *json) {
    char views[3000];
    print_views(views, sizeof views);
    const int n = snprintf(
        json, SQUARE_JSON_MAX,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[%s]}],"
        "\"nodes\":[{\"camera\":0,\"name\":\"eye\",\"translation\":[0,0,4]},%s],"
        "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.4,\"znear\":0.1}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{%s},\"material\":0%s}]}%s],"
        "\"materials\":[%s],"
        "\"textures\":[{\"source\":0,\"sampler\":1},{\"source\":1},{\"source\":0,\"sampler\":0}%s],"
        "\"samplers\":[{\"wrapS\":33071,\"wrapT\":33648,\"magFilter\":9728%s},"
        "{\"magFilter\":9728},{\"wrapS\":33071,\"wrapT\":33071}],"
        "\"images\":[{\"bufferView\":12,\"mimeType\":\"image/png\"},"
        "{\"bufferView\":13,\"mimeType\":\"image/png\"}%s],"
        "\"bufferViews\":[%s%s],\"accessors\":[%s%s],\"buffers\":[{\"byteLength\":%zu}%s]%s}",
        piece(f->children, "0,1"), piece(f->nodes, "{\"mesh\":0}"),
        piece(f->attributes, "\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2"),
        piece(f->primitive, ",\"indices\":8"), piece(f->meshes, ""),
        piece(f->material, "{\"extensions\":{\"KHR_materials_unlit\":{}}}"), piece(f->textures, ""),
        piece(f->min_filter, ""), piece(f->images, ""), views, piece(f->views, ""),
        square_accessors, piece(f->accessors, ""), sizeof square_arrays + f->binary_size,
        piece(f->buffers, ""), piece(f->more, ""));
    if (n >= SQUARE_JSON_MAX) abort();
    return (size_t)n;
}

static inline void put_word(unsigned char *to, size_t word) {
    for (int i = 0; i < 4; ++i) to[i] = (unsigned char)(word >> 8 * i);
}

/* The whole .glb, by malloc. */
static inline unsigned char *make_square(const square_file *f, size_t *size) {
    char json[SQUARE_JSON_MAX];
    const size_t length = print_square(f, json), text = (length + 3) & ~(size_t)3;
    const size_t binary = (sizeof square_arrays + f->binary_size + 3) & ~(size_t)3;
    *size = 28 + text + binary;
    unsigned char *glb = calloc(1, *size);
    if (!glb) abort();
    memcpy(glb, "glTF", 4);
    put_word(glb + 4, 2);
    put_word(glb + 8, *size);
    put_word(glb + 12, text);
    memcpy(glb + 16, "JSON", 4);
    memset(glb + 20, ' ', text);
    memcpy(glb + 20, json, length);
    put_word(glb + 20 + text, binary);
    memcpy(glb + 24 + text, "BIN", 4);
    memcpy(glb + 28 + text, &square_arrays, sizeof square_arrays);
    if (f->binary_size) memcpy(glb + 28 + text + sizeof square_arrays, f->binary, f->binary_size);
    return glb;
}

static inline void write_bytes(const char *path, const void *data, size_t size) {
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file) != 0) abort();
}

static inline void write_square_file(const char *path, square_file f) {
    size_t size;
    unsigned char *glb = make_square(&f, &size);
    write_bytes(path, glb, size);
    free(glb);
}

#endif
