/* tests/render/solids.h: glTF files of spheres, plates and squares of one material, and panoramas. */
#ifndef TESTS_RENDER_SOLIDS_H
#define TESTS_RENDER_SOLIDS_H

#include <lobe/render.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#define SOLID_FILE "render-solid.gltf"
#define SOLID_BINARY "render-solid.bin"
#define SOLID_LIGHT "render-solid.pfm"

enum { SOLID_VERTICES = 131072 };

/* Positions and normals in turn, three vertices a triangle. */
typedef struct solid {
    float values[SOLID_VERTICES][6];
    int count;
} solid;

static inline void solid_triangle(solid *s, const float a[3], const float b[3], const float c[3],
                                  float normals[3][3]) {
    const float *corner[3] = {a, b, c};
    for (int k = 0; k < 3; ++k, ++s->count)
        for (int i = 0; i < 3; ++i) {
            s->values[s->count][i] = corner[k][i];
            s->values[s->count][3 + i] = normals[k][i];
        }
}

/* Corners in turn, counter-clockwise where it faces. */
static inline void solid_square(solid *s, float c[4][3], float x, float y, float z) {
    float normals[3][3] = {{x, y, z}, {x, y, z}, {x, y, z}};
    solid_triangle(s, c[0], c[1], c[2], normals);
    solid_triangle(s, c[0], c[2], c[3], normals);
}

/* Across the line of sight at z, facing the camera (+1) or away. */
static inline void solid_screen(solid *s, float half, float z, int side) {
    float x = (float)side * half;
    float c[4][3] = {{-x, -half, z}, {x, -half, z}, {x, half, z}, {-x, half, z}};
    solid_square(s, c, 0, 0, (float)side);
}

/* Two faces are all that is seen of a wide plate from afar. */
static inline void solid_plate(solid *s, float half, float thickness) {
    solid_screen(s, half, 0, 1);
    solid_screen(s, half, -thickness, -1);
}

static inline void solid_sphere(solid *s, int steps) {
    const double pi = 3.14159265358979323846;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < 2 * steps; ++k) {
            float p[4][3];
            for (int c = 0; c < 4; ++c) {
                double polar = pi * (i + (c == 1 || c == 2)) / steps,
                       turn = pi * (k + c / 2) / steps;
                p[c][0] = (float)(sin(polar) * cos(turn));
                p[c][1] = (float)cos(polar);
                p[c][2] = (float)(-sin(polar) * sin(turn));
            }
            const int first[3] = {0, 1, 2}, second[3] = {0, 2, 3};
            for (int t = 0; t < 2; ++t) {
                const int *order = t ? second : first;
                float normals[3][3];
                for (int c = 0; c < 3; ++c)
                    for (int a = 0; a < 3; ++a) normals[c][a] = p[order[c]][a];
                if ((t == 0 && i == steps - 1) || (t == 1 && i == 0)) continue;
                solid_triangle(s, p[order[0]], p[order[1]], p[order[2]], normals);
            }
        }
}

/* The file, with a camera at (0, 0, distance) that sees so many radians upward. */
static inline void solid_write(const solid *s, const char *material, double distance,
                               double angle) {
    FILE *file = fopen(SOLID_BINARY, "wb");
    assert_non_null(file);
    fwrite(s->values, sizeof s->values[0], (size_t)s->count, file);
    fclose(file);
    file = fopen(SOLID_FILE, "wb");
    assert_non_null(file);
    const size_t size = (size_t)s->count * sizeof s->values[0];
    fprintf(
        file,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
        "\"nodes\":[{\"mesh\":0},{\"camera\":0,\"translation\":[0,0,%.9g]}],"
        "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":%.9g,\"znear\":0.1}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},"
        "\"material\":0}]}],\"materials\":[%s],"
        "\"buffers\":[{\"uri\":\"" SOLID_BINARY "\",\"byteLength\":%zu}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu,\"byteStride\":24}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
        "\"count\":%d,\"min\":[-99,-99,-99],\"max\":[99,99,99]},"
        "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"type\":\"VEC3\","
        "\"count\":%d}]}",
        distance, angle, material, size, size, s->count, s->count);
    fclose(file);
}

/* Light from the side of the camera and from beyond. */
static inline void solid_light(float near, float beyond) {
    enum { WIDTH = 128, HEIGHT = 64 };
    FILE *file = fopen(SOLID_LIGHT, "wb");
    assert_non_null(file);
    fprintf(file, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT);
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) {
            const float value = x < WIDTH / 2 ? beyond : near;
            const float rgb[3] = {value, value, value};
            fwrite(rgb, sizeof rgb, 1, file);
        }
    fclose(file);
}

static inline lobe_scene *solid_load(void) {
    lobe_scene_options options = lobe_scene_default_options();
    options.environment = SOLID_LIGHT;
    options.strict = 1;
    lobe_scene *scene = NULL;
    if (lobe_scene_load(SOLID_FILE, options, &scene) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    return scene;
}

static inline void solid_remove(void) {
    unlink(SOLID_FILE);
    unlink(SOLID_BINARY);
    unlink(SOLID_LIGHT);
}

#endif
