/* Cameras of frames out of JSON. */
#include "lobe/camera_path.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "message.h"
#include "vector.h"

struct lobe_camera_path {
    lobe_path_frame *frames;
    int count;
};

/* Where in the text something is, for messages. */
typedef struct place {
    const char *file;
    char name[64]; /* "frames[3].camera" */
} place;

static lobe_render_result refuse(const place *p, const char *what) {
    return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: %s: %s; see docs/camera.md", p->file, p->name,
                     what);
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

/* 1 too where there is none. */
static int read_float(const json_t *object, const char *name, float *value) {
    const json_t *number = json_object_get(object, name);
    if (json_is_number(number)) *value = (float)json_number_value(number);
    return !number || json_is_number(number);
}

static int read_vector(const json_t *object, const char *name, vec3 *v) {
    float values[3];
    if (!read_floats(json_object_get(object, name), values, 3)) return 0;
    *v = v3(values[0], values[1], values[2]);
    return v3_is_finite(*v);
}

/* ---- A matrix -------------------------------------------------------------------------------- */

/* Columns: to the right, up, backward, and the eye, as glTF and Blender have it. */
static int read_matrix(const json_t *rows, lobe_path_camera *c) {
    float m[4][4];
    if (!json_is_array(rows) || json_array_size(rows) != 4) return 0;
    for (size_t i = 0; i < 4; i++)
        if (!read_floats(json_array_get(rows, i), m[i], 4)) return 0;
    c->right = v3(m[0][0], m[1][0], m[2][0]);
    c->up = v3(m[0][1], m[1][1], m[2][1]);
    c->backward = v3(m[0][2], m[1][2], m[2][2]);
    c->view.position = v3(m[0][3], m[1][3], m[2][3]);
    return m[3][0] == 0.0f && m[3][1] == 0.0f && m[3][2] == 0.0f && m[3][3] == 1.0f;
}

static int is_direction(vec3 d) {
    const float squared = v3_dot(d, d);
    return squared > 0.98f && squared < 1.02f;
}

static int is_across(vec3 a, vec3 b) {
    return fabsf(v3_dot(a, b)) < 0.01f;
}

/* A mirrored matrix would turn the picture over. */
static int is_upright(const lobe_path_camera *c) {
    return v3_is_finite(c->view.position) && is_direction(c->right) && is_direction(c->up) &&
           is_direction(c->backward) && is_across(c->right, c->up) &&
           is_across(c->up, c->backward) && is_across(c->backward, c->right) &&
           v3_dot(v3_cross(c->right, c->up), c->backward) > 0.0f;
}

static int is_slope(float slope) {
    return slope > 0.0f && slope < 1e6f;
}

static lobe_render_result read_pose(const place *p, const json_t *object, lobe_path_camera *c) {
    float slopes[2];
    if (!read_matrix(json_object_get(object, "to_world"), c))
        return refuse(p, "to_world is not 4 rows of 4 numbers, the last 0, 0, 0, 1");
    if (!read_floats(json_object_get(object, "tan"), slopes, 2))
        return refuse(p, "tan is not 2 numbers");
    if (!is_upright(c) || !is_slope(slopes[0]) || !is_slope(slopes[1]))
        return refuse(p, "to_world does not turn and shift alone, or an angle is out of range");
    c->tan_x = slopes[0];
    c->tan_y = slopes[1];
    /* far enough ahead that the sum keeps the direction */
    const float ahead = 1.0f + v3_length(c->view.position);
    c->view.target = v3_sub(c->view.position, v3_scale(c->backward, ahead));
    c->view.up = c->up;
    c->view.vertical_degrees = 2.0f * atanf(c->tan_y) * (180.0f / LOBE_PI);
    return LOBE_RENDER_OK;
}

/* ---- A place to look at ---------------------------------------------------------------------- */

static lobe_render_result read_look(const place *p, const json_t *object, lobe_path_camera *c) {
    lobe_view *v = &c->view;
    v->up = v3(0.0f, 1.0f, 0.0f);
    if (!read_vector(object, "position", &v->position))
        return refuse(p, "neither to_world nor position, 3 numbers");
    if (!read_vector(object, "target", &v->target)) return refuse(p, "target is not 3 numbers");
    if (json_object_get(object, "up") && !read_vector(object, "up", &v->up))
        return refuse(p, "up is not 3 numbers");
    if (!json_object_get(object, "degrees") || !read_float(object, "degrees", &v->vertical_degrees))
        return refuse(p, "degrees, the vertical angle of view, is not a number");
    if (!(v->vertical_degrees >= 0.01f && v->vertical_degrees <= 179.0f))
        return refuse(p, "degrees is not within 0.01 to 179");
    const vec3 to = v3_sub(v->target, v->position), none = v3_all(0.0f);
    const vec3 right = v3_cross(v3_normalize_or(to, none), v3_normalize_or(v->up, none));
    if (!(v3_dot(right, right) > 1e-10f))
        return refuse(p, "it has no direction: target is at position, or up lies along the view");
    return LOBE_RENDER_OK;
}

/* ---- All of them ----------------------------------------------------------------------------- */

static lobe_render_result read_camera(const place *p, const json_t *object, lobe_path_camera *c) {
    if (!json_is_object(object)) return refuse(p, "no object");
    if (!read_float(object, "near", &c->near_z) || !read_float(object, "far", &c->far_z))
        return refuse(p, "near or far is not a number");
    if (!read_float(object, "focus", &c->focus)) return refuse(p, "focus is not a number");
    if (json_object_get(object, "focus") && !(c->focus >= 1e-15f && c->focus <= 1e15f))
        return refuse(p, "focus is not within 1e-15 to 1e15");
    return json_object_get(object, "to_world") ? read_pose(p, object, c) : read_look(p, object, c);
}

static lobe_render_result read_frame(lobe_camera_path *path, const char *file, size_t i,
                                     const json_t *object) {
    lobe_path_frame *frame = &path->frames[i];
    place p = {.file = file};
    snprintf(p.name, sizeof p.name, "frames[%zu].camera", i);
    lobe_render_result result = read_camera(&p, json_object_get(object, "camera"), &frame->camera);
    if (result != LOBE_RENDER_OK) return result;
    const json_t *previous = json_object_get(object, "previous_camera");
    snprintf(p.name, sizeof p.name, "frames[%zu].previous_camera", i);
    if (previous) return read_camera(&p, previous, &frame->previous);
    frame->previous = i > 0 ? path->frames[i - 1].camera : frame->camera;
    return LOBE_RENDER_OK;
}

static lobe_render_result read_frames(lobe_camera_path *path, const char *file,
                                      const json_t *root) {
    const json_t *frames = json_object_get(root, "frames");
    const place p = {.file = file, .name = "frames"};
    const size_t count = json_array_size(frames);
    if (count < 1 || count > LOBE_CAMERA_PATH_FRAMES_MAX)
        return refuse(&p, "not a list of 1 to 1000000 frames");
    path->frames = calloc(count, sizeof *path->frames);
    if (!path->frames) return lobe_fail_memory(file);
    path->count = (int)count;
    lobe_render_result result = LOBE_RENDER_OK;
    for (size_t i = 0; i < count && result == LOBE_RENDER_OK; i++)
        result = read_frame(path, file, i, json_array_get(frames, i));
    return result;
}

static lobe_render_result load(const char *name, json_t **root) {
    json_error_t error;
    FILE *file = fopen(name, "rb");
    if (!file)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: cannot be read (%s); give a file of cameras",
                         name, strerror(errno));
    *root = json_loadf(file, JSON_REJECT_DUPLICATES, &error);
    fclose(file);
    if (*root) return LOBE_RENDER_OK;
    return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s:%d: %.200s; see docs/camera.md", name, error.line,
                     error.text);
}

lobe_render_result lobe_camera_path_read(const char *file, lobe_camera_path **path) {
    json_t *root = NULL;
    *path = NULL;
    lobe_render_result result = load(file, &root);
    if (result != LOBE_RENDER_OK) return result;
    lobe_camera_path *made = calloc(1, sizeof *made);
    result = made ? read_frames(made, file, root) : lobe_fail_memory(file);
    json_decref(root);
    if (result == LOBE_RENDER_OK)
        *path = made;
    else
        lobe_camera_path_free(made);
    return result;
}

void lobe_camera_path_free(lobe_camera_path *path) {
    if (!path) return;
    free(path->frames);
    free(path);
}

int lobe_camera_path_count(const lobe_camera_path *path) {
    return path->count;
}

const lobe_path_frame *lobe_camera_path_get(const lobe_camera_path *path, int index) {
    return index >= 0 && index < path->count ? &path->frames[index] : NULL;
}
