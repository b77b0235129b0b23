/* Frames of a scene: one ray through the centre of each pixel fills the G-buffer; the colour of the frame
 * before is path-traced. */
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "frames.h"
#include "lobe/random.h"
#include "message.h"

lobe_ssr_scene_options lobe_ssr_scene_default_options(void) {
    return (lobe_ssr_scene_options){.width = 640,
                                    .height = 360,
                                    .count = 8,
                                    .samples = 16,
                                    .roughness = -1.0f,
                                    .anisotropy = 2.0f};
}

static lobe_ssr_result check_options(const lobe_ssr_scene_options *o) {
    if (o->width < 1 || o->height < 1 || o->width > LOBE_SSR_SIZE_MAX ||
        o->height > LOBE_SSR_SIZE_MAX)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "size: %d x %d is out of range; use 1 to %d",
                             o->width, o->height, LOBE_SSR_SIZE_MAX);
    if (o->count < 1 || o->count > 1000000 || o->samples < 1 ||
        o->samples > LOBE_RENDER_SAMPLES_MAX || (unsigned)o->path > LOBE_SSR_PATH_STILL ||
        !(o->roughness <= 1.0f) || !(o->anisotropy >= -1.0f) || o->threads < 0 || o->threads > 1024)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "options: a value is out of range; see lobe/ssr_frames.h");
    if (o->cameras && o->count > lobe_camera_path_count(o->cameras))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "frames: the camera path has %d; use fewer",
                             lobe_camera_path_count(o->cameras));
    return LOBE_SSR_OK;
}

static v3 light_of_scene(const void *rays, v3 direction) {
    return ssr_in(lobe_rays_environment(rays, ssr_out(direction)));
}

static int make_buffers(lobe_ssr_frames *f) {
    const size_t count = (size_t)f->options.width * (size_t)f->options.height;
    f->environment = lobe_ssr_prefilter(light_of_scene, f->now.rays, f->threads);
    f->z = malloc(count * sizeof *f->z);
    f->normal = malloc(3 * count * sizeof *f->normal);
    f->roughness = malloc(count * sizeof *f->roughness);
    f->f0 = malloc(3 * count * sizeof *f->f0);
    f->motion = malloc(2 * count * sizeof *f->motion);
    f->tangent = malloc(3 * count * sizeof *f->tangent);
    f->anisotropy = malloc(count * sizeof *f->anisotropy);
    f->color = malloc(3 * count * sizeof *f->color);
    f->previous_z = malloc(count * sizeof *f->previous_z);
    if (f->animation.is_moving) f->motion_z = malloc(count * sizeof *f->motion_z);
    return f->environment && f->z && f->normal && f->roughness && f->f0 && f->motion && f->color &&
           f->tangent && f->anisotropy && f->previous_z && (f->motion_z || !f->animation.is_moving);
}

/* `result`: of the first moment of f. */
static lobe_ssr_result finish(lobe_ssr_frames *f, lobe_ssr_result result,
                              lobe_ssr_frames **frames) {
    if (result == LOBE_SSR_OK && !make_buffers(f)) result = lobe_ssr_fail_memory("frames");
    if (result != LOBE_SSR_OK) {
        lobe_ssr_frames_free(f);
        return result;
    }
    f->frame = (lobe_ssr_frame){
        .z = f->z,
        .normal = f->normal,
        .roughness = f->roughness,
        .anisotropy = f->anisotropy,
        .tangent = f->tangent,
        .f0 = f->f0,
        .motion = f->motion,
        .motion_z = f->motion_z,
        .previous_color = f->color,
        .environment = {ENVIRONMENT_WIDTH, ENVIRONMENT_HEIGHT, ENVIRONMENT_LEVELS, f->environment}};
    *frames = f;
    return LOBE_SSR_OK;
}

static lobe_ssr_result begin(const lobe_ssr_scene_options *options, lobe_ssr_frames **f) {
    const lobe_ssr_result result = check_options(options);
    if (result != LOBE_SSR_OK) return result;
    *f = calloc(1, sizeof **f);
    if (!*f) return lobe_ssr_fail_memory("frames");
    (*f)->options = *options;
    (*f)->threads = options->threads ? options->threads : omp_get_max_threads();
    return LOBE_SSR_OK;
}

lobe_ssr_result lobe_ssr_frames_of_scene(const lobe_scene *scene, lobe_ssr_scene_options options,
                                         lobe_ssr_frames **frames) {
    *frames = NULL;
    lobe_ssr_frames *f;
    const lobe_ssr_result result = begin(&options, &f);
    return result ? result : finish(f, lobe_ssr_moments_of_scene(f, scene), frames);
}

lobe_ssr_result lobe_ssr_frames_of_animation(const char *source, lobe_scene_options scene,
                                             double seconds, lobe_ssr_scene_options options,
                                             lobe_ssr_frames **frames) {
    *frames = NULL;
    lobe_ssr_frames *f;
    const lobe_ssr_result result = begin(&options, &f);
    return result ? result : finish(f, lobe_ssr_moments_of_file(f, source, scene, seconds), frames);
}

void lobe_ssr_frames_free(lobe_ssr_frames *f) {
    if (!f) return;
    lobe_ssr_moments_free(f);
    free(f->environment);
    free(f->z);
    free(f->normal);
    free(f->roughness);
    free(f->f0);
    free(f->motion);
    free(f->color);
    free(f->tangent);
    free(f->anisotropy);
    free(f->motion_z);
    free(f->previous_z);
    free(f);
}

int lobe_ssr_rows(lobe_ssr_frames *f, void (*row)(void *work, int y), void *work, double from,
                  double to) {
    const lobe_ssr_scene_options *o = &f->options;
    int done = 0, stopped = 0;
#pragma omp parallel for schedule(dynamic, 1) num_threads(f->threads)
    for (int y = 0; y < o->height; y++) {
        if (o->cancel && *o->cancel) {
#pragma omp atomic write
            stopped = 1;
            continue;
        }
        row(work, y);
        int now;
#pragma omp atomic capture
        now = ++done;
        if (o->progress && omp_get_thread_num() == 0)
            o->progress(o->progress_user, from + (to - from) * now / o->height);
    }
    return !stopped;
}

/* What one frame needs. */
typedef struct scene_frame {
    lobe_ssr_frames *f;
    ssr_camera camera, previous;
    int index;
} scene_frame;

static v3 ray_through(const ssr_camera *c, float px, float py, float *length) {
    return ssr_unit(ssr_view_vector(*c, px, py, 1.0f), length);
}

/* What moves itself was elsewhere. Where that is not known it counts as new. */
static void fill_motion(const scene_frame *s, int x, int y, const lobe_ray_surface *now) {
    const lobe_ssr_frames *f = s->f;
    const size_t i = (size_t)y * (size_t)f->options.width + (size_t)x;
    const ssr_moment *before = lobe_ssr_moment_before(f);
    lobe_vec3_f32 place;
    if (!lobe_rays_find(before->rays, f->now.rays, &now->place, &place)) {
        f->motion[2 * i] = 2.0f;
        f->motion[2 * i + 1] = 0.0f;
        if (f->motion_z) f->motion_z[i] = 0.0f;
        return;
    }
    lobe_ssr_motion_of(&s->camera, &s->previous, x, y, ssr_in(place), f->motion + 2 * i);
    if (f->motion_z) f->motion_z[i] = f->z[i] - ssr_project(s->previous, ssr_in(place)).z;
}

static void fill_pixel(const scene_frame *s, int x, int y) {
    lobe_ssr_frames *f = s->f;
    const size_t i = (size_t)y * (size_t)f->options.width + (size_t)x;
    float length;
    const v3 direction = ray_through(&s->camera, (float)x + 0.5f, (float)y + 0.5f, &length);
    lobe_ray_surface surface;
    memset(f->normal + 3 * i, 0, 3 * sizeof *f->normal);
    memset(f->f0 + 3 * i, 0, 3 * sizeof *f->f0);
    memset(f->tangent + 3 * i, 0, 3 * sizeof *f->tangent);
    f->z[i] = f->roughness[i] = f->anisotropy[i] = 0.0f;
    if (f->motion_z) f->motion_z[i] = 0.0f;
    if (!lobe_rays_meet(f->now.rays, ssr_out(s->camera.eye), ssr_out(direction), &surface)) {
        const v3 far_away = v3_scale(direction, 1e6f * s->camera.near_z);
        lobe_ssr_motion_of(&s->camera, &s->previous, x, y, v3_add(s->camera.eye, far_away),
                           f->motion + 2 * i);
        return;
    }
    f->z[i] = surface.distance / length;
    f->roughness[i] = f->options.roughness >= 0.0f ? f->options.roughness : surface.roughness;
    memcpy(f->normal + 3 * i, &surface.normal, 3 * sizeof *f->normal);
    f->anisotropy[i] = f->options.anisotropy <= 1.0f ? f->options.anisotropy : surface.anisotropy;
    memcpy(f->tangent + 3 * i, &surface.tangent, 3 * sizeof *f->tangent);
    memcpy(f->f0 + 3 * i, &surface.f0, 3 * sizeof *f->f0);
    fill_motion(s, x, y, &surface);
}

/* Box-filtered, as engines have it. */
static void color_pixel(const scene_frame *s, int x, int y) {
    lobe_ssr_frames *f = s->f;
    const lobe_ssr_scene_options *o = &f->options;
    const size_t i = (size_t)y * (size_t)o->width + (size_t)x;
    const uint64_t stream = (uint64_t)s->index << 32 | i;
    const lobe_rays *rays = lobe_ssr_moment_before(f)->rays;
    v3 sum = v3_of(0.0f, 0.0f, 0.0f);
    for (uint32_t k = 0; k < o->samples; k++) {
        const lobe_random4 r = lobe_random(o->seed, stream, k);
        float length;
        const v3 direction = ray_through(&s->previous, (float)x + lobe_random_unit_f32(r.word[0]),
                                         (float)y + lobe_random_unit_f32(r.word[1]), &length);
        sum = v3_add(sum, ssr_in(lobe_rays_light(rays, ssr_out(s->previous.eye), ssr_out(direction),
                                                 o->seed, stream, k, o->samples)));
    }
    sum = v3_scale(sum, 1.0f / (float)o->samples);
    f->color[3 * i] = sum.x;
    f->color[3 * i + 1] = sum.y;
    f->color[3 * i + 2] = sum.z;
    float length;
    const v3 direction = ray_through(&s->previous, (float)x + 0.5f, (float)y + 0.5f, &length);
    lobe_ray_surface surface;
    const int met = lobe_rays_meet(rays, ssr_out(s->previous.eye), ssr_out(direction), &surface);
    f->previous_z[i] = met ? surface.distance / length : 0.0f;
}

static void fill_row(void *work, int y) {
    const scene_frame *s = work;
    for (int x = 0; x < s->f->options.width; x++) {
        fill_pixel(s, x, y);
        color_pixel(s, x, y);
    }
}

lobe_ssr_result lobe_ssr_frames_get(lobe_ssr_frames *f, int index, lobe_ssr_frame *frame) {
    if (index < 0 || index >= f->options.count)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "frame %d: out of range; use 0 to %d", index,
                             f->options.count - 1);
    const lobe_ssr_result result = lobe_ssr_moments_get(f, index);
    if (result != LOBE_SSR_OK) return result;
    f->frame.camera = lobe_ssr_frame_camera(f, index);
    f->frame.previous_camera = lobe_ssr_previous_camera(f, index);
    const float width = (float)f->options.width, height = (float)f->options.height;
    scene_frame s = {f, lobe_ssr_camera_of(&f->frame.camera, width, height),
                     lobe_ssr_camera_of(&f->frame.previous_camera, width, height), index};
    if (!lobe_ssr_rows(f, fill_row, &s, 0.0, 1.0))
        return lobe_ssr_fail(LOBE_SSR_INTERRUPTED, "frame %d: interrupted; start again", index);
    *frame = f->frame;
    return LOBE_SSR_OK;
}
