/* Frames out of a folder. */
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "exr_read.h"
#include "folder.h"
#include "frames.h"
#include "message.h"

/* ---- Opening --------------------------------------------------------------------------------- */

static v3 panorama(const void *environment, v3 direction) {
    return lobe_ssr_environment_at(environment, direction, 0.0f);
}

/* Levels lie below one another. One level alone is a panorama, which is filtered here. */
static lobe_ssr_result read_light(lobe_ssr_folder *f) {
    lobe_ssr_environment *e = &f->environment;
    char path[FOLDER_PATH];
    if (!f->environment_file) return LOBE_SSR_OK;
    if (!lobe_ssr_folder_name(path, f->path, f->environment_file))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: a name is too long; shorten it", f->path);
    const int height = e->height * e->levels;
    f->light = malloc(3 * (size_t)e->width * (size_t)height * sizeof *f->light);
    if (!f->light) return lobe_ssr_fail_memory(path);
    ssr_wanted wanted[] = {
        {"R", f->light, 3, 1, 0}, {"G", f->light + 1, 3, 1, 0}, {"B", f->light + 2, 3, 1, 0}};
    const lobe_ssr_result result = lobe_ssr_read_channels(path, e->width, height, wanted, 3, NULL);
    if (result != LOBE_SSR_OK) return result;
    e->rgb = f->light;
    if (e->levels > 1) return LOBE_SSR_OK;
    float *filtered = lobe_ssr_prefilter(panorama, e, omp_get_max_threads());
    if (!filtered) return lobe_ssr_fail_memory(path);
    free(f->light);
    f->light = filtered;
    *e =
        (lobe_ssr_environment){ENVIRONMENT_WIDTH, ENVIRONMENT_HEIGHT, ENVIRONMENT_LEVELS, filtered};
    return LOBE_SSR_OK;
}

static int make_pictures(lobe_ssr_folder *f) {
    const size_t count = (size_t)f->width * (size_t)f->height;
    f->z = malloc(count * sizeof *f->z);
    f->normal = malloc(3 * count * sizeof *f->normal);
    f->roughness = malloc(count * sizeof *f->roughness);
    f->f0 = malloc(3 * count * sizeof *f->f0);
    f->motion = malloc(2 * count * sizeof *f->motion);
    f->motion_z = malloc(count * sizeof *f->motion_z);
    f->color = malloc(3 * count * sizeof *f->color);
    f->tangent = malloc(3 * count * sizeof *f->tangent);
    f->anisotropy = malloc(count * sizeof *f->anisotropy);
    f->mask_values = malloc(count * sizeof *f->mask_values);
    f->mask = malloc(count);
    return f->z && f->normal && f->roughness && f->f0 && f->motion && f->motion_z && f->color &&
           f->tangent && f->anisotropy && f->mask_values && f->mask;
}

lobe_ssr_result lobe_ssr_folder_open(const char *path, lobe_ssr_folder **folder) {
    *folder = NULL;
    lobe_ssr_folder *f = calloc(1, sizeof *f);
    if (!f) return lobe_ssr_fail_memory(path);
    const int length = snprintf(f->path, sizeof f->path, "%s", path);
    lobe_ssr_result result = LOBE_SSR_OK;
    if (length < 0 || length >= FOLDER_PATH)
        result = lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: name too long; move the folder", path);
    if (result == LOBE_SSR_OK) result = lobe_ssr_folder_parse(f);
    if (result == LOBE_SSR_OK) result = read_light(f);
    if (result == LOBE_SSR_OK && !make_pictures(f)) result = lobe_ssr_fail_memory(path);
    if (result != LOBE_SSR_OK) {
        lobe_ssr_folder_free(f);
        return result;
    }
    *folder = f;
    return LOBE_SSR_OK;
}

void lobe_ssr_folder_free(lobe_ssr_folder *f) {
    if (!f) return;
    json_decref(f->json);
    free(f->frames);
    free(f->light);
    free(f->z);
    free(f->normal);
    free(f->roughness);
    free(f->f0);
    free(f->motion);
    free(f->motion_z);
    free(f->color);
    free(f->tangent);
    free(f->anisotropy);
    free(f->mask_values);
    free(f->mask);
    free(f);
}

int lobe_ssr_folder_width(const lobe_ssr_folder *f) {
    return f->width;
}

int lobe_ssr_folder_height(const lobe_ssr_folder *f) {
    return f->height;
}

int lobe_ssr_folder_count(const lobe_ssr_folder *f) {
    return f->count;
}

/* ---- Frames ---------------------------------------------------------------------------------- */

/* Whether all of a group of channels are there; some of them are a mistake: -1. */
static int has_all(const ssr_wanted *group, int count) {
    int found = 0;
    for (int i = 0; i < count; i++) found += group[i].is_there;
    return found == count ? 1 : found ? -1 : 0;
}

/* Of a scene in which nothing moves but the camera. */
static void motion_of_camera(lobe_ssr_folder *f) {
    const ssr_camera now = lobe_ssr_camera_of(&f->frame.camera, (float)f->width, (float)f->height);
    const ssr_camera before =
        lobe_ssr_camera_of(&f->frame.previous_camera, (float)f->width, (float)f->height);
#pragma omp parallel for
    for (int y = 0; y < f->height; y++)
        for (int x = 0; x < f->width; x++) {
            const size_t i = (size_t)y * (size_t)f->width + (size_t)x;
            const float z = lobe_ssr_z_at(&f->frame, i);
            const v3 view = ssr_view_vector(now, (float)x + 0.5f, (float)y + 0.5f,
                                            z > 0.0f ? z : 1e6f * now.near_z);
            lobe_ssr_motion_of(&now, &before, x, y, v3_add(now.eye, view), f->motion + 2 * i);
        }
}

/* The colour of the frame before: in this frame's file, or the frame before's own colour. */
static lobe_ssr_result read_previous(lobe_ssr_folder *f, int index) {
    char path[FOLDER_PATH];
    const char *file = f->frames[index > 0 ? index - 1 : 0].file;
    ssr_wanted own[] = {
        {"R", f->color, 3, 1, 0}, {"G", f->color + 1, 3, 1, 0}, {"B", f->color + 2, 3, 1, 0}};
    if (!lobe_ssr_folder_name(path, f->path, file))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: a name is too long; shorten it", f->path);
    return lobe_ssr_read_channels(path, f->width, f->height, own, 3, NULL);
}

enum {
    FIRST_F0 = 5,
    FIRST_MOTION = 8,
    FIRST_COLOR = 10,
    FIRST_AXIS = 13,
    MASK = 17,
    MOTION_Z,
    CHANNELS
};

static lobe_ssr_result check_groups(const char *path, const ssr_wanted *w) {
    const int groups[][2] = {{FIRST_F0, 3}, {FIRST_MOTION, 2}, {FIRST_COLOR, 3}, {FIRST_AXIS, 4}};
    for (size_t g = 0; g < sizeof groups / sizeof *groups; g++)
        if (has_all(w + groups[g][0], groups[g][1]) < 0)
            return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                                 "%s: channels beside %s are missing; see docs/gbuffer.md", path,
                                 w[groups[g][0]].name);
    return LOBE_SSR_OK;
}

/* What the file holds, and what stands for the rest. */
static lobe_ssr_result use_channels(lobe_ssr_folder *f, int index, const ssr_wanted *w) {
    lobe_ssr_frame *frame = &f->frame;
    const size_t count = (size_t)f->width * (size_t)f->height;
    frame->f0 = w[FIRST_F0].is_there ? f->f0 : NULL;
    frame->tangent = w[FIRST_AXIS].is_there ? f->tangent : NULL;
    frame->anisotropy = w[FIRST_AXIS].is_there ? f->anisotropy : NULL;
    /* without the rest it would be of a motion that nobody knows */
    frame->motion_z = w[MOTION_Z].is_there && w[FIRST_MOTION].is_there ? f->motion_z : NULL;
    frame->mask = w[MASK].is_there ? f->mask : NULL;
    for (size_t i = 0; frame->mask && i < count; i++) f->mask[i] = f->mask_values[i] > 0.0f;
    if (!w[FIRST_MOTION].is_there) motion_of_camera(f);
    return w[FIRST_COLOR].is_there ? LOBE_SSR_OK : read_previous(f, index);
}

lobe_ssr_result lobe_ssr_folder_get(lobe_ssr_folder *f, int index, lobe_ssr_frame *frame) {
    char path[FOLDER_PATH];
    if (index < 0 || index >= f->count)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "frame %d: out of range; use 0 to %d", index,
                             f->count - 1);
    if (!lobe_ssr_folder_name(path, f->path, f->frames[index].file))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "%s: a name is too long; shorten it", f->path);
    f->frame = (lobe_ssr_frame){.z = f->z,
                                .normal = f->normal,
                                .roughness = f->roughness,
                                .motion = f->motion,
                                .previous_color = f->color,
                                .environment = f->environment,
                                .camera = f->frames[index].camera,
                                .previous_camera = f->frames[index].previous};
    ssr_wanted wanted[CHANNELS] = {{"Z", f->z, 1, 1, 0},
                                   {"N.X", f->normal, 3, 1, 0},
                                   {"N.Y", f->normal + 1, 3, 1, 0},
                                   {"N.Z", f->normal + 2, 3, 1, 0},
                                   {"roughness", f->roughness, 1, 1, 0},
                                   {"f0.R", f->f0, 3, 0, 0},
                                   {"f0.G", f->f0 + 1, 3, 0, 0},
                                   {"f0.B", f->f0 + 2, 3, 0, 0},
                                   {"motion.X", f->motion, 2, 0, 0},
                                   {"motion.Y", f->motion + 1, 2, 0, 0},
                                   {"previous.R", f->color, 3, 0, 0},
                                   {"previous.G", f->color + 1, 3, 0, 0},
                                   {"previous.B", f->color + 2, 3, 0, 0},
                                   {"tangent.X", f->tangent, 3, 0, 0},
                                   {"tangent.Y", f->tangent + 1, 3, 0, 0},
                                   {"tangent.Z", f->tangent + 2, 3, 0, 0},
                                   {"anisotropy", f->anisotropy, 1, 0, 0},
                                   {"mask", f->mask_values, 1, 0, 0},
                                   {"motion.Z", f->motion_z, 1, 0, 0}};
    lobe_ssr_result result =
        lobe_ssr_read_channels(path, f->width, f->height, wanted, CHANNELS, NULL);
    if (result == LOBE_SSR_OK) result = check_groups(path, wanted);
    if (result == LOBE_SSR_OK) result = use_channels(f, index, wanted);
    *frame = f->frame;
    return result;
}
