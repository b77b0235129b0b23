/* Frames into a folder. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "folder.h"
#include "lobe/ssr_picture.h"
#include "message.h"
#include "output.h"

struct lobe_ssr_folder_writer {
    char path[FOLDER_PATH];
    int width, height, count;
    json_t *root, *frames;
    float *mask; /* as floats; NULL: no frame had one */
};

lobe_ssr_result lobe_ssr_folder_begin(const char *path, int width, int height,
                                      lobe_ssr_folder_writer **writer) {
    *writer = NULL;
    lobe_ssr_folder_writer *w = calloc(1, sizeof *w);
    if (!w) return lobe_ssr_fail_memory(path);
    const int length = snprintf(w->path, sizeof w->path, "%s", path);
    w->width = width;
    w->height = height;
    w->frames = json_array();
    w->root = json_pack("{ss si si si}", "format", FOLDER_FORMAT, "version", 1, "width", width,
                        "height", height);
    lobe_ssr_result result = LOBE_SSR_OK;
    if (length < 0 || length >= FOLDER_PATH)
        result = lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: name too long; choose another", path);
    if (!w->frames || !w->root) result = lobe_ssr_fail_memory(path);
    if (result == LOBE_SSR_OK) {
        *writer = w;
        return result;
    }
    json_decref(w->frames);
    json_decref(w->root);
    free(w);
    return result;
}

static json_t *row_of(float a, float b, float c, float d) {
    return json_pack("[f f f f]", (double)a, (double)b, (double)c, (double)d);
}

static json_t *json_of(const lobe_ssr_camera *c) {
    return json_pack("{s[o o o o] s[f f] sf sf}", "to_world",
                     row_of(c->right.x, c->up.x, -c->forward.x, c->eye.x),
                     row_of(c->right.y, c->up.y, -c->forward.y, c->eye.y),
                     row_of(c->right.z, c->up.z, -c->forward.z, c->eye.z),
                     row_of(0.0f, 0.0f, 0.0f, 1.0f), "tan", (double)c->tan_x, (double)c->tan_y,
                     "near", (double)c->near_z, "far", (double)c->far_z);
}

static int add_channels(lobe_ssr_channel *to, const float *values, int stride,
                        const char *const *names) {
    int count = 0;
    for (; values && names[count]; count++)
        to[count] = (lobe_ssr_channel){names[count], values + (stride > 1 ? count : 0), stride};
    return count;
}

static lobe_ssr_result make_mask(lobe_ssr_folder_writer *w, const unsigned char *mask) {
    const size_t count = (size_t)w->width * (size_t)w->height;
    if (!w->mask) w->mask = malloc(count * sizeof *w->mask);
    if (!w->mask) return lobe_ssr_fail_memory(w->path);
    for (size_t i = 0; i < count; i++) w->mask[i] = mask[i] ? 1.0f : 0.0f;
    return LOBE_SSR_OK;
}

static lobe_ssr_result write_picture(lobe_ssr_folder_writer *w, const char *name,
                                     const lobe_ssr_frame *f) {
    static const char *const z[] = {"Z", NULL}, *const normal[] = {"N.X", "N.Y", "N.Z", NULL},
                             *const roughness[] = {"roughness", NULL},
                             *const f0[] = {"f0.R", "f0.G", "f0.B", NULL},
                             *const motion[] = {"motion.X", "motion.Y", NULL},
                             *const color[] = {"previous.R", "previous.G", "previous.B", NULL},
                             *const tangent[] = {"tangent.X", "tangent.Y", "tangent.Z", NULL},
                             *const anisotropy[] = {"anisotropy", NULL},
                             *const mask[] = {"mask", NULL}, *const motion_z[] = {"motion.Z", NULL};
    char path[FOLDER_PATH];
    lobe_ssr_channel channels[19];
    const int has_axis = f->tangent && f->anisotropy;
    int count = 0;
    if (!lobe_ssr_folder_name(path, w->path, name))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: name too long; choose another", w->path);
    if (f->mask && make_mask(w, f->mask) != LOBE_SSR_OK) return LOBE_SSR_FAILED;
    count += add_channels(channels + count, f->z, 1, z);
    count += add_channels(channels + count, f->normal, 3, normal);
    count += add_channels(channels + count, f->roughness, 1, roughness);
    count += add_channels(channels + count, f->f0, 3, f0);
    count += add_channels(channels + count, f->motion, 2, motion);
    count += add_channels(channels + count, f->previous_color, 3, color);
    count += add_channels(channels + count, has_axis ? f->tangent : NULL, 3, tangent);
    count += add_channels(channels + count, has_axis ? f->anisotropy : NULL, 1, anisotropy);
    count += add_channels(channels + count, f->mask ? w->mask : NULL, 1, mask);
    count += add_channels(channels + count, f->motion ? f->motion_z : NULL, 1, motion_z);
    return lobe_ssr_write_exr(path, w->width, w->height, channels, count, NULL);
}

static lobe_ssr_result write_environment(lobe_ssr_folder_writer *w, const lobe_ssr_environment *e) {
    char path[FOLDER_PATH];
    if (!e->rgb) return LOBE_SSR_OK;
    if (!lobe_ssr_folder_name(path, w->path, "environment.exr"))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: name too long; choose another", w->path);
    json_t *object = json_pack("{ss si si si}", "file", "environment.exr", "width", e->width,
                               "height", e->height, "levels", e->levels);
    if (json_object_set_new(w->root, "environment", object) != 0) return lobe_ssr_fail_memory(path);
    const lobe_ssr_channel channels[] = {
        {"R", e->rgb, 3}, {"G", e->rgb + 1, 3}, {"B", e->rgb + 2, 3}};
    return lobe_ssr_write_exr(path, e->width, e->height * e->levels, channels, 3, NULL);
}

lobe_ssr_result lobe_ssr_folder_add(lobe_ssr_folder_writer *w, const lobe_ssr_frame *f) {
    char name[32];
    snprintf(name, sizeof name, "gbuffer-%04d.exr", w->count);
    lobe_ssr_result result = w->count == 0 ? write_environment(w, &f->environment) : LOBE_SSR_OK;
    if (result == LOBE_SSR_OK) result = write_picture(w, name, f);
    if (result != LOBE_SSR_OK) return result;
    json_t *row = json_pack("{ss so so}", "file", name, "camera", json_of(&f->camera),
                            "previous_camera", json_of(&f->previous_camera));
    if (json_array_append_new(w->frames, row) != 0) return lobe_ssr_fail_memory(w->path);
    w->count++;
    return LOBE_SSR_OK;
}

static int write_text(const char *text, size_t size, void *out) {
    lobe_ssr_output_write(out, text, size);
    return 0;
}

static lobe_ssr_result write_json(const lobe_ssr_folder_writer *w) {
    char path[FOLDER_PATH];
    ssr_output out;
    if (json_object_set(w->root, "frames", w->frames) != 0) return lobe_ssr_fail_memory(w->path);
    if (!lobe_ssr_folder_name(path, w->path, "gbuffer.json"))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: name too long; choose another", w->path);
    const lobe_ssr_result result = lobe_ssr_output_open(&out, path);
    if (result != LOBE_SSR_OK) return result;
    /* nine digits name a float */
    const int is_good =
        json_dump_callback(w->root, write_text, &out,
                           JSON_INDENT(1) | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(9)) == 0;
    return lobe_ssr_output_close(&out, is_good);
}

lobe_ssr_result lobe_ssr_folder_finish(lobe_ssr_folder_writer *w) {
    if (!w) return LOBE_SSR_OK;
    const lobe_ssr_result result = w->count ? write_json(w) : LOBE_SSR_OK;
    json_decref(w->frames);
    json_decref(w->root);
    free(w->mask);
    free(w);
    return result;
}
