/* gbuffer.json: sizes, cameras and names of files. */
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "folder.h"
#include "message.h"
#include "pipeline.h"

int lobe_ssr_folder_name(char path[FOLDER_PATH], const char *folder, const char *name) {
    const int length = snprintf(path, FOLDER_PATH, "%s/%s", folder, name);
    return length > 0 && length < FOLDER_PATH;
}

/* Where in the text something is, for messages: "frames[3].camera". */
typedef struct place {
    const lobe_ssr_folder *folder;
    char name[64];
} place;

static lobe_ssr_result refuse(const place *p, const char *what) {
    return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s/gbuffer.json: %s: %s; see docs/gbuffer.md",
                         p->folder->path, p->name, what);
}

static int read_floats(const json_t *array, float *values, size_t count) {
    if (!json_is_array(array) || json_array_size(array) != count) return 0;
    for (size_t i = 0; i < count; i++) {
        const json_t *number = json_array_get(array, i);
        if (!json_is_number(number)) return 0;
        values[i] = (float)json_number_value(number);
    }
    return 1;
}

/* Columns: to the right, up, backward, and the eye, as glTF and Blender have it. */
static int read_matrix(const json_t *rows, lobe_ssr_camera *c) {
    float m[4][4];
    if (!json_is_array(rows) || json_array_size(rows) != 4) return 0;
    for (size_t i = 0; i < 4; i++)
        if (!read_floats(json_array_get(rows, i), m[i], 4)) return 0;
    c->right = (lobe_vec3_f32){m[0][0], m[1][0], m[2][0]};
    c->up = (lobe_vec3_f32){m[0][1], m[1][1], m[2][1]};
    c->forward = (lobe_vec3_f32){-m[0][2], -m[1][2], -m[2][2]};
    c->eye = (lobe_vec3_f32){m[0][3], m[1][3], m[2][3]};
    return m[3][0] == 0.0f && m[3][1] == 0.0f && m[3][2] == 0.0f && m[3][3] == 1.0f;
}

static lobe_ssr_result read_camera(const place *p, const json_t *object, lobe_ssr_camera *c) {
    float tangents[2];
    const json_t *near_z = json_object_get(object, "near"), *far_z = json_object_get(object, "far");
    if (!json_is_object(object)) return refuse(p, "no object with to_world, tan, near and far");
    if (!read_matrix(json_object_get(object, "to_world"), c))
        return refuse(p, "to_world is not 4 rows of 4 numbers, the last 0, 0, 0, 1");
    if (!read_floats(json_object_get(object, "tan"), tangents, 2))
        return refuse(p, "tan is not 2 numbers");
    if (!json_is_number(near_z) || !json_is_number(far_z))
        return refuse(p, "near or far is not a number");
    c->tan_x = tangents[0];
    c->tan_y = tangents[1];
    c->near_z = (float)json_number_value(near_z);
    c->far_z = (float)json_number_value(far_z);
    if (!lobe_ssr_is_camera(c))
        return refuse(p, "to_world does not turn and shift alone, or an angle or a plane is out of "
                         "range");
    return LOBE_SSR_OK;
}

static lobe_ssr_result read_frame(lobe_ssr_folder *f, size_t i, const json_t *object) {
    folder_frame *frame = &f->frames[i];
    place p = {.folder = f};
    snprintf(p.name, sizeof p.name, "frames[%zu]", i);
    frame->file = json_string_value(json_object_get(object, "file"));
    if (!frame->file) return refuse(&p, "it names no file");
    snprintf(p.name, sizeof p.name, "frames[%zu].camera", i);
    lobe_ssr_result result = read_camera(&p, json_object_get(object, "camera"), &frame->camera);
    if (result != LOBE_SSR_OK) return result;
    frame->previous = i > 0 ? f->frames[i - 1].camera : frame->camera;
    const json_t *previous = json_object_get(object, "previous_camera");
    snprintf(p.name, sizeof p.name, "frames[%zu].previous_camera", i);
    return previous ? read_camera(&p, previous, &frame->previous) : LOBE_SSR_OK;
}

/* 0: not a whole number from 1 to `most`. */
static int read_count(const json_t *object, const char *name, int most, int *value) {
    const json_t *number = json_object_get(object, name);
    const json_int_t v = json_integer_value(number);
    if (!json_is_integer(number) || v < 1 || v > most) return 0;
    *value = (int)v;
    return 1;
}

static lobe_ssr_result read_environment(lobe_ssr_folder *f, const json_t *object) {
    const place p = {.folder = f, .name = "environment"};
    lobe_ssr_environment *e = &f->environment;
    if (!object) return LOBE_SSR_OK;
    f->environment_file = json_string_value(json_object_get(object, "file"));
    if (!f->environment_file) return refuse(&p, "it names no file");
    if (!read_count(object, "width", LOBE_SSR_SIZE_MAX, &e->width) ||
        !read_count(object, "height", LOBE_SSR_SIZE_MAX, &e->height) ||
        !read_count(object, "levels", 64, &e->levels) ||
        e->height > LOBE_SSR_SIZE_MAX / e->levels ||
        3.0 * e->width * e->height * e->levels > INT_MAX)
        return refuse(&p, "width, height or levels is missing or out of range");
    return LOBE_SSR_OK;
}

static lobe_ssr_result read_all(lobe_ssr_folder *f, const json_t *root) {
    const char *format = json_string_value(json_object_get(root, "format"));
    const json_t *frames = json_object_get(root, "frames");
    place p = {.folder = f, .name = "format"};
    int version;
    if (!format || strcmp(format, FOLDER_FORMAT) != 0) return refuse(&p, "not " FOLDER_FORMAT);
    snprintf(p.name, sizeof p.name, "version");
    if (!read_count(root, "version", 1, &version)) return refuse(&p, "not 1");
    snprintf(p.name, sizeof p.name, "width, height");
    if (!read_count(root, "width", LOBE_SSR_SIZE_MAX, &f->width) ||
        !read_count(root, "height", LOBE_SSR_SIZE_MAX, &f->height))
        return refuse(&p, "not whole numbers from 1 to 32768");
    snprintf(p.name, sizeof p.name, "frames");
    const size_t count = json_array_size(frames);
    if (count < 1 || count > FOLDER_FRAMES_MAX) return refuse(&p, "not a list of frames");
    f->frames = calloc(count, sizeof *f->frames);
    if (!f->frames) return lobe_ssr_fail_memory(f->path);
    f->count = (int)count;
    for (size_t i = 0; i < count; i++) {
        const lobe_ssr_result result = read_frame(f, i, json_array_get(frames, i));
        if (result != LOBE_SSR_OK) return result;
    }
    return read_environment(f, json_object_get(root, "environment"));
}

lobe_ssr_result lobe_ssr_folder_parse(lobe_ssr_folder *f) {
    char path[FOLDER_PATH];
    if (!lobe_ssr_folder_name(path, f->path, "gbuffer.json"))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: name too long; move the folder", f->path);
    FILE *file = fopen(path, "rb");
    if (!file)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "%s: cannot be read (%s); a folder of frames has one, see "
                             "docs/gbuffer.md",
                             path, strerror(errno));
    json_error_t error;
    json_t *root = json_loadf(file, JSON_REJECT_DUPLICATES, &error);
    fclose(file);
    f->json = root;
    if (!root)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s:%d: %.200s; write it again", path, error.line,
                             error.text);
    return read_all(f, root);
}
