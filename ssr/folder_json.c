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
#include "lobe/camera_path.h"
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

/* One that a frame can be reprojected with. */
static lobe_ssr_result take_camera(const place *p, const lobe_path_camera *from,
                                   lobe_ssr_camera *c) {
    *c = (lobe_ssr_camera){
        .eye = from->view.position,
        .right = from->right,
        .up = from->up,
        .forward = {-from->backward.x, -from->backward.y, -from->backward.z},
        .tan_x = from->tan_x,
        .tan_y = from->tan_y,
        .near_z = from->near_z,
        .far_z = from->far_z,
    };
    if (from->tan_x == 0.0f) return refuse(p, "no to_world and tan");
    if (!lobe_ssr_is_camera(c)) return refuse(p, "near or far is missing or out of range");
    return LOBE_SSR_OK;
}

static lobe_ssr_result take_cameras(lobe_ssr_folder *f, const lobe_camera_path *cameras) {
    place p = {.folder = f};
    lobe_ssr_result result = LOBE_SSR_OK;
    for (int i = 0; i < f->count && result == LOBE_SSR_OK; i++) {
        const lobe_path_frame *frame = lobe_camera_path_get(cameras, i);
        snprintf(p.name, sizeof p.name, "frames[%d].camera", i);
        if (!frame) return refuse(&p, "not there any more");
        result = take_camera(&p, &frame->camera, &f->frames[i].camera);
        snprintf(p.name, sizeof p.name, "frames[%d].previous_camera", i);
        if (result == LOBE_SSR_OK)
            result = take_camera(&p, &frame->previous, &f->frames[i].previous);
    }
    return result;
}

static lobe_ssr_result read_cameras(lobe_ssr_folder *f, const char *file) {
    lobe_camera_path *cameras;
    const lobe_render_result read = lobe_camera_path_read(file, &cameras);
    if (read != LOBE_RENDER_OK)
        return lobe_ssr_fail(read == LOBE_RENDER_BAD_INPUT ? LOBE_SSR_BAD_INPUT : LOBE_SSR_FAILED,
                             "%s", lobe_render_error_message());
    const lobe_ssr_result result = take_cameras(f, cameras);
    lobe_camera_path_free(cameras);
    return result;
}

static lobe_ssr_result read_frame(lobe_ssr_folder *f, size_t i, const json_t *object) {
    place p = {.folder = f};
    snprintf(p.name, sizeof p.name, "frames[%zu]", i);
    f->frames[i].file = json_string_value(json_object_get(object, "file"));
    return f->frames[i].file ? LOBE_SSR_OK : refuse(&p, "it names no file");
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

static lobe_ssr_result read_all(lobe_ssr_folder *f, const char *file, const json_t *root) {
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
    const lobe_ssr_result result = read_cameras(f, file);
    if (result != LOBE_SSR_OK) return result;
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
    return read_all(f, path, root);
}
