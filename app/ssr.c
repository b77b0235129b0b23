/* app/ssr.c: `lobe ssr`: screen-space reflections along a path of the camera. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/ssr_frames.h>
#include <lobe/ssr_picture.h>
#include <lobe/version.h>

#include "commands.h"
#include "frames.h"
#include "interrupt.h"
#include "json.h"
#include "model.h"
#include "options.h"
#include "output.h"
#include "page.h"
#include "progress.h"
#include "ssr_contest.h"
#include "ssr_report.h"
#include "ssr_source.h"
#include "ssr_write.h"

/* A file, or a name of `paths`. */
typedef struct camera_path {
    const char *file; /* NULL: none */
    int name;
} camera_path;

typedef struct ssr_values {
    const char *out, *gbuffer, *compare, *camera, *environment, *animation;
    lobe_app_size size;
    uint64_t frames, spp, seed, threads, iterations, truth_rays;
    double roughness, anisotropy, thickness, edge_fade, smoothness_start, smoothness_end,
        accumulation, bias, speed_rejection, speed_scale, frame_time, frame_rate;
    camera_path path;
    lobe_camera_path *cameras; /* of its file; NULL: none */
    int mode, method, resolve, backend, progress;
    bool truth, no_sky, linear, as_hdrp, json;
} ssr_values;

static const char *const paths[] = {"orbit", "dolly", "shake", "still", NULL};
static const char *const modes[] = {"mirror", "ndf", "vndf", NULL};
static const char *const resolves[] = {"approx",     "neighbourhood", "neighbourhood-ratio",
                                       "confidence", "own",           NULL};
static const char *const backends[] = {"cpu", "gl", "auto", NULL};

#define AT(member) offsetof(ssr_values, member)

static bool read_share(const lobe_app_option *option, const char *text, void *value) {
    if (!lobe_app_read_f64(option, text, value)) return false;
    if (*(double *)value >= 0 && *(double *)value <= 1) return true;
    lobe_app_report(option->name, "use 0 to 1", "'%.40s' is out of range", text);
    return false;
}

static bool read_signed_share(const lobe_app_option *option, const char *text, void *value) {
    if (!lobe_app_read_f64(option, text, value)) return false;
    if (*(double *)value >= -1 && *(double *)value <= 1) return true;
    lobe_app_report(option->name, "use -1 to 1", "'%.40s' is out of range", text);
    return false;
}

static bool read_path(const lobe_app_option *option, const char *text, void *value) {
    camera_path *path = value;
    bool is_name = false;
    for (int i = 0; paths[i]; i++) is_name |= strcmp(text, paths[i]) == 0;
    path->file = !is_name && access(text, F_OK) == 0 ? text : NULL;
    return path->file || lobe_app_read_choice(option, text, &path->name);
}

static const lobe_app_option frame_options[] = {
    {"-o", "DIR", NULL, "folder for frames, truth and stats.json", lobe_app_read_name, AT(out),
     NULL},
    {"--size", "WxH", "640x360", "in pixels", lobe_app_read_size, AT(size), NULL},
    {"--frames", "N", "8, or all of a file", "how many", lobe_app_read_count, AT(frames), NULL},
    {"--camera-path", "NAME|FILE", "orbit",
     "a frame: 1 degree about the target, 1 % toward it (dolly), half a percent by chance (shake), "
     "nothing (still); or a JSON file of cameras: docs/camera.md",
     read_path, AT(path), paths},
    {"--camera", "NAME", "the first", "a camera of the file", lobe_app_read_name, AT(camera), NULL},
    {"--frame-time", "S", "none: nodes rest",
     "moment of the file's animation in frame 0, in seconds", lobe_app_read_f64, AT(frame_time),
     NULL},
    {"--frame-rate", "N", "24", "frames a second of the animation, 0.001 to 1000000",
     lobe_app_read_f64, AT(frame_rate), NULL},
    {"--animation", "NAME", "the first", "which animation; all: all of them", lobe_app_read_name,
     AT(animation), NULL},
    {"--env", "FILE", "the scene's own light, or a sky", "panorama to light with",
     lobe_app_read_name, AT(environment), NULL},
    {"--spp", "N", "16", "camera paths a pixel of the colour that is reflected",
     lobe_app_read_count, AT(spp), NULL},
    {"--roughness", "R", "each its own", "perceptual roughness of every surface, for comparisons",
     read_share, AT(roughness), NULL},
    {"--anisotropy", "A", "each its own",
     "of every surface, for comparisons: alpha (1 + A) and (1 - A)", read_signed_share,
     AT(anisotropy), NULL},
    {"--seed", "S", "0", "of the random numbers, any whole number", lobe_app_read_u64, AT(seed),
     NULL},
    {"--threads", "N", "one a processor", "the pictures do not depend on it", lobe_app_read_count,
     AT(threads), NULL},
    {0}};

static const lobe_app_option trace_options[] = {
    {"--backend", "NAME", "auto",
     "what runs the passes; auto: a GPU, the processor where there is none", lobe_app_read_choice,
     AT(backend), backends},
    {"--mode", "NAME", "vndf",
     "directions: mirrored, by all normals, or by visible normals with --method",
     lobe_app_read_choice, AT(mode), modes},
    {"--method", "NAME", "bounded", "how to sample visible normals of GGX", lobe_app_read_choice,
     AT(method), lobe_app_methods},
    {"--bias", "B", "0.5; 0 for slope methods",
     "shortens the lobe: its radial random number times 1 - B, in [0, 1)", read_share, AT(bias),
     NULL},
    {"--max-iterations", "N", "64", "cells of the depth pyramid that a ray may step through",
     lobe_app_read_count, AT(iterations), NULL},
    {"--thickness", "T", "0.01", "of what is seen, a share of its distance", read_share,
     AT(thickness), NULL},
    {"--no-sky", NULL, NULL, "a ray that leaves where nothing stands is a miss", NULL, AT(no_sky),
     NULL},
    {"--linear", NULL, NULL, "march texel by texel, for comparison", NULL, AT(linear), NULL},
    {"--as-hdrp", NULL, NULL, "for comparison: weights of world-space vectors, nearest depths only",
     NULL, AT(as_hdrp), NULL},
    {0}};

static const lobe_app_option resolve_options[] = {
    {"--resolve", "NAME", "confidence",
     "colour from the pyramid; from 3 x 3 rays by weight or by value over density; from 13, those "
     "that met nothing for less; or of the pixel's own ray alone",
     lobe_app_read_choice, AT(resolve), resolves},
    {"--edge-fade", "F", "0.1", "share of half the screen on which reflections fade", read_share,
     AT(edge_fade), NULL},
    {"--smoothness-fade-start", "S", "0.9", "smoothness (1 - roughness) at which they fade",
     read_share, AT(smoothness_start), NULL},
    {"--min-smoothness", "S", "0.9", "smoothness below which there are none", read_share,
     AT(smoothness_end), NULL},
    {"--accumulation", "A", "0.75", "share of the history", read_share, AT(accumulation), NULL},
    {"--speed-rejection", "R", "0.5", "of the history, by pixels of motion times the scale",
     read_share, AT(speed_rejection), NULL},
    {"--speed-scale", "S", "0.2", "scale of --speed-rejection", read_share, AT(speed_scale), NULL},
    {0}};

static const lobe_app_option output_options[] = {
    {"--truth", NULL, NULL, "trace real rays as well: errors in stats.json, and report.html", NULL,
     AT(truth), NULL},
    {"--compare", "LIST", NULL,
     "others on the same frames, as ellipsoid,optimal,ndf,mirror,hdrp: numbers and report",
     lobe_app_read_name, AT(compare), NULL},
    {"--truth-rays", "N", "256", "real rays a pixel", lobe_app_read_count, AT(truth_rays), NULL},
    {"--write-gbuffer", "DIR", NULL, "write the frames too: docs/gbuffer.md", lobe_app_read_name,
     AT(gbuffer), NULL},
    {"--json", NULL, NULL, "stats.json on standard output too", NULL, AT(json), NULL},
    LOBE_APP_PROGRESS_OPTION(ssr_values, progress),
    {0}};

static ssr_values default_values(void) {
    const lobe_ssr_options o = lobe_ssr_default_options();
    const lobe_ssr_scene_options s = lobe_ssr_scene_default_options();
    return (ssr_values){.size = {s.width, s.height},
                        .frames = (uint64_t)s.count,
                        .spp = s.samples,
                        .iterations = (uint64_t)o.max_iterations,
                        .truth_rays = 256,
                        .roughness = -1,
                        .frame_time = NAN,
                        .frame_rate = 24,
                        .anisotropy = (double)s.anisotropy,
                        .thickness = (double)o.thickness,
                        .edge_fade = (double)o.edge_fade,
                        .smoothness_start = 0.9,
                        .smoothness_end = 0.9,
                        .accumulation = (double)o.accumulation,
                        .bias = (double)o.bias,
                        .speed_rejection = (double)o.speed_rejection,
                        .speed_scale = (double)o.speed_scale,
                        .mode = (int)o.mode,
                        .method = (int)o.method,
                        .backend = LOBE_SSR_AUTO,
                        .resolve = (int)o.resolve};
}

static lobe_ssr_options pipeline_options(const ssr_values *v) {
    lobe_ssr_options o = lobe_ssr_default_options();
    o.mode = (lobe_ssr_mode)v->mode;
    o.method = (lobe_method)v->method;
    o.resolve = (lobe_ssr_resolve)v->resolve;
    o.max_iterations = (int)v->iterations;
    o.thickness = (float)v->thickness;
    o.edge_fade = (float)v->edge_fade;
    o.fade_start = (float)(1 - v->smoothness_start);
    o.fade_end = (float)(1 - v->smoothness_end);
    o.accumulation = (float)v->accumulation;
    o.bias = (float)v->bias;
    o.speed_rejection = (float)v->speed_rejection;
    o.speed_scale = (float)v->speed_scale;
    o.reflect_sky = !v->no_sky;
    o.linear_march = v->linear;
    o.as_hdrp = v->as_hdrp;
    o.seed = v->seed;
    o.threads = (int)v->threads;
    o.backend = (lobe_ssr_backend)v->backend;
    return o;
}

/* ---- A run ----------------------------------------------------------------------------------- */

typedef struct ssr_run {
    const ssr_values *values;
    const char *source;
    lobe_app_ssr_source frames;
    const char *command; /* as it was typed */
    lobe_app_ssr_contest contest;
    lobe_app_truth truth; /* rgb NULL: not asked for */
    lobe_ssr_animation *preview;
    lobe_app_progress progress;
    int frame, parts, part; /* what the progress is of */
} ssr_run;

static void show_progress(void *user, double fraction) {
    ssr_run *run = user;
    const double frames = run->frame + (run->part + fraction) / run->parts;
    lobe_app_show_progress(&run->progress, frames / (double)run->values->frames, frames);
}

static lobe_ssr_scene_options scene_options(ssr_run *run) {
    const ssr_values *v = run->values;
    lobe_ssr_scene_options o = lobe_ssr_scene_default_options();
    o.width = v->size.width;
    o.height = v->size.height;
    o.count = (int)v->frames;
    o.path = (lobe_ssr_path)v->path.name;
    o.cameras = v->cameras;
    o.samples = (uint32_t)v->spp;
    o.roughness = (float)v->roughness;
    o.anisotropy = (float)v->anisotropy;
    o.camera = v->camera;
    o.seed = v->seed;
    o.threads = (int)v->threads;
    o.progress = show_progress;
    o.progress_user = run;
    o.cancel = &lobe_app_interrupted;
    return o;
}

static int write_view(char *text, size_t size, const lobe_view *v) {
    return snprintf(text, size, " %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g",
                    (double)v->position.x, (double)v->position.y, (double)v->position.z,
                    (double)v->target.x, (double)v->target.y, (double)v->target.z, (double)v->up.x,
                    (double)v->up.y, (double)v->up.z, (double)v->vertical_degrees);
}

/* The name of a path, or the cameras of this frame. */
static void write_path(const ssr_run *run, char *text, size_t size) {
    const ssr_values *v = run->values;
    snprintf(text, size, "%s", paths[v->path.name]);
    if (!v->cameras) return;
    const lobe_path_frame *frame = lobe_camera_path_get(v->cameras, run->frame);
    const int length = write_view(text, size, &frame->camera.view);
    write_view(text + length, size - (size_t)length, &frame->previous.view);
}

/* Of a scene in motion; a scene at rest has no such words. */
static void write_moment(const ssr_values *v, char *text, size_t size) {
    text[0] = 0;
    if (!isnan(v->frame_time))
        snprintf(text, size, " animation %.100s from %.17g at %.17g",
                 v->animation ? v->animation : "-", v->frame_time, v->frame_rate);
}

/* What a kept truth depends on. */
static void write_key(const ssr_run *run, char *key, size_t size) {
    const ssr_values *v = run->values;
    char path[400], moment[200];
    write_path(run, path, sizeof path);
    write_moment(v, moment, sizeof moment);
    struct stat file = {0};
    if (stat(run->source, &file) != 0) file = (struct stat){0};
    snprintf(key, size,
             "lobe %s %.200s %lld %lld env %.200s camera %.60s path %s size %dx%d frame %d of any, "
             "spp %llu "
             "roughness %.9g anisotropy %.9g seed %llu mode %s rays %llu%s",
             LOBE_VERSION_STRING, run->source, (long long)file.st_size, (long long)file.st_mtime,
             v->environment ? v->environment : "-", v->camera ? v->camera : "-", path,
             v->size.width, v->size.height, run->frame, (unsigned long long)v->spp, v->roughness,
             v->anisotropy, (unsigned long long)v->seed, modes[v->mode == LOBE_SSR_MIRROR ? 0 : 2],
             (unsigned long long)v->truth_rays, moment);
}

static lobe_ssr_result find_truth(ssr_run *run) {
    const ssr_values *v = run->values;
    char key[1400];
    write_key(run, key, sizeof key);
    if (lobe_app_read_truth(v->out, run->frame, key, &run->truth)) return LOBE_SSR_OK;
    run->part = 1;
    lobe_ssr_result result =
        lobe_ssr_truth(run->frames.frames, (lobe_ssr_mode)v->mode, (int)v->truth_rays,
                       run->truth.rgb, run->truth.on_screen);
    if (result == LOBE_SSR_OK) result = lobe_app_write_truth(v->out, run->frame, key, &run->truth);
    return result;
}

/* ---- Contenders ------------------------------------------------------------------------------ */

static const char *main_name(const ssr_values *v) {
    return v->mode == LOBE_SSR_VNDF ? lobe_method_name((lobe_method)v->method) : modes[v->mode];
}

/* What a name of --compare changes; false: there is no such name. */
static bool apply_name(const char *name, lobe_ssr_options *o) {
    const float bias = o->bias;
    o->bias = 0;
    if (strcmp(name, "mirror") == 0 || strcmp(name, "ndf") == 0) {
        o->mode = name[0] == 'm' ? LOBE_SSR_MIRROR : LOBE_SSR_NDF;
        o->bias = bias;
        return true;
    }
    o->mode = LOBE_SSR_VNDF;
    if (strcmp(name, "hdrp") == 0) {
        o->method = LOBE_METHOD_ELLIPSOID;
        o->resolve = LOBE_SSR_NEIGHBOURHOOD;
        o->as_hdrp = 1;
        o->bias = lobe_ssr_default_options().bias;
        return true;
    }
    for (int m = 0; lobe_app_methods[m]; m++) {
        const lobe_model model = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, (lobe_method)m};
        if (strcmp(name, lobe_app_methods[m]) != 0) continue;
        o->method = (lobe_method)m;
        if (lobe_ssr_has_bias(o->method)) o->bias = bias;
        return lobe_model_exists(model);
    }
    return false;
}

static lobe_app_status add_contenders(lobe_app_ssr_contest *contest, const ssr_values *v) {
    lobe_app_add_ssr_contender(contest, v->as_hdrp ? "as hdrp" : main_name(v), pipeline_options(v));
    for (const char *at = v->compare; at;) {
        const size_t length = strcspn(at, ",");
        char name[32];
        snprintf(name, sizeof name, "%.*s", length < sizeof name ? (int)length : 0, at);
        lobe_ssr_options options = pipeline_options(v);
        if (!apply_name(name, &options))
            return lobe_app_reject("--compare", "use methods of Smith-GGX, ndf, mirror or hdrp",
                                   "'%.*s' is none", (int)(length < 40 ? length : 40), at);
        if (!lobe_app_add_ssr_contender(contest, name, options))
            return lobe_app_reject("--compare", "use 11 at most", "too many names");
        at = at[length] ? at + length + 1 : NULL;
    }
    return LOBE_APP_DONE;
}

/* ---- Frames ---------------------------------------------------------------------------------- */

/* What a person wants to look at, not a film. */
enum { PREVIEW_FRAMES = 240, PREVIEW_MILLISECONDS = 100 };

static lobe_ssr_result add_to_preview(ssr_run *run) {
    if (!run->preview || run->frame >= PREVIEW_FRAMES) return LOBE_SSR_OK;
    return lobe_ssr_animation_add(run->preview, lobe_ssr_composite(run->contest.contender[0].ssr),
                                  3);
}

static lobe_app_status run_frame(ssr_run *run) {
    const ssr_values *v = run->values;
    lobe_ssr_frame frame;
    run->part = 0;
    lobe_app_status status =
        lobe_app_ssr_status(lobe_app_get_ssr_frame(&run->frames, run->frame, &frame));
    if (!status) status = lobe_app_run_ssr_contest(&run->contest, run->frame, &frame);
    if (!status && run->truth.rgb) status = lobe_app_ssr_status(find_truth(run));
    if (!status && run->truth.rgb)
        status =
            lobe_app_judge_ssr_contest(&run->contest, run->frame, run->frames.frames, &run->truth);
    if (!status)
        status = lobe_app_ssr_status(lobe_app_write_ssr_frame(
            v->out, run->frame, run->contest.contender[0].ssr, run->truth.rgb ? &run->truth : NULL,
            v->size.width, v->size.height));
    if (!status) status = lobe_app_ssr_status(add_to_preview(run));
    if (!status) run->contest.done = run->frame + 1;
    return status;
}

/* Black pictures are not what somebody asks for. */
static void warn_without_rays(const ssr_run *run) {
    for (int i = 0; i < run->contest.done; i++)
        if (run->contest.contender[0].rows[i].statistics.rays > 0) return;
    lobe_app_report("--min-smoothness", "give a smaller one, as 0.4",
                    "no surface on the screen is so smooth, nothing was traced");
}

/* The others by name; NULL: out of memory. */
static json_t *compared(const lobe_app_ssr_contest *c) {
    json_t *list = json_array();
    for (int m = 1; m < c->contenders; m++)
        json_array_append_new(list, json_pack("{ss so}", "name", c->contender[m].name, "frames",
                                              lobe_app_ssr_rows(c, &c->contender[m])));
    return list;
}

static json_t *make_stats(const ssr_run *run) {
    const ssr_values *v = run->values;
    const lobe_ssr *ssr = run->contest.contender[0].ssr;
    json_t *stats =
        json_pack("{si si ss ss ss ss ss so}", "width", v->size.width, "height", v->size.height,
                  "mode", modes[v->mode], "method", main_name(v), "resolve", resolves[v->resolve],
                  "backend", backends[lobe_ssr_backend_of(ssr)], "device", lobe_ssr_device(ssr),
                  "frames", lobe_app_ssr_rows(&run->contest, &run->contest.contender[0]));
    if (run->contest.contenders > 1)
        json_object_set_new(stats, "compared", compared(&run->contest));
    return stats;
}

static lobe_app_status finish(ssr_run *run, bool is_interrupted) {
    const ssr_values *v = run->values;
    warn_without_rays(run);
    json_t *stats = make_stats(run);
    lobe_app_status status = lobe_app_write_stats(v->out, stats);
    if (!status && run->truth.rgb && run->contest.done)
        status = lobe_app_write_ssr_report(&run->contest, run->source, run->command, is_interrupted,
                                           v->out);
    if (status == LOBE_APP_DONE && v->json) return lobe_app_print_json(stats);
    json_decref(stats);
    return status;
}

static int make_truth(ssr_run *run) {
    const lobe_app_size size = run->values->size;
    const size_t count = (size_t)size.width * (size_t)size.height;
    run->truth = (lobe_app_truth){.width = size.width, .height = size.height};
    if (!run->values->truth) return 1;
    run->truth.rgb = malloc(4 * count * sizeof(float));
    run->truth.on_screen = run->truth.rgb ? run->truth.rgb + 3 * count : NULL;
    return run->truth.rgb != NULL;
}

/* A moving picture, of more than one frame. */
static lobe_app_status begin_preview(ssr_run *run) {
    const ssr_values *v = run->values;
    char path[PATH_MAX];
    if (v->frames < 2) return LOBE_APP_DONE;
    snprintf(path, sizeof path, "%s/preview.png", v->out);
    return lobe_app_ssr_status(lobe_ssr_animation_begin(path, v->size.width, v->size.height,
                                                        PREVIEW_MILLISECONDS, &run->preview));
}

/* The folders to write, and what is written along the way. */
static lobe_app_status make_outputs(ssr_run *run) {
    const ssr_values *v = run->values;
    lobe_app_status status = lobe_app_make_folder(v->out);
    if (!status && v->gbuffer) status = lobe_app_make_folder(v->gbuffer);
    if (!status && v->gbuffer)
        status = lobe_app_ssr_status(
            lobe_ssr_folder_begin(v->gbuffer, v->size.width, v->size.height, &run->frames.writer));
    if (!status) status = begin_preview(run);
    if (status || make_truth(run)) return status;
    lobe_app_report("--truth", "use a smaller --size", "out of memory");
    return LOBE_APP_FAILED;
}

/* Ends what is written along the way; the first thing that went wrong. */
static lobe_app_status finish_outputs(ssr_run *run, lobe_app_status status) {
    const lobe_ssr_result folder = lobe_ssr_folder_finish(run->frames.writer);
    if (!status) status = lobe_app_ssr_status(folder);
    const lobe_ssr_result preview = lobe_ssr_animation_finish(run->preview);
    if (!status && run->contest.done) status = lobe_app_ssr_status(preview);
    run->frames.writer = NULL;
    run->preview = NULL;
    return status;
}

static lobe_app_status run_frames(ssr_run *run) {
    const ssr_values *v = run->values;
    lobe_app_ssr_contest *c = &run->contest;
    c->width = v->size.width;
    c->height = v->size.height;
    c->frames = (int)v->frames;
    c->has_truth = v->truth;
    lobe_app_status status = lobe_app_open_ssr_contest(c);
    if (!status) status = make_outputs(run);
    run->parts = v->truth ? 2 : 1;
    run->progress = lobe_app_begin_progress(v->progress, "ssr", "frames");
    while (!status && run->frame < (int)v->frames) {
        status = run_frame(run);
        run->frame++;
    }
    lobe_app_end_progress(&run->progress);
    status = finish_outputs(run, status);
    if (status != LOBE_APP_DONE && status != LOBE_APP_INTERRUPTED) return status;
    const lobe_app_status finished = finish(run, status == LOBE_APP_INTERRUPTED);
    return finished ? finished : status;
}

static lobe_app_status open_scene(ssr_run *run) {
    const ssr_values *v = run->values;
    lobe_scene_options scene = lobe_app_ssr_scene_options();
    scene.environment = v->environment;
    scene.frame_time = v->frame_time;
    scene.animation = v->animation;
    if (!isnan(v->frame_time))
        return lobe_app_ssr_status(lobe_ssr_frames_of_animation(
            run->source, scene, 1 / v->frame_rate, scene_options(run), &run->frames.frames));
    const lobe_app_status status = lobe_app_load_ssr_scene(&run->frames, run->source, scene);
    if (status) return status;
    return lobe_app_ssr_status(
        lobe_ssr_frames_of_scene(run->frames.scene, scene_options(run), &run->frames.frames));
}

/* The folder says how large the frames are, and how many. */
static lobe_app_status open_folder(ssr_run *run, ssr_values *v, bool has_count) {
    const lobe_app_status status =
        lobe_app_ssr_status(lobe_ssr_folder_open(run->source, &run->frames.folder));
    if (status) return status;
    const uint64_t count = (uint64_t)lobe_ssr_folder_count(run->frames.folder);
    v->size = (lobe_app_size){lobe_ssr_folder_width(run->frames.folder),
                              lobe_ssr_folder_height(run->frames.folder)};
    if (has_count && v->frames > count)
        return lobe_app_reject("--frames", "use fewer", "the folder has %d", (int)count);
    if (!has_count) v->frames = count;
    return LOBE_APP_DONE;
}

static lobe_app_status reflect(ssr_values *v, const lobe_app_arguments *arguments,
                               const char *command) {
    ssr_run run = {.values = v, .source = arguments->operand, .command = command};
    lobe_app_status status = add_contenders(&run.contest, v);
    if (status) return status;
    lobe_app_catch_interrupt();
    status = lobe_app_is_folder(run.source)
                 ? open_folder(&run, v, lobe_app_is_given(arguments, "--frames"))
                 : open_scene(&run);
    if (!status) status = run_frames(&run);
    free(run.truth.rgb);
    lobe_app_close_ssr_contest(&run.contest);
    lobe_app_close_ssr_source(&run.frames);
    return status;
}

/* ---- Arguments ------------------------------------------------------------------------------- */

static lobe_app_status check_counts(const ssr_values *v) {
    if (v->frames > 10000) return lobe_app_reject("--frames", "use 1 to 10000", "too many");
    if (v->spp > LOBE_RENDER_SAMPLES_MAX)
        return lobe_app_reject("--spp", "use 1 to 16777216", "too many samples");
    if (v->iterations > 1000000)
        return lobe_app_reject("--max-iterations", "use 1 to 1000000", "too many");
    if (v->truth_rays > 1000000)
        return lobe_app_reject("--truth-rays", "use 1 to 1000000", "too many");
    if (v->threads > 1024) return lobe_app_reject("--threads", "use 1 to 1024", "too many threads");
    if (v->size.width < 1 || v->size.width > LOBE_SSR_SIZE_MAX || v->size.height < 1 ||
        v->size.height > LOBE_SSR_SIZE_MAX)
        return lobe_app_reject("--size", "use 1x1 to 32768x32768", "out of range");
    return LOBE_APP_DONE;
}

static lobe_app_status check_method(ssr_values *v, const lobe_app_arguments *arguments) {
    const int is_chosen = v->mode == LOBE_SSR_VNDF;
    lobe_model model;
    if (lobe_app_is_given(arguments, "--method") && !is_chosen)
        return lobe_app_reject("--method", "it goes with --mode vndf", "--mode %s has no choice",
                               modes[v->mode]);
    if (v->mode == LOBE_SSR_VNDF && v->method == LOBE_METHOD_NDF)
        return lobe_app_reject("--method", "use --mode ndf", "ndf does not draw visible normals");
    const lobe_app_status status =
        lobe_app_choose_model(LOBE_NDF_GGX, LOBE_MASKING_SMITH, v->method, &model);
    if (status) return status;
    if (v->bias == 1)
        return lobe_app_reject("--bias", "use less than 1", "nothing is left of the lobe");
    if (!is_chosen || lobe_ssr_has_bias(model.method)) return LOBE_APP_DONE;
    if (lobe_app_is_given(arguments, "--bias") && v->bias > 0)
        return lobe_app_reject("--bias", "use 0", "unknown for method %s",
                               lobe_method_name(model.method));
    v->bias = 0;
    return LOBE_APP_DONE;
}

/* What says how a scene is seen says nothing of frames that are there already. */
static lobe_app_status check_folder(const lobe_app_arguments *arguments) {
    static const char *const of_scenes[] = {"--size",       "--camera-path", "--camera",
                                            "--frame-time", "--frame-rate",  "--animation",
                                            "--env",        "--spp",         "--roughness",
                                            "--anisotropy", "--truth",       "--write-gbuffer"};
    for (size_t i = 0; i < sizeof of_scenes / sizeof *of_scenes; i++)
        if (lobe_app_is_given(arguments, of_scenes[i]))
            return lobe_app_reject(of_scenes[i], "leave it out, or give a scene",
                                   "the frames of a folder are as they are");
    return LOBE_APP_DONE;
}

static lobe_app_status check_moments(const ssr_values *v, const lobe_app_arguments *arguments) {
    const char *const of_motion[] = {"--frame-rate", "--animation"};
    for (size_t i = 0; i < sizeof of_motion / sizeof *of_motion; i++)
        if (isnan(v->frame_time) && lobe_app_is_given(arguments, of_motion[i]))
            return lobe_app_reject(of_motion[i], "give --frame-time S too", "no moment to show");
    if (!(v->frame_rate >= 0.001 && v->frame_rate <= 1e6))
        return lobe_app_reject("--frame-rate", "use 0.001 to 1000000", "out of range");
    return LOBE_APP_DONE;
}

/* A file says how many frames there are. */
static lobe_app_status read_cameras(ssr_values *v, const lobe_app_arguments *arguments) {
    if (!v->path.file) return LOBE_APP_DONE;
    const lobe_app_status status = lobe_app_exclude(arguments, "--camera-path", "--camera");
    if (status) return status;
    const lobe_render_result read = lobe_camera_path_read(v->path.file, &v->cameras);
    if (read != LOBE_RENDER_OK) {
        lobe_app_report_line(lobe_render_error_message());
        return read == LOBE_RENDER_BAD_INPUT ? LOBE_APP_BAD_INPUT : LOBE_APP_FAILED;
    }
    const uint64_t count = (uint64_t)lobe_camera_path_count(v->cameras);
    if (!lobe_app_is_given(arguments, "--frames")) v->frames = count;
    if (v->frames > count)
        return lobe_app_reject("--frames", "use fewer", "%s has %d", v->path.file, (int)count);
    return lobe_app_check_shapes(v->path.file, v->cameras, v->size);
}

static lobe_app_status check(ssr_values *v, const lobe_app_arguments *arguments) {
    if (!arguments->operand)
        return lobe_app_reject(
            "ssr", "give a file, a folder or a name of lobe render --list-scenes", "no scene");
    if (!v->out)
        return lobe_app_reject("-o", "give a folder, as -o reflections", "no folder to write");
    if (v->smoothness_end > v->smoothness_start)
        return lobe_app_reject("--min-smoothness", "use at most --smoothness-fade-start",
                               "the fade ends before it starts");
    if (lobe_app_is_given(arguments, "--truth-rays") && !v->truth)
        return lobe_app_reject("--truth-rays", "give --truth too", "no truth was asked for");
    if (v->gbuffer && strcmp(v->gbuffer, v->out) == 0)
        return lobe_app_reject("--write-gbuffer", "give another folder", "the same as of -o");
    lobe_app_status status = read_cameras(v, arguments);
    if (!status) status = check_moments(v, arguments);
    if (!status) status = check_counts(v);
    if (!status && lobe_app_is_folder(arguments->operand)) status = check_folder(arguments);
    return status ? status : check_method(v, arguments);
}

lobe_app_status lobe_app_ssr(int argc, char **argv) {
    ssr_values values = default_values();
    const lobe_app_group groups[] = {{"Frames", frame_options, &values},
                                     {"Trace", trace_options, &values},
                                     {"Resolve", resolve_options, &values},
                                     {"Output", output_options, &values},
                                     {0}};
    const lobe_app_command command = {
        "ssr",
        "SCENE|FOLDER -o DIR [OPTIONS]",
        "Reflections from the depth and colour of frames: rays through the depth buffer. The "
        "frames are\nof a scene, along a path of the camera, or in a folder: docs/gbuffer.md.\n"
        "DIR gets frame-0000.exr and .png, preview.png and stats.json; with --truth the error "
        "against\nreal rays, and report.html.",
        "SCENE",
        groups,
        "lobe ssr gallery -o reflections --min-smoothness 0.4 --truth"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    status = check(&values, &arguments);
    char *line = status ? NULL : lobe_app_command_line("ssr", argc, argv);
    if (line) {
        status = reflect(&values, &arguments, line);
    } else if (!status) {
        lobe_app_report("ssr", "free some", "out of memory");
        status = LOBE_APP_FAILED;
    }
    free(line);
    lobe_camera_path_free(values.cameras);
    return status;
}
